// The regular part of what the causes leave of a table's gap.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Gap/Samples/GapData.h"

#include <Eigen/Core>

#include <cstdint>

namespace msi
{

// Fitted to the training samples. predicted: K x S, by the causes.
CameraEffect restOf(const GapData& data, const Eigen::MatrixXd& predicted,
  const SampleList& training, std::uint64_t seed);

// What the effect makes of these responses, K x S.
Eigen::MatrixXd withRest(
  const GapData& data, const CameraEffect& rest, const Eigen::MatrixXd& predicted);

} // namespace msi
