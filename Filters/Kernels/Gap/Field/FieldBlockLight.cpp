#include "Kernels/Gap/Field/FieldBlockLight.h"

#include "Kernels/Gap/Field/FieldColumns.h"

#include <algorithm>

namespace msi
{

namespace
{
FieldNeighbourhood near(const FieldData& data, const FieldModel& model, const ImageWindow& window,
  Eigen::Index channel, const FieldDisplacement& where, bool derivatives)
{
  const double variance = std::max(model.at(ImageParameter::BlurVariance, channel), 0.0);
  const FieldDisplacement::Place middle = where.atMiddle(window);
  return { data, window, channel, AxisKernels(middle.right, variance),
    AxisKernels(middle.down, variance), derivatives || where.varies() };
}
}

BlockLight::BlockLight(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, Eigen::Index channel, bool derivatives)
  : Block(block)
  , K(static_cast<std::size_t>(data.channels()))
  , Channel(static_cast<std::size_t>(channel))
  , Where(data.pair, model, channel)
  , Near(near(data, model, block.window, channel, Where, derivatives))
  , Weights(model.at(ImageParameter::TailFraction, channel) *
      tailWeights(model.at(ImageParameter::TailRadius, channel)).head<TailPasses>())
  , Added((model.at(ImageParameter::Glare, channel) +
            model.at(ImageParameter::ConservingGlare, channel)) *
      glare[channel])
  , Lost(1.0 - model.at(ImageParameter::ConservingGlare, channel))
{
  for (int i = 0; i < FreePasses; ++i)
  {
    Weights[i + 1] += model.at(surroundWeight(i), channel);
  }
  Fraction = Weights.sum();
  for (std::size_t number = 0; number < imageLights().size(); ++number)
  {
    Strength.push_back(model.at(imageLight(number), channel));
    for (int i = 0; i < static_cast<int>(block.window.pixels()); ++i)
    {
      const ImagePlace pixel{ block.window.x + i % block.window.width,
        block.window.y + i / block.window.width };
      Others.push_back(
        lightElsewhere(data.pair, data.scene, model, imageLights()[number], pixel, Channel));
    }
  }
}

std::vector<double> fieldFactors(
  const FieldData& data, const FieldModel& model, const ImageWindow& window)
{
  std::vector<double> factors;
  for (int y = window.y; y < window.y + window.height; ++y)
  {
    for (int x = window.x; x < window.x + window.width; ++x)
    {
      factors.push_back(model.fieldFactor(data.pair.fieldX(x), data.pair.fieldY(y)));
    }
  }
  return factors;
}

} // namespace msi
