// What happens to the scene before the detector.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldModel.h"
#include "Kernels/Gap/Field/FieldPair.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace msi
{

// Out of the source at middle + R(-rotation) (position - middle - displacement) / (1 + magnification), as
// ChannelRegistration.
class FieldDisplacement
{
public:
  struct Place
  {
    double right;
    double down;
  };

  FieldDisplacement(const FieldPair& pair, const FieldModel& model, Eigen::Index channel);

  // Not the same everywhere.
  bool varies() const noexcept { return Varies; }
  Place at(double x, double y) const noexcept;
  Place atMiddle(const ImageWindow& window) const noexcept
  {
    return at(window.x + 0.5 * (window.width - 1), window.y + 0.5 * (window.height - 1));
  }
  // At (x, y) beyond that in the middle of the window.
  Place beyondMiddle(const ImageWindow& window, double x, double y) const noexcept;

private:
  const FieldPair* Pair;
  Place Moved;
  double Cosine; // over 1 + magnification
  double Sine;
  bool Varies;
};

// Cubic convolution for a displacement (as ChannelRegistration) with a Gaussian of a variance, along one axis.
class AxisKernels
{
public:
  // A kernel with weights from `first` on.
  struct Taps
  {
    int first = 0;
    std::vector<double> weight;
  };

  AxisKernels(double displacement, double variance);

  Taps value, shift, blur; // itself, its derivatives by displacement and variance
};

struct FieldNeighbourhood
{
  Eigen::ArrayXXd value, right, down, blur; // width x height

  // derivatives: false leaves right, down and blur empty.
  FieldNeighbourhood(const FieldData& data, const ImageWindow& window, Eigen::Index channel,
    const AxisKernels& x, const AxisKernels& y, bool derivatives);
};

using TailSurround = Eigen::Array<double, TailPasses, 1>;

// In one block and channel. Holds references.
class BlockLight
{
public:
  BlockLight(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
    const FieldBlock& block, Eigen::Index channel, bool derivatives);

  const FieldNeighbourhood& scene() const noexcept { return Near; }
  double fraction() const { return Weights.sum(); }
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
