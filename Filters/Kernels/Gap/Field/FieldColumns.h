// What each parameter would change in a block of pixels, at a given model.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldModel.h"

#include <Eigen/Core>

#include <functional>
#include <vector>

namespace msi
{

// The columns of the linear model of a block's residual, one channel: derivatives of the prediction, as the steps give them
// (PlacedStep::column), and last the residual.
struct FieldColumns
{
  std::vector<unsigned> axes;          // ImageAxis, of each but the residual
  std::vector<const PlacedStep*> step; // of each but the residual
  int gain = 0, offset = 0;    // by a gain, relative to it: the response itself; by an offset
  int blur = 0;                // by a variance of blur
  int residual = 0, count = 0; // real - predicted, the last one; with it

  std::vector<int> of(unsigned axis) const;
};
const FieldColumns& fieldColumns();

// What one parameter changes in the columns of a channel, which are those at `model`, where the model is `about`.
Eigen::VectorXd columnsChanged(
  ImageParameter parameter, const FieldModel& model, const FieldModel& about, Eigen::Index channel);

// Those of the usable pixels of a block in one channel.
struct ChannelColumns
{
  std::vector<Eigen::Index> there; // which columns; the others are 0
  Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor> columns; // pixels x those
  Eigen::ArrayXd level;   // predicted, of each
  std::vector<int> pixel; // number in the block, of each
  // What white noise of variance 1 in the simulated image adds to the products of all columns with this one, in the mean over pixels.
  // Only within the call of forColumns().
  std::function<Eigen::VectorXd(Eigen::Index column)> ofNoise;

  auto residual() const { return columns.col(columns.cols() - 1); }
};

// Calls act(channel, columns) for each channel of a block in turn; act may change the columns. There are those of steps that change
// something or are asked for.
// Exact in the model but for one thing: the surround of the tail is that of the unmoved, unblurred image, and the
// factors over the field come after the neighbourhood.
void forColumns(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, const AskedSteps& asked,
  const std::function<void(Eigen::Index, ChannelColumns&)>& act);

// Usable pixels of a block in one channel: number in the block, prediction, its derivative by a relative gain, real - predicted.
struct FieldResidual
{
  std::vector<int> pixel;
  Eigen::ArrayXd level, gain, residual;
};

// Block after block, of each its channels; blocks of the test part have no pixels, unless they are asked for.
std::vector<FieldResidual> fieldResiduals(
  const FieldData& data, const FieldModel& model, bool testToo = false);

} // namespace msi
