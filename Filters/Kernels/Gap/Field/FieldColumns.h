// What each parameter would change in a block of pixels, at a given model.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldModel.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// The columns of the linear model of a block's residual, one channel: derivatives of the prediction.
namespace FieldColumn
{
// By a parameter; by Gain relative to it. Those of TailFraction and TailRadius are empty: their derivatives are sums of the
// tail's passes.
constexpr int of(ImageParameter parameter) noexcept
{
  return static_cast<int>(parameter);
}
// By the weight of one of TailPasses passes, counted from 0: the surround minus u.
inline int pass(int number)
{
  return number > 0 ? of(surroundWeight(number - 1)) : static_cast<int>(fieldParameterCount());
}
// x y u and (x^2 - y^2) u: only to see where a gap lies.
inline int diagonal()
{
  return pass(0) + 1;
}
inline int saddle()
{
  return pass(0) + 2;
}
// real - predicted, the last one; how many stand before it, and how many there are.
inline int residual()
{
  return pass(0) + 3;
}
inline int count()
{
  return residual() + 1;
}
}

// The weights of the tail's passes for a radius (ScatterTail), and their derivative by the radius.
Eigen::ArrayXd tailWeights(double radius);
Eigen::ArrayXd tailSlope(double radius);
// Those of a model: the signal becomes signal + sum of weight (surround - signal).
Eigen::ArrayXd tailWeights(const FieldModel& model, Eigen::Index channel);

// Where a fit starts from what the normal equations do not have yet, and what they are taken to be there.
struct FieldShape
{
  double radius = 0.0;  // of the tail; 0: the model's
  double centerX = 0.0; // of vignetting
  double centerY = 0.0;
  // Direction of the gradient, of length 1; 0: the model's.
  double gradientRight = 0.0;
  double gradientDown = 0.0;
};

constexpr bool hasDirection(const FieldShape& shape) noexcept
{
  return shape.gradientRight != 0.0 || shape.gradientDown != 0.0;
}

// What one parameter changes in the columns of a channel, which are those at `model`.
Eigen::VectorXd columnsChanged(
  ImageParameter parameter, const FieldModel& model, Eigen::Index channel, const FieldShape& shape);

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
