#include "Kernels/Camera/Imaging/ScatterTail.h"

#include "Kernels/Camera/Imaging/SeparableFilter.h"

#include <cmath>
#include <sstream>
#include <stdexcept>

namespace msi
{

namespace
{
constexpr double SmallestRadius = 1.0;
constexpr double LargestRadius = 64.0;
constexpr double Negligible = 1e-4;

double deviationAfter(int pass)
{
  return std::sqrt((std::pow(4.0, pass) - 1.0) / 3.0);
}

SymmetricKernel splineKernel(int channels, int stride)
{
  SymmetricKernel kernel;
  kernel.weights.resize(channels, 3);
  kernel.weights.col(0).setConstant(6.0F / 16.0F);
  kernel.weights.col(1).setConstant(4.0F / 16.0F);
  kernel.weights.col(2).setConstant(1.0F / 16.0F);
  kernel.stride = stride;
  return kernel;
}
}

ScatterTail::ScatterTail(double radius)
{
  if (!(radius >= SmallestRadius && radius <= LargestRadius))
  {
    std::ostringstream message;
    message << "the radius of the stray light is " << radius << " pixels; expected a value from "
            << SmallestRadius << " to " << LargestRadius;
    throw std::invalid_argument(message.str());
  }
  std::vector<double> weights;
  double sum = 0.0;
  for (int pass = 1;; ++pass)
  {
    const double weight = std::exp2(-pass) * std::exp(-deviationAfter(pass) / (2.0 * radius));
    if (pass > 2 && weight < Negligible * sum)
    {
      break;
    }
    weights.push_back(weight);
    sum += weight;
  }
  for (const double weight : weights)
  {
    Weights.push_back(static_cast<float>(weight / sum));
  }
}

int ScatterTail::reach() const noexcept
{
  // 2 pixels times 1, 2, 4, ...
  return 2 * ((1 << Weights.size()) - 1);
}

void ScatterTail::operator()(PixelBuffer& buffer, PixelBuffer& tail) const
{
  tail.resize(buffer.window, buffer.channels);
  std::fill(tail.values.begin(), tail.values.end(), 0.0F);
  int stride = 1;
  for (const float weight : Weights)
  {
    convolve(splineKernel(buffer.channels, stride), buffer);
    for (std::size_t i = 0; i < tail.values.size(); ++i)
    {
      tail.values[i] += weight * buffer.values[i];
    }
    stride *= 2;
  }
}

} // namespace msi
