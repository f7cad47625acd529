#include "Kernels/Camera/Imaging/ChannelRegistration.h"

#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
constexpr int Taps = 4;

// Where one output position of one channel reads: four neighbours from First on.
struct Reading
{
  std::array<int, Taps> position;
  std::array<float, Taps> weight;
};

Reading readingAt(double source, int lowest, int highest)
{
  const double below = std::floor(source);
  const double t = source - below;
  const double t2 = t * t;
  const double t3 = t2 * t;
  Reading reading;
  reading.weight = { static_cast<float>(-0.5 * t + t2 - 0.5 * t3),
    static_cast<float>(1.0 - 2.5 * t2 + 1.5 * t3),
    static_cast<float>(0.5 * t + 2.0 * t2 - 1.5 * t3), static_cast<float>(-0.5 * t2 + 0.5 * t3) };
  for (int i = 0; i < Taps; ++i)
  {
    reading.position[static_cast<std::size_t>(i)] =
      std::min(std::max(static_cast<int>(below) - 1 + i, lowest), highest);
  }
  return reading;
}

// The readings of all positions of an axis, channel by channel within a position.
std::vector<Reading> readings(int first, int count, int extent, const Eigen::ArrayXd& displacement,
  const Eigen::ArrayXd& magnification)
{
  const double middle = 0.5 * (extent - 1);
  std::vector<Reading> all;
  all.reserve(static_cast<std::size_t>(count) * static_cast<std::size_t>(displacement.size()));
  for (int position = first; position < first + count; ++position)
  {
    for (Eigen::Index k = 0; k < displacement.size(); ++k)
    {
      const double source =
        middle + (position - middle - displacement[k]) / (1.0 + magnification[k]);
      all.push_back(readingAt(source, first, first + count - 1));
    }
  }
  return all;
}

// `step` floats lie between neighbours on the axis.
void readAlong(const Reading* reading, const float* line, std::ptrdiff_t step, int first,
  int channels, float* out) noexcept
{
  for (int k = 0; k < channels; ++k)
  {
    float sum = 0.0F;
    for (std::size_t i = 0; i < Taps; ++i)
    {
      sum += reading[k].weight[i] * line[(reading[k].position[i] - first) * step + k];
    }
    out[k] = sum;
  }
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
  const int channels = buffer.channels;
  scratch.resize(window, channels);
  const auto columns = readings(window.x, window.width, Extent.width, Right, Magnification);
  const auto rows = readings(window.y, window.height, Extent.height, Down, Magnification);
  const std::ptrdiff_t pixelStep = channels;
  const std::ptrdiff_t rowStep = pixelStep * window.width;
  for (int y = window.y; y < window.y + window.height; ++y)
  {
    for (int x = window.x; x < window.x + window.width; ++x)
    {
      readAlong(columns.data() + (x - window.x) * pixelStep, buffer.pixel(window.x, y), pixelStep,
        window.x, channels, scratch.pixel(x, y));
    }
  }
  for (int y = window.y; y < window.y + window.height; ++y)
  {
    for (int x = window.x; x < window.x + window.width; ++x)
    {
      readAlong(rows.data() + (y - window.y) * pixelStep, scratch.pixel(x, window.y), rowStep,
        window.y, channels, buffer.pixel(x, y));
    }
  }
}

} // namespace msi
