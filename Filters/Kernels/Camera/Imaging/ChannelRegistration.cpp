#include "Kernels/Camera/Imaging/ChannelRegistration.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
// Cubic convolution around a place on an axis: weights of the pixels from `first` on.
struct Cubic
{
  int first;
  std::array<float, 4> weight;
};

Cubic cubicAt(double place)
{
  const double below = std::floor(place);
  const double t = place - below;
  const double t2 = t * t;
  const double t3 = t2 * t;
  return { static_cast<int>(below) - 1,
    { static_cast<float>(-0.5 * t + t2 - 0.5 * t3), static_cast<float>(1.0 - 2.5 * t2 + 1.5 * t3),
      static_cast<float>(0.5 * t + 2.0 * t2 - 1.5 * t3),
      static_cast<float>(-0.5 * t2 + 0.5 * t3) } };
}

// Where the output position of an axis lies in the image before.
Cubic sourceOf(int position, int extent, double displacement, double magnification)
{
  const double middle = 0.5 * (extent - 1);
  return cubicAt(middle + (position - middle - displacement) / (1.0 + magnification));
}
}

ChannelRegistration::ChannelRegistration(Eigen::ArrayXd right, Eigen::ArrayXd down,
  Eigen::ArrayXd magnification, const ImageExtent& extent)
  : Right(std::move(right))
  , Down(std::move(down))
  , Magnification(std::move(magnification))
  , Extent(extent)
  , Reach(0)
{
  if (Right.size() != Down.size() || Right.size() != Magnification.size())
  {
    std::ostringstream message;
    message << "a registration has " << Right.size() << " displacements to the right, "
            << Down.size() << " down and " << Magnification.size()
            << " magnifications; expected one of each for every channel";
    throw std::invalid_argument(message.str());
  }
  const double half = 0.5 * std::max(extent.width, extent.height);
  for (Eigen::Index k = 0; k < Right.size(); ++k)
  {
    const double largest =
      std::max(std::abs(Right[k]), std::abs(Down[k])) + std::abs(Magnification[k]) * half;
    Reach = std::max(Reach, static_cast<int>(std::ceil(largest / (1.0 + Magnification[k]))) + 2);
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
  Down = registration.Down;
  Magnification = registration.Magnification;
  Reach = registration.Reach;
  Channels = static_cast<std::size_t>(Down.size());
  Count = static_cast<std::size_t>(window.width) * Channels;
  Taken = 0;
  Given = 0;
  Span = std::min(2 * Reach + 1, window.height);
  Ring.resize(static_cast<std::size_t>(Span) * Count);
  Out.resize(Count);
  for (std::size_t tap = 0; tap < Taps; ++tap)
  {
    Along.from[tap].resize(Count);
    Along.weight[tap].resize(Count);
    Across.from[tap].resize(Channels);
    Across.weight[tap].resize(Channels);
  }
  for (std::size_t i = 0; i < Count; ++i)
  {
    const auto x = static_cast<int>(i / Channels);
    const auto k = static_cast<Eigen::Index>(i % Channels);
    const Cubic cubic =
      sourceOf(window.x + x, Extent.width, registration.Right[k], Magnification[k]);
    for (std::size_t tap = 0; tap < Taps; ++tap)
    {
      const int from = cubic.first + static_cast<int>(tap) - window.x;
      Along.from[tap][i] =
        static_cast<std::ptrdiff_t>(std::clamp(from, 0, window.width - 1)) * Down.size() + k;
      Along.weight[tap][i] = cubic.weight[tap];
    }
  }
}

void RegistrationRows::take(const float* row)
{
  float* out = Ring.data() + static_cast<std::size_t>(Taken % Span) * Count;
  for (std::size_t i = 0; i < Count; ++i)
  {
    float sum = 0.0F;
    for (std::size_t tap = 0; tap < Taps; ++tap)
    {
      sum += Along.weight[tap][i] * row[Along.from[tap][i]];
    }
    out[i] = sum;
  }
  ++Taken;
}

const float* RegistrationRows::next()
{
  for (std::size_t channel = 0; channel < Channels; ++channel)
  {
    const auto k = static_cast<Eigen::Index>(channel);
    const Cubic cubic = sourceOf(Window.y + Given, Extent.height, Down[k], Magnification[k]);
    for (std::size_t tap = 0; tap < Taps; ++tap)
    {
      const int from = cubic.first + static_cast<int>(tap) - Window.y;
      const int row = std::clamp(from, 0, Window.height - 1) % Span;
      Across.from[tap][channel] =
        static_cast<std::ptrdiff_t>(row) * static_cast<std::ptrdiff_t>(Count) + k;
      Across.weight[tap][channel] = cubic.weight[tap];
    }
  }
  const float* ring = Ring.data();
  for (std::size_t first = 0; first < Count; first += Channels, ring += Channels)
  {
    for (std::size_t k = 0; k < Channels; ++k)
    {
      float sum = 0.0F;
      for (std::size_t tap = 0; tap < Taps; ++tap)
      {
        sum += Across.weight[tap][k] * ring[Across.from[tap][k]];
      }
      Out[first + k] = sum;
    }
  }
  ++Given;
  return Out.data();
}

} // namespace msi
