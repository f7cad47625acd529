// The simulated image as a whole: its gaps, its mean.
#pragma once

#include "Kernels/Gap/Field/FieldModel.h"
#include "Kernels/Gap/Field/FieldPair.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// A pixel of the simulated image has no value.
bool hasGaps(const FieldPair& pair);

// The simulated image without gaps: gaps take the values at both sides in their row. Empty where there
// are none.
std::vector<float> filledScene(const FieldPair& pair);

// Means over the scene of the simulated u times 1, x, y, rho^2, x rho^2, y rho^2; K x 6.
Eigen::MatrixXd sceneMoments(const FieldPair& pair);

// The mean over the scene of the simulated signal behind gradient and vignetting, K.
Eigen::ArrayXd sceneMean(const FieldPair& pair, const FieldModel& model);

} // namespace msi
