// What of the rest that the causes leave is regular, and can be added to the corrected simulator: the effect of the trait
// Remainder.
#pragma once

#include "Kernels/Camera/CameraEffect.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

// Ridge regression of each channel's rest on its columns. products: of each fold one matrix a channel, the weighted products of
// p columns and last the rest. K x p; the penalty, relative to each column's square and common to all, is the one that
// predicts folds left out best; 0 where none predicts anything.
Eigen::MatrixXd regularPart(const std::vector<std::vector<Eigen::MatrixXd>>& products);

// These coefficients of its first parameters as an effect, within their bounds.
CameraEffect unmodelledPart(
  const Eigen::MatrixXd& coefficients, const std::vector<std::string>& channels);

} // namespace msi
