// Ridge regressions of a gap, fitted to some of the data and tried on the others: how much of it each axis predicts, and what of a rest
// is regular.
#pragma once

#include "Kernels/Camera/CameraEffect.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

// Of K channels, products of P + 1 columns, the last of which is the gap.
using ChannelNormals = std::vector<Eigen::MatrixXd>;

struct AxisSplit
{
  ChannelNormals training, test;
};

// Numbers of columns of the normal matrices: with one coefficient for all channels, or one for each.
struct AxisBasis
{
  std::string axis;
  std::vector<int> common, own;
  // Those of cells (media, places, times): a gap that is the same in all of them is not the axis's where channel and level alone
  // predict nearly all that the axes predict.
  std::vector<int> cells = {};
  // Where the axis does more than its columns reach: the splits once it has done so. Sets with the axis start from there.
  std::vector<AxisSplit> behind = {};
};

struct PredictedEnergies
{
  double before = 0.0;      // of the test data
  double all = 0.0;         // predicted by all axes together
  std::vector<double> axis; // of each, Shapley values; a common gain is the level's
  // Coefficients of the columns by which all axes together predict: of each split those of each channel, P.
  std::vector<std::vector<Eigen::VectorXd>> coefficients;
};

// Ridge regressions on all subsets of the axes, on each split's training data, tried on its test data.
//   axes: the first is the channel, with `gain` among its own columns, the second the level.
// Source: Shapley values as in ReportParts.h.
PredictedEnergies predictedEnergies(
  std::vector<AxisBasis> axes, std::vector<AxisSplit> splits, int gain);

// The effect of the trait Remainder, which can be added to the corrected simulator, with these coefficients of its first parameters, within
// their bounds; K x p.
CameraEffect remainderEffect(
  const Eigen::MatrixXd& coefficients, const std::vector<std::string>& channels);

// That effect by ridge regression of each channel's rest on its columns. products, of each fold: weighted, of p columns, one for each of
// the effect's first parameters, and last the rest. The penalty, relative to each column's square and common to all, is the one that
// predicts folds left out best; the effect is neutral where none predicts anything.
CameraEffect regularPart(
  const std::vector<ChannelNormals>& products, const std::vector<std::string>& channels);

} // namespace msi
