// What happens to the scene before the detector.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldDisplacement.h"
#include "Kernels/Gap/Field/FieldNeighbourhood.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace msi
{

using TailSurround = Eigen::Array<double, TailPasses, 1>;

// In one block and channel. Holds references.
class BlockLight
{
public:
  BlockLight(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
    const FieldBlock& block, Eigen::Index channel, bool derivatives);

  const FieldNeighbourhood& scene() const noexcept { return Near; }
  double fraction() const noexcept { return Fraction; }
  double lost() const noexcept { return Lost; }

  TailSurround surround(int pixel) const
  {
    const std::size_t pixels = Block.window.pixels();
    TailSurround values;
    for (std::size_t pass = 0; pass < TailPasses; ++pass)
    {
      values[static_cast<Eigen::Index>(pass)] = static_cast<double>(
        Block.tail[(pass * pixels + static_cast<std::size_t>(pixel)) * K + Channel]);
    }
    return values;
  }
  double self(int pixel) const
  {
    const int x = pixel % Block.window.width;
    const int y = pixel / Block.window.width;
    double value = Near.value(x, y);
    if (Where.varies())
    {
      const FieldDisplacement::Place more =
        Where.beyondMiddle(Block.window, Block.window.x + x, Block.window.y + y);
      value += more.right * Near.right(x, y) + more.down * Near.down(x, y);
    }
    return value;
  }
  // Behind lens and stray light.
  double light(int pixel, double field) const
  {
    const double own = self(pixel);
    return field * (own + (Weights * (surround(pixel) - own)).sum());
  }
  // From elsewhere in the image, at strength one: that of one of imageLights().
  double other(std::size_t number, int pixel) const
  {
    return Others[number * Block.window.pixels() + static_cast<std::size_t>(pixel)];
  }
  double signal(int pixel, double field) const
  {
    double sum = Lost * light(pixel, field) + Added;
    for (std::size_t number = 0; number < Strength.size(); ++number)
    {
      sum += Strength[number] * other(number, pixel);
    }
    return sum;
  }

private:
  const FieldBlock& Block;
  std::size_t K;
  std::size_t Channel;
  FieldDisplacement Where;
  FieldNeighbourhood Near;
  TailSurround Weights;
  double Added;
  double Lost;
  double Fraction = 0.0;
  std::vector<double> Strength, Others; // light after light, pixel after pixel
};

// The light at the place from where it falls on a pixel, too: of the unmoved, unblurred scene, all channels.
inline double lightElsewhere(const FieldPair& pair, const float* scene, const FieldModel& model,
  LightFrom from, const ImagePlace& pixel, std::size_t channel)
{
  const ImagePlace place = from(pixel, pair.extent);
  return model.fieldFactor(pair.fieldX(place.x), pair.fieldY(place.y)) *
    static_cast<double>(scene[pair.index(place.x, place.y) * pair.channels.size() + channel]);
}

// The field's factor at each pixel of a window.
std::vector<double> fieldFactors(
  const FieldData& data, const FieldModel& model, const ImageWindow& window);

} // namespace msi
