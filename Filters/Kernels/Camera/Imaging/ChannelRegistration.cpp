#include "Kernels/Camera/Imaging/ChannelRegistration.h"

#include "Kernels/Camera/Imaging/WeightedSum.h"

#include <algorithm>
#include <cmath>
#include <utility>

namespace msi
{

namespace
{
// A row's weights are repeated over so many pixels that a loop over them is worth its start.
constexpr std::size_t RegisteredPixels = 32;

constexpr int Points = 6;

// Around a place on an axis: weights of the pixels from `first` on.
struct Near
{
  int first;
  SixPoints<float> weight;
};

Near nearTo(double place)
{
  const double below = std::floor(place);
  return { static_cast<int>(below) - 2, sixPointConvolution(place - below).cast<float>() };
}

// The pixels that all channels together read.
struct Span
{
  int first;
  int last;
};

Span spanOf(const Near* places, std::size_t channels)
{
  Span span{ places[0].first, places[0].first };
  for (std::size_t k = 1; k < channels; ++k)
  {
    span.first = std::min(span.first, places[k].first);
    span.last = std::max(span.last, places[k].first);
  }
  span.last += Points - 1;
  return span;
}

// The channels' weights on the pixels of their span, `step` apart.
void spread(const Near* places, std::size_t channels, std::size_t step, float* weights)
{
  const int first = spanOf(places, channels).first;
  for (std::size_t k = 0; k < channels; ++k)
  {
    const auto tap = static_cast<std::size_t>(places[k].first - first);
    for (std::size_t i = 0; i < Points; ++i)
    {
      weights[(tap + i) * step + k] = places[k].weight[static_cast<Eigen::Index>(i)];
    }
  }
}

// Where the output position of an axis lies in the image before.
Near sourceOf(int position, int extent, double displacement, double magnification)
{
  const double middle = 0.5 * (extent - 1);
  return nearTo(middle + (position - middle - displacement) / (1.0 + magnification));
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
    Reach = std::max(Reach, static_cast<int>(std::ceil(farthest)) + Points / 2);
  }
}

void ChannelRegistration::operator()(PixelBuffer& buffer, PixelBuffer& scratch) const
{
  RegistrationRows rows;
  rows.begin(*this, buffer.window);
  scratch.resize(buffer.window, buffer.channels);
  filterRows(rows, buffer, scratch);
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
  std::vector<Near> places(Count);
  Runs.clear();
  int most = 0;
  for (int x = 0; x < window.width; ++x)
  {
    Near* place = places.data() + static_cast<std::size_t>(x) * Channels;
    for (std::size_t k = 0; k < Channels; ++k)
    {
      place[k] = sourceOf(
        window.x + x, Extent.width, Displacements[k].right, Displacements[k].magnification);
    }
    const Span span = spanOf(place, Channels);
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
    spread(places.data() + x * Channels, Channels, Count, Weights.data() + x * Channels);
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
      const Near across = nearTo(middleX + place.x());
      const Near down = nearTo(middleY + place.y());
      float sum = 0.0F;
      for (int v = 0; v < Points; ++v)
      {
        const float* row = Ring.row(std::clamp(down.first + v - Window.y, 0, Window.height - 1));
        float along = 0.0F;
        for (int u = 0; u < Points; ++u)
        {
          const int at = std::clamp(across.first + u - Window.x, 0, Window.width - 1);
          along += across.weight[u] * row[at * channels + k];
        }
        sum += down.weight[v] * along;
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
  std::vector<Near> places(Channels);
  for (std::size_t k = 0; k < Channels; ++k)
  {
    places[k] = sourceOf(
      Window.y + Given, Extent.height, Displacements[k].down, Displacements[k].magnification);
  }
  const Span span = spanOf(places.data(), Channels);
  const int pixels = span.last - span.first + 1;
  const auto taps = static_cast<std::size_t>(pixels);
  const std::size_t period = RegisteredPixels * Channels;
  RowWeights.assign(taps * period, 0.0F);
  for (std::size_t i = 0; i < RegisteredPixels; ++i)
  {
    spread(places.data(), Channels, period, RowWeights.data() + i * Channels);
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
