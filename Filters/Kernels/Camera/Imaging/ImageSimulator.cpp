#include "Kernels/Camera/Imaging/ImageSimulator.h"

#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/EffectChain.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <optional>
#include <sstream>
#include <utility>

namespace msi
{

namespace
{
constexpr int BlockPixels = 512;

std::string describe(const ImageWindow& window)
{
  std::ostringstream text;
  text << window.width << " x " << window.height << " pixels at (" << window.x << ", " << window.y
       << ")";
  return text.str();
}

// Light from elsewhere in the image.
struct OtherLight
{
  LightFrom from;
  Eigen::ArrayXf strength; // of each channel
};

// What is known of the scene.
struct SceneView
{
  const float* reflectance;
  const int* medium; // nullptr: not known
  ImageWindow available;

  std::size_t pixel(int x, int y) const noexcept
  {
    return static_cast<std::size_t>(y - available.y) * static_cast<std::size_t>(available.width) +
      static_cast<std::size_t>(x - available.x);
  }
};

void displace(
  const BoundEffect& effect, const ImageStep& step, std::vector<ImageDisplacement>& displacements)
{
  const std::vector<EffectParameter>& parameters = effect.form().parameters;
  const auto K = static_cast<Eigen::Index>(displacements.size());
  Eigen::MatrixXd numbers(static_cast<Eigen::Index>(parameters.size()), K);
  for (std::size_t p = 0; p < parameters.size(); ++p)
  {
    numbers.row(static_cast<Eigen::Index>(p)) = effect.perChannel(parameters[p].name).matrix();
  }
  for (Eigen::Index k = 0; k < K; ++k)
  {
    step.displace(numbers.col(k).data(), displacements[static_cast<std::size_t>(k)]);
  }
}

Eigen::Map<Eigen::MatrixXf> blockOf(float* values, int rows, int columns)
{
  return { values, rows, columns };
}
}

struct ImageSimulator::Implementation
{
  EffectChain Chain;
  ImageExtent Extent;
  NoiseGenerator Noise;
  std::uint32_t Exposure;
  std::vector<int> MediumNumber; // of the numbers in a medium image
  std::optional<ChannelRegistration> Registration;
  std::optional<SymmetricKernel> Blur;
  std::optional<ScatterTail> Tail;
  std::vector<OtherLight> Lights;
  std::vector<PixelOperator> OnPixels;
  std::vector<double> FieldX; // of every column of the image

  Implementation(CameraModel camera, std::vector<CameraEffect> effects, const ImageExtent& extent,
    const ImageSimulatorOptions& options)
    : Chain(std::move(camera), std::move(effects), options.whiteAfterEffects)
    , Extent(extent)
    , Noise(Chain.noiseGenerator(options.noise, options.seed))
    , Exposure(options.exposure)
  {
    if (extent.width < 1 || extent.height < 1)
    {
      reject("the image has ", extent.width, " x ", extent.height,
        " pixels; expected at least one each way");
    }
    if (Chain.needsOrder())
    {
      reject("session_drift concerns samples captured one after the other; for an image use "
             "channel_gain");
    }
    for (int x = 0; x < extent.width; ++x)
    {
      FieldX.push_back(fieldAt(x, extent.width));
    }
    for (const std::string& medium : options.media)
    {
      MediumNumber.push_back(Chain.mediumNumber(medium));
    }
    std::vector<ImageDisplacement> displacements;
    for (const BoundEffect& effect : Chain.active())
    {
      const ImageFactories& make = registered(effect.definition()).onImage;
      for (const ImageStep* step : make.steps)
      {
        if (step->displace != nullptr)
        {
          displacements.resize(static_cast<std::size_t>(channels()));
          displace(effect, *step, displacements);
        }
      }
      if (make.makeBlur != nullptr)
      {
        Blur = make.makeBlur(effect);
      }
      if (make.makeTail != nullptr)
      {
        Tail.emplace(make.makeTail(effect));
      }
      if (make.lightFrom != nullptr)
      {
        const std::string& strength = effect.form().parameters.front().name;
        Lights.push_back({ make.lightFrom, effect.perChannel(strength).cast<float>() });
      }
      if (make.makePixels != nullptr)
      {
        OnPixels.push_back(make.makePixels(effect));
      }
    }
    if (!displacements.empty())
    {
      Registration.emplace(std::move(displacements), extent);
    }
  }

  int wavelengths() const { return static_cast<int>(Chain.camera().wavelengths().size()); }
  int channels() const { return static_cast<int>(Chain.camera().channelCount()); }

  int halo() const { return Lights.empty() ? reach() : std::max(Extent.width, Extent.height); }

  // Of the neighbourhood alone.
  int reach() const
  {
    return (Registration ? Registration->reach() : 0) + (Blur ? Blur->radius() : 0) +
      (Tail ? Tail->reach() : 0);
  }

  void requireWindow(const ImageWindow& window, const int* medium) const
  {
    if (window.width < 1 || window.height < 1 || !wholeImage(Extent).contains(window))
    {
      reject("the window of ", describe(window), " does not lie in the image of ", Extent.width,
        " x ", Extent.height, " pixels");
    }
    if (Chain.needsMedium() && medium == nullptr)
    {
      reject("an effect of the camera acts on one medium, but the image comes without media");
    }
  }

