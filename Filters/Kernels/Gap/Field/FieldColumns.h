// What each parameter would change in a block of pixels, at a given model.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldModel.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// The columns of the linear model of a block's residual, one channel.
namespace FieldColumn
{
enum Index : int
{
  Gain, // u
  One,
  GradientRight, // x u
  GradientDown,  // y u
  GradientBend,  // n^2 u, n the place along the gradient; 0 without gradient
  RadiusSquared, // rho^2 u, rho from the center of vignetting
  RadiusFourth,
  RadiusSixth,
  CenterX,
  CenterY,
  Square,   // u^2
  Exponent, // u ln u
  Clip,     // u above the level of clipping
  ClipLevel,
  Before,       // the channel before
  FromPrevious, // the same less this channel, where there is one
  FromNext,
  Mean,  // of the scene, what glare adds
  Right, // derivative by displacement
  Down,
  Magnification,
  Rotation,
  BlurVariance, // derivative by the blur's variance
  Tail,         // the surround minus u, TailPasses columns
  RowSine = Tail + TailPasses,
  RowCosine,
  ColumnSine,
  ColumnCosine,
  RowGain, // the profile of lines times u
  RowOffset,
  ColumnGain,
  ColumnOffset,
  Diagonal, // x y u, (x^2 - y^2) u: only to see where a gap lies
  Saddle,
  Lights // from elsewhere in the image, one column each of imageLights(); the last is real - predicted
};

// The number of the residual, and how many there are before it.
inline int residual()
{
  return Lights + static_cast<int>(imageLights().size());
}
inline int count()
{
  return residual() + 1;
}
}

// The weights of the tail's passes for a radius (ScatterTail), and their derivative by the radius.
Eigen::ArrayXd tailWeights(double radius);
Eigen::ArrayXd tailSlope(double radius);

// Memory of a thread.
struct FieldScratch
{
  Eigen::MatrixXd columns; // usable pixels x FieldColumn::count()
  Eigen::ArrayXd level;    // predicted, of each
  std::vector<int> pixel;  // number in the block, of each
  // Of every pixel of the block: the signal behind stray light, and that of the channel before and of the next.
  std::vector<double> signal, before, next;
  const FieldBlock* lastBlock = nullptr;
  Eigen::Index lastChannel = -1;
};

// Fills `scratch` for the usable pixels of a block in one channel.
// Exact in the model but for one thing: the surround of the tail is that of the unmoved, unblurred image, and the
// factors of gradient and vignetting come after the neighbourhood.
void fieldColumns(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, Eigen::Index channel, FieldScratch& scratch);

} // namespace msi
