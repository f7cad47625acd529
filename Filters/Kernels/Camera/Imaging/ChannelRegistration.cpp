#include "Kernels/Camera/Imaging/ChannelRegistration.h"

#include "Kernels/Camera/Imaging/WeightedSum.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <utility>

namespace msi
{

namespace
{
// A row's weights are repeated over so many pixels that a loop over them is worth its start.
constexpr std::size_t RegisteredPixels = 32;

// Cubic convolution around a place on an axis: weights of the pixels from `first` on.
struct Cubic
{
  int first;
  std::array<float, 4> weight;
};

Cubic cubicAt(double place)
{
  const double below = std::floor(place);
  const Eigen::Array4f weight = cubicConvolution(place - below).cast<float>();
  return { static_cast<int>(below) - 1, { weight[0], weight[1], weight[2], weight[3] } };
}

// The pixels that all channels together read.
struct Span
{
  int first;
  int last;
};

Span spanOf(const Cubic* cubics, std::size_t channels)
{
  Span span{ cubics[0].first, cubics[0].first };
  for (std::size_t k = 1; k < channels; ++k)
  {
    span.first = std::min(span.first, cubics[k].first);
    span.last = std::max(span.last, cubics[k].first);
  }
  span.last += 3;
  return span;
}

// The channels' weights on the pixels of their span, `step` apart.
void spread(const Cubic* cubics, std::size_t channels, std::size_t step, float* weights)
{
  const int first = spanOf(cubics, channels).first;
  for (std::size_t k = 0; k < channels; ++k)
  {
    const auto tap = static_cast<std::size_t>(cubics[k].first - first);
    for (std::size_t i = 0; i < cubics[k].weight.size(); ++i)
    {
      weights[(tap + i) * step + k] = cubics[k].weight[i];
    }
  }
}

// Where the output position of an axis lies in the image before.
Cubic sourceOf(int position, int extent, double displacement, double magnification)
{
  const double middle = 0.5 * (extent - 1);
  return cubicAt(middle + (position - middle - displacement) / (1.0 + magnification));
}
}

ChannelRegistration::ChannelRegistration(
  std::vector<ImageDisplacement> displacements, const ImageExtent& extent)
  : Displacements(std::move(displacements))
  , Extent(extent)
{
  for (const ImageDisplacement& displacement : Displacements)
  {
    const double farthest = ShownPlace(displacement, extent).farthest();
    Reach = std::max(Reach, static_cast<int>(std::ceil(farthest)) + 2);
  }
}

void ChannelRegistration::operator()(PixelBuffer& buffer, PixelBuffer& scratch) const
{
  const ImageWindow window = buffer.window;
  RegistrationRows rows;
  rows.begin(*this, window);
  scratch.resize(window, buffer.channels);
  const auto count =
    static_cast<std::size_t>(window.width) * static_cast<std::size_t>(buffer.channels);
  int y = window.y;
  for (int row = window.y; row < window.y + window.height; ++row)
  {
    rows.push(buffer.pixel(window.x, row),
      [&](const float* out) { std::copy_n(out, count, scratch.pixel(window.x, y++)); });
  }
  std::swap(buffer.values, scratch.values);
}

void RegistrationRows::begin(const ChannelRegistration& registration, const ImageWindow& window)
{
  Window = window;
  Extent = registration.Extent;
  Displacements = registration.Displacements;
  Turned = !std::all_of(Displacements.begin(), Displacements.end(),
    [](const ImageDisplacement& displacement) { return displacement.alongAxes(); });
  Reach = registration.Reach;
  Channels = Displacements.size();
  Count = static_cast<std::size_t>(window.width) * Channels;
  Taken = 0;
  Given = 0;
  Ring.begin(std::min(2 * Reach + 1, window.height), Count);
  Out.resize(Count);
  if (!Turned)
  {
    beginAlongAxes();
  }
}

void RegistrationRows::beginAlongAxes()
{
  const ImageWindow& window = Window;
  std::vector<Cubic> cubics(Count);
  Runs.clear();
  int most = 0;
  for (int x = 0; x < window.width; ++x)
  {
    Cubic* cubic = cubics.data() + static_cast<std::size_t>(x) * Channels;
    for (std::size_t k = 0; k < Channels; ++k)
    {
      cubic[k] = sourceOf(
        window.x + x, Extent.width, Displacements[k].right, Displacements[k].magnification);
    }
    const Span span = spanOf(cubic, Channels);
    most = std::max(most, span.last - span.first + 1);
    const int offset = span.first - window.x - x;
    if (Runs.empty() || Runs.back().offset != offset)
    {
      Runs.push_back({ x, offset });
    }
  }
  Taps = static_cast<std::size_t>(most);
  const int margin = Reach + most;
  Margin = static_cast<std::size_t>(margin);
  Weights.assign(Taps * Count, 0.0F);
  for (std::size_t x = 0; x < static_cast<std::size_t>(window.width); ++x)
  {
    spread(cubics.data() + x * Channels, Channels, Count, Weights.data() + x * Channels);
  }
}

void RegistrationRows::take(const float* row)
{
  if (Turned)
  {
    std::copy_n(row, Count, Ring.row(Taken++));
    return;
  }
  padRow(row, Count / Channels, Channels, Margin, Padded);
  float* out = Ring.row(Taken);
  Sources.resize(Taps);
  for (std::size_t run = 0; run < Runs.size(); ++run)
  {
    const auto first = static_cast<std::ptrdiff_t>(Runs[run].first);
    const auto end =
      static_cast<std::ptrdiff_t>(run + 1 < Runs.size() ? Runs[run + 1].first : Window.width);
    const auto channels = static_cast<std::ptrdiff_t>(Channels);
    const std::ptrdiff_t from = first + Runs[run].offset + static_cast<std::ptrdiff_t>(Margin);
    for (std::size_t tap = 0; tap < Taps; ++tap)
    {
      Sources[tap] = Padded.data() + (from + static_cast<std::ptrdiff_t>(tap)) * channels;
    }
    const auto count = static_cast<std::size_t>((end - first) * channels);
    weightedSum(Weights.data() + first * channels, Count, count, Sources.data(), Taps,
      out + first * channels, count);
  }
  ++Taken;
}

void RegistrationRows::turnRow(int y)
{
  const double middleX = 0.5 * (Extent.width - 1);
  const double middleY = 0.5 * (Extent.height - 1);
  const auto channels = static_cast<std::ptrdiff_t>(Channels);
  for (std::ptrdiff_t k = 0; k < channels; ++k)
  {
    const ShownPlace shown(Displacements[static_cast<std::size_t>(k)], Extent);
    for (int i = 0; i < Window.width; ++i)
    {
      const Eigen::Vector2d place = shown({ Window.x + i - middleX, y - middleY });
      const Cubic across = cubicAt(middleX + place.x());
      const Cubic down = cubicAt(middleY + place.y());
      float sum = 0.0F;
      for (int v = 0; v < 4; ++v)
      {
        const float* row = Ring.row(std::clamp(down.first + v - Window.y, 0, Window.height - 1));
        float along = 0.0F;
        for (int u = 0; u < 4; ++u)
        {
          const int at = std::clamp(across.first + u - Window.x, 0, Window.width - 1);
          along += across.weight[static_cast<std::size_t>(u)] * row[at * channels + k];
        }
        sum += down.weight[static_cast<std::size_t>(v)] * along;
      }
      Out[static_cast<std::size_t>(i * channels + k)] = sum;
    }
  }
}

const float* RegistrationRows::next()
{
  if (Turned)
  {
    turnRow(Window.y + Given);
    ++Given;
    return Out.data();
  }
  std::vector<Cubic> cubics(Channels);
  for (std::size_t k = 0; k < Channels; ++k)
  {
    cubics[k] = sourceOf(
      Window.y + Given, Extent.height, Displacements[k].down, Displacements[k].magnification);
  }
  const Span span = spanOf(cubics.data(), Channels);
  const int pixels = span.last - span.first + 1;
  const auto taps = static_cast<std::size_t>(pixels);
  const std::size_t period = RegisteredPixels * Channels;
  RowWeights.assign(taps * period, 0.0F);
  for (std::size_t i = 0; i < RegisteredPixels; ++i)
  {
    spread(cubics.data(), Channels, period, RowWeights.data() + i * Channels);
  }
  Sources.resize(taps);
  for (std::size_t tap = 0; tap < taps; ++tap)
  {
    const int from = span.first + static_cast<int>(tap) - Window.y;
    Sources[tap] = Ring.row(std::clamp(from, 0, Window.height - 1));
  }
  weightedSum(RowWeights.data(), period, period, Sources.data(), taps, Out.data(), Count);
  ++Given;
  return Out.data();
}

} // namespace msi
