#include "Kernels/Gap/Field/FieldPair.h"

#include <cmath>
#include <limits>

namespace msi
{

namespace
{
constexpr double DarkFrame = 0.25; // of the mean of all

using ImageValues = Eigen::Map<const Eigen::ArrayXXf>; // K x pixels

// Numbers of the pixels that are 0 in all channels, from the border on.
std::vector<Eigen::Index> zerosFromBorder(const ImageValues& image, const ImageExtent& extent)
{
  std::vector<char> known(static_cast<std::size_t>(image.cols()), 0);
  std::vector<Eigen::Index> zeros;
  const auto look = [&](Eigen::Index x, Eigen::Index y)
  {
    const Eigen::Index pixel = y * extent.width + x;
    if (x >= 0 && y >= 0 && x < extent.width && y < extent.height &&
      known[static_cast<std::size_t>(pixel)] == 0 && (image.col(pixel) == 0.0F).all())
    {
      known[static_cast<std::size_t>(pixel)] = 1;
      zeros.push_back(pixel);
    }
  };
  for (int i = 0; i < std::max(extent.width, extent.height); ++i)
  {
    look(i, 0);
    look(i, extent.height - 1);
    look(0, i);
    look(extent.width - 1, i);
  }
  for (std::size_t next = 0; next < zeros.size();)
  {
    const Eigen::Index pixel = zeros[next++];
    const Eigen::Index x = pixel % extent.width;
    const Eigen::Index y = pixel / extent.width;
    look(x - 1, y);
    look(x + 1, y);
    look(x, y - 1);
    look(x, y + 1);
  }
  return zeros;
}

template <typename Values>
double meanOf(const Values& values)
{
  const auto known = values.isFinite();
  return known.select(values.template cast<double>(), 0.0).sum() /
    std::fmax(static_cast<double>(known.count()), 1.0);
}
}

FieldPair withoutFrame(FieldPair pair)
{
  const auto values = [&](const float* image) -> ImageValues
  {
    return { image, static_cast<Eigen::Index>(pair.channels.size()),
      static_cast<Eigen::Index>(pair.pixels()) };
  };
  const auto side = static_cast<std::size_t>(std::min(pair.extent.width, pair.extent.height));
  const ImageValues simulated = values(pair.simulated);
  const auto take = [&](const float*& image, const ImageValues& other)
  {
    const std::vector<Eigen::Index> frame = zerosFromBorder(values(image), pair.extent);
    if (2 * frame.size() >= side && 2 * frame.size() <= pair.pixels() &&
      meanOf(other(Eigen::all, frame)) >= DarkFrame * meanOf(other))
    {
      Eigen::MatrixXf inside = values(image);
      inside(Eigen::all, frame).setConstant(std::numeric_limits<float>::quiet_NaN());
      pair.own.push_back(std::make_shared<const Eigen::MatrixXf>(std::move(inside)));
      image = pair.own.back()->data();
      pair.framePart += static_cast<double>(frame.size()) / static_cast<double>(pair.pixels());
    }
  };
  const ImageValues real = values(pair.real);
  take(pair.real, simulated);
  take(pair.simulated, real);
  return pair;
}

} // namespace msi
