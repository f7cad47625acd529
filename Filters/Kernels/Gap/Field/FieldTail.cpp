#include "Kernels/Gap/Field/FieldTail.h"

#include "Kernels/Camera/Imaging/ScatterTail.h"
#include "Kernels/Gap/Field/FieldColumns.h"

#include <cmath>
#include <limits>

namespace msi
{

namespace
{
constexpr int RadiusSteps = 48;
}

TailForm tailForm(const FieldModel& model)
{
  Eigen::ArrayXd weight = Eigen::ArrayXd::Zero(TailPasses);
  for (int i = 0; i < FreePasses; ++i)
  {
    weight[i + 1] = model.at(surroundWeight(i), 0);
  }
  TailForm best{ 0.0, 0.0 };
  double least = std::numeric_limits<double>::infinity();
  for (int step = 0; step <= RadiusSteps; ++step)
  {
    const double radius = std::exp2(6.0 * step / RadiusSteps); // 1 .. 64 pixels
    const Eigen::ArrayXd form = tailWeights(radius);
    const double fraction = (form * weight).sum() / form.square().sum();
    const double error = (weight - fraction * form).square().sum();
    if (error < least)
    {
      least = error;
      best = { fraction, radius };
    }
  }
  return best;
}

FieldTail::FieldTail(const FieldModel& model)
  : Model(model)
{
  for (int i = 0; i < FreePasses; ++i)
  {
    Neutral = Neutral && model.isNeutral(surroundWeight(i));
  }
}

void FieldTail::operator()(PixelBuffer& signal, PixelBuffer& wide) const
{
  wide = signal;
  const auto K = static_cast<std::size_t>(signal.channels);
  PixelBuffer sharp = signal;
  for (int pass = 0; pass < TailPasses; ++pass)
  {
    convolve(splineKernel(signal.channels, 1 << pass), wide);
    for (std::size_t i = 0; pass > 0 && i < signal.values.size(); ++i)
    {
      const auto weight =
        static_cast<float>(Model.at(surroundWeight(pass - 1), static_cast<Eigen::Index>(i % K)));
      signal.values[i] += weight * (wide.values[i] - sharp.values[i]);
    }
  }
}

} // namespace msi
