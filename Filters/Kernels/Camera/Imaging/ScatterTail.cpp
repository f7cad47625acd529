#include "Kernels/Camera/Imaging/ScatterTail.h"

#include "Kernels/Camera/Imaging/WeightedSum.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double SmallestRadius = 1.0;
constexpr double LargestRadius = 64.0;
constexpr double Negligible = 1e-4;
}

double splineDeviation(int passes)
{
  return std::sqrt((std::pow(4.0, passes) - 1.0) / 3.0);
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

ScatterTail::ScatterTail(double radius)
{
  if (!(radius >= SmallestRadius && radius <= LargestRadius))
  {
    reject("the radius of the stray light is ", radius, " pixels; expected a value from ",
      SmallestRadius, " to ", LargestRadius);
  }
  std::vector<double> weights;
  double sum = 0.0;
  for (int pass = 1;; ++pass)
  {
    const double weight = std::exp2(-pass) * std::exp(-splineDeviation(pass) / (2.0 * radius));
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

ScatterTail::ScatterTail(const std::vector<double>& weights)
  : Weights(weights.begin(), weights.end())
{
}

int ScatterTail::reach() const noexcept
{
  return splineReach(static_cast<int>(Weights.size()));
}

void ScatterTail::operator()(const PixelBuffer& buffer, PixelBuffer& tail) const
{
  const ImageWindow& window = buffer.window;
  tail.resize(window, buffer.channels);
  ScatterRows rows;
  rows.begin(*this, buffer.channels, window.width, window.height);
  filterRows(rows, buffer, tail);
}

std::vector<double> passWeights(double radius, std::size_t passes)
{
  std::vector<double> weights(passes, 0.0);
  std::size_t pass = 0;
  const ScatterTail tail(std::clamp(radius, SmallestRadius, LargestRadius));
  for (const float weight : tail.weights())
  {
    weights[std::min(pass++, passes - 1)] += static_cast<double>(weight);
  }
  return weights;
}

void ScatterRows::begin(const ScatterTail& tail, int channels, int width, int height)
{
  Weights = tail.weights();
  Passes.resize(Weights.size());
  int stride = 1;
  for (RowConvolution& pass : Passes)
  {
    pass.begin(splineKernel(channels, stride), width, height);
    stride *= 2;
  }
  Given.assign(Weights.size(), 0);
  Count = static_cast<std::size_t>(width) * static_cast<std::size_t>(channels);
  Sums.begin(std::min(tail.reach() + 1, height), Count);
}

float* ScatterRows::add(std::size_t number, const float* out)
{
  float* sum = Sums.row(Given[number]++);
  if (number == 0)
  {
    std::fill_n(sum, Count, 0.0F);
  }
  addScaled(Weights[number], out, sum, Count);
  return sum;
}

} // namespace msi