  // Of a place along an axis with so many pixels.
  double fieldAt(int place, int pixels) const
  {
    const double half = 0.5 * std::max(1, std::max(Extent.width, Extent.height) - 1);
    return (place - 0.5 * (pixels - 1)) / half;
  }

  // Where the pixels from (x, y) to the right lie.
  ColumnContext placesOf(int x, int y, int count, ImageWorkspace& work) const
  {
    work.fieldY.assign(static_cast<std::size_t>(count), fieldAt(y, Extent.height));
    return { nullptr, FieldX.data() + x, work.fieldY.data() };
  }

  // The light on the detector, pixel by pixel: a run of at most BlockPixels pixels of one row.
  void irradiate(const float* reflectance, const int* medium, int x, int y, int count,
    float* signal, ImageWorkspace& work) const
  {
    const auto size = static_cast<std::size_t>(count);
    ColumnContext columns = placesOf(x, y, count, work);
    const float* source = reflectance;
    if (Chain.needsMedium())
    {
      work.medium.resize(size);
      for (std::size_t i = 0; i < size; ++i)
      {
        const bool known =
          medium[i] >= 0 && static_cast<std::size_t>(medium[i]) < MediumNumber.size();
        work.medium[i] = known ? MediumNumber[static_cast<std::size_t>(medium[i])] : -1;
      }
      columns.medium = work.medium.data();
      work.reflectance.assign(
        reflectance, reflectance + size * static_cast<std::size_t>(wavelengths()));
      Chain.reflect<float>(blockOf(work.reflectance.data(), wavelengths(), count), columns);
      source = work.reflectance.data();
    }
    Chain.integrate(source, signal, count);
    Chain.illuminate<float>(blockOf(signal, channels(), count), columns);
  }

  // A row of `region` in runs: use(reflectance and media of the run, x, count).
  template <typename Use>
  void forRuns(const SceneView& scene, const ImageWindow& region, int y, const Use& use) const
  {
    for (int x = region.x; x < region.x + region.width; x += BlockPixels)
    {
      const int count = std::min(BlockPixels, region.x + region.width - x);
      const std::size_t pixel = scene.pixel(x, y);
      use(scene.reflectance + pixel * static_cast<std::size_t>(wavelengths()),
        scene.medium == nullptr ? nullptr : scene.medium + pixel, x, count);
    }
  }

  // Adds the light that falls on the pixels from (x, y) to the right from elsewhere.
  void addLights(Eigen::Map<Eigen::MatrixXf> block, const SceneView& scene, int x, int y,
    ImageWorkspace& work) const
  {
    work.surround.resize(static_cast<std::size_t>(channels()));
    const Eigen::Map<const Eigen::ArrayXf> other(work.surround.data(), channels());
    for (const OtherLight& light : Lights)
    {
      for (Eigen::Index j = 0; j < block.cols(); ++j)
      {
        const ImagePlace from = light.from({ x + static_cast<int>(j), y }, Extent);
        forRuns(scene, { from.x, from.y, 1, 1 }, from.y,
          [&](const float* source, const int* media, int at, int run)
          { irradiate(source, media, at, from.y, run, work.surround.data(), work); });
        block.col(j).array() += light.strength * other;
      }
    }
  }

  // Hands a row to an effect that needs rows in turn, where it acts: use(row) gets those that are complete.
  template <typename Rows, typename Use>
  static void pass(bool acts, Rows& rows, const float* row, const Use& use)
  {
    if (acts)
    {
      rows.push(row, use);
      return;
    }
    use(row);
  }

  // Stray light, detector, noise: a row of the window, in place. tail: null where there is none.
  void detectRow(float* signal, const float* tail, const SceneView& scene,
    const ImageWindow& window, int y, const Eigen::VectorXf& mean, ImageWorkspace& work) const
  {
    for (int x = 0; x < window.width; x += BlockPixels)
    {
      const std::ptrdiff_t place = static_cast<std::ptrdiff_t>(x) * channels();
      detect(signal + place, tail == nullptr ? nullptr : tail + place, scene, window.x + x, y,
        std::min(BlockPixels, window.width - x), mean, work);
    }
  }

  void detect(float* signal, const float* scattered, const SceneView& scene, int x, int y,
    int count, const Eigen::VectorXf& mean, ImageWorkspace& work) const
  {
    auto block = blockOf(signal, channels(), count);
    if (scattered != nullptr)
    {
      const Eigen::Map<const Eigen::MatrixXf> tail(scattered, channels(), count);
      Chain.localStrayLight()->mix<float>(block, tail);
    }
    if (Chain.veilingGlare() != nullptr)
    {
      work.surround.resize(static_cast<std::size_t>(block.size()));
      auto surround = blockOf(work.surround.data(), channels(), count);
      surround.colwise() = mean;
      Chain.veilingGlare()->mix<float>(block, surround);
    }
    if (!Lights.empty())
    {
      addLights(block, scene, x, y, work);
    }
    for (const PixelOperator& change : OnPixels)
    {
      change(block, x, y);
    }
    Chain.detect<float>(block, placesOf(x, y, count, work));
    const auto firstPixel =
      static_cast<std::uint64_t>(y) * static_cast<std::uint64_t>(Extent.width) +
      static_cast<std::uint64_t>(x);
    Noise(block, firstPixel, Exposure);
  }

