// The effects that were found, as the effect library writes them.
#pragma once

#include "Kernels/Gap/Field/FieldFit.h"
#include "Kernels/Gap/GapReport.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

// error: standard errors of the choice's terms, from `next` on (FieldFitter::standardErrors), which moves on.
// periodError: of the period of stripes.
std::vector<GapParameter> fieldParameters(const FieldChoice& choice, const FieldModel& model,
  double periodError, const std::vector<std::string>& channels, const Eigen::VectorXd& error,
  Eigen::Index& next);

// The set as a list for CameraSimulator and ImageSimulator.
std::vector<CameraEffect> fieldCorrection(
  const FieldSet& set, const FieldModel& model, const std::vector<std::string>& channels);

} // namespace msi
