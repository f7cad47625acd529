// What happens to the scene before the detector.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldModel.h"
#include "Kernels/Gap/Field/FieldPair.h"

#include <Eigen/Core>

#include <array>
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
  Eigen::ArrayXXd value, right, down, blur; // width x height: by pixel number, too

  FieldNeighbourhood(const FieldData& data, const ImageWindow& window, Eigen::Index channel,
    const AxisKernels& x, const AxisKernels& y);
};

// In one block and channel. Holds references.
class BlockLight
{
public:
  BlockLight(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
    const FieldBlock& block, Eigen::Index channel, const AskedSteps& asked);

  // What the steps are told, but for other channels and lines.
  ImagePixel pixel(int number) const;
  // The light on the detector.
  double signal(int number) const;
  double signal(int number, ImagePixel& pixel, StepDerivatives& derivatives) const;

private:
  const FieldData& Data;
  const FieldBlock& Block;
  ChannelSteps Steps, Active;
  double Glare;
  FieldDisplacement Where;
  FieldNeighbourhood Near;
  std::array<double, TailPasses> Weights;
  std::vector<double> Surround; // pass after pass, of each pixel
  std::vector<double> Others;   // light from elsewhere, of each pixel

  double near(int number, const ImagePixel& pixel) const;
  const double* others(int number) const;
};

// Appends the light at the places from where it falls on a pixel, too: of the unmoved, unblurred scene.
void addElsewhere(const FieldPair& pair, const float* scene, const FieldFactor& factor,
  const ImagePlace& pixel, std::size_t channel, std::vector<double>& others);

} // namespace msi