  void simulate(const SceneView& scene, const ImageWindow& region, const ImageWindow& window,
    const Eigen::VectorXf& mean, float* response, ImageWorkspace& work) const
  {
    if (Registration)
    {
      work.registration.begin(*Registration, region);
    }
    if (Blur)
    {
      work.blur.begin(*Blur, region.width, region.height);
    }
    if (Tail)
    {
      work.tail.begin(*Tail, channels(), region.width, region.height);
    }
    const auto perPixel = static_cast<std::size_t>(channels());
    const std::size_t count = static_cast<std::size_t>(window.width) * perPixel;
    const std::size_t left = static_cast<std::size_t>(window.x - region.x) * perPixel;
    // The window's part of a row of the region; null outside.
    const auto responseRow = [&](int y)
    {
      return y < window.y || y >= window.y + window.height
        ? nullptr
        : response + static_cast<std::size_t>(y - window.y) * count;
    };
    work.row.resize(static_cast<std::size_t>(region.width) * perPixel);
    int focused = region.y;
    int scattered = region.y;
    const auto useTail = [&](const float* tail)
    {
      const int y = scattered++;
      if (float* out = responseRow(y))
      {
        detectRow(out, tail + left, scene, window, y, mean, work);
      }
    };
    const auto useFocused = [&](const float* row)
    {
      const int y = focused++;
      float* out = responseRow(y);
      if (out != nullptr)
      {
        std::copy_n(row + left, count, out);
      }
      if (Tail)
      {
        work.tail.push(row, useTail);
      }
      else if (out != nullptr)
      {
        detectRow(out, nullptr, scene, window, y, mean, work);
      }
    };
    for (int y = region.y; y < region.y + region.height; ++y)
    {
      forRuns(scene, region, y,
        [&](const float* source, const int* media, int x, int run)
        {
          const std::size_t place = static_cast<std::size_t>(x - region.x) * perPixel;
          irradiate(source, media, x, y, run, work.row.data() + place, work);
        });
      pass(Registration.has_value(), work.registration, work.row.data(),
        [&](const float* registered)
        { pass(Blur.has_value(), work.blur, registered, useFocused); });
    }
  }
};

ImageSimulator::ImageSimulator(CameraModel camera, std::vector<CameraEffect> effects,
  const ImageExtent& extent, const ImageSimulatorOptions& options)
  : Self(std::make_unique<Implementation>(std::move(camera), std::move(effects), extent, options))
{
}

ImageSimulator::~ImageSimulator() = default;
ImageSimulator::ImageSimulator(ImageSimulator&&) noexcept = default;
ImageSimulator& ImageSimulator::operator=(ImageSimulator&&) noexcept = default;

int ImageSimulator::wavelengthCount() const noexcept
{
  return Self->wavelengths();
}
int ImageSimulator::channelCount() const noexcept
{
  return Self->channels();
}
int ImageSimulator::halo() const noexcept
{
  return Self->halo();
}
bool ImageSimulator::needsSceneMean() const noexcept
{
  return Self->Chain.veilingGlare() != nullptr;
}
bool ImageSimulator::needsMedium() const noexcept
{
  return Self->Chain.needsMedium();
}

void ImageSimulator::addToMean(const float* reflectance, const int* medium,
  const ImageWindow& window, SceneMean& mean, ImageWorkspace& workspace) const
{
  Self->requireWindow(window, medium);
  workspace.row.resize(
    static_cast<std::size_t>(BlockPixels) * static_cast<std::size_t>(channelCount()));
  float* signal = workspace.row.data();
  for (int y = window.y; y < window.y + window.height; ++y)
  {
    Self->forRuns({ reflectance, medium, window }, window, y,
      [&](const float* source, const int* media, int x, int count)
      {
        Self->irradiate(source, media, x, y, count, signal, workspace);
        mean.add(signal, count);
      });
  }
}

void ImageSimulator::simulate(const float* reflectance, const int* medium,
  const ImageWindow& available, const ImageWindow& window, const SceneMean* mean, float* response,
  ImageWorkspace& workspace) const
{
  Self->requireWindow(window, medium);
  const ImageWindow needed = grown(window, halo(), Self->Extent);
  if (!available.contains(needed))
  {
    reject("the window of ", describe(window), " depends on ", describe(needed), ", but only ",
      describe(available), " are available");
  }
  if (needsSceneMean() && mean == nullptr)
  {
    reject("the effect veiling_glare needs the mean of the scene");
  }
  const Eigen::VectorXf glare = needsSceneMean() ? mean->value() : Eigen::VectorXf();
  const ImageWindow region = grown(window, Self->reach(), Self->Extent);
  Self->simulate({ reflectance, medium, available }, region, window, glare, response, workspace);
}

} // namespace msi
