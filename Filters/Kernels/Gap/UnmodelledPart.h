// What of the rest that the causes leave is regular, and can be added to the corrected simulator: the effect of the trait
// Remainder.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Gap/Samples/GapData.h"

#include <Eigen/Core>

#include <cstdint>
#include <string>
#include <vector>

namespace msi
{

// Ridge regression of each channel's rest on its columns, as an effect within its bounds. products: of each fold one matrix a
// channel, the weighted products of p columns, one for each of the effect's first parameters, and last the rest. The penalty,
// relative to each column's square and common to all, is the one that predicts folds left out best; the effect is neutral where
// none predicts anything.
CameraEffect regularPart(const std::vector<std::vector<Eigen::MatrixXd>>& products,
  const std::vector<std::string>& channels);

// That of a table, fitted to the training samples. predicted: K x S, by the causes.
CameraEffect regularPart(const GapData& data, const Eigen::MatrixXd& predicted,
  const SampleList& training, std::uint64_t seed);

// What the effect makes of a table's responses, K x S.
Eigen::MatrixXd withRegularPart(
  const GapData& data, const CameraEffect& rest, const Eigen::MatrixXd& predicted);

} // namespace msi
