// The mean of the method "transfer" for images in single precision: fewer points, fewer directions.
#pragma once

#include "Kernels/Estimation/Transfer/TransferEstimator.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// A matrix and the constants its product starts from, as the inner loop reads them: rows in groups of
// four, padded with zeros; of each group first its four constants, then column after column.
struct GroupedMatrix
{
  GroupedMatrix() = default;
  GroupedMatrix(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& constants);

  Eigen::Index rows = 0; // a multiple of four
  Eigen::Index columns = 0;
  std::vector<float> values;
};

// y = start + expansion (components (f; e)), or without the expansion where it has no rows, with
//   f = scale (space(gain v + offset)) - center            the expert's features,
//   e_j = 2^(decay |f|^2 + bias_j + position_j . V' f)     Gaussians of the points that are kept.
// The share of the expert is part of y: of y itself, or of y |y| for the square root.
struct ReducedTransferExpert
{
  TransferSpace space = TransferSpace::Linear;
  std::vector<float> gain;
  std::vector<float> offset;
  std::vector<float> scale;
  std::vector<float> center;
  float decay = 0.0F;
  GroupedMatrix projection; // V': directions x channels
  GroupedMatrix points;     // points x directions
  GroupedMatrix components; // components x (channels + points); bands x as many without expansion
  GroupedMatrix expansion;  // bands x components, or empty
};

struct ReducedTransfer
{
  Eigen::Index channels = 0;
  Eigen::Index bands = 0;
  std::vector<ReducedTransferExpert> experts; // those with a share
  // Rms of the difference from the mean in double, over the bands and over the experts' points, these
  // points 15 % farther from the center, and points halfway between two of them.
  double error = 0.0;
};

// The reduction whose error, as stated above, is about 'tolerance': points are kept by orthogonal least
// squares (Chen, Cowan and Grant, 1991, doi 10.1109/72.80341), directions and components by singular
// values, as few as the tolerance admits.
ReducedTransfer reduceTransfer(const TransferMixture& mixture, double tolerance);

// Mean of blocks of pixels, in float throughout. The same operations in the same order for every pixel
// on every instruction set. A response that is not finite gives NaN in every band of its pixel.
void runReducedTransfer(
  const ReducedTransfer& mixture, const float* response, float* mean, Eigen::Index pixels) noexcept;

} // namespace msi
