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

// The simulated image in 64 x 64 cells: what each adds to the mean of the scene and the place of its light, cells x K.
// A smooth factor of the field may be taken at that place.
struct SceneCells
{
  SceneCells() = default;
  explicit SceneCells(const FieldPair& pair);
  // The mean over the scene of the simulated signal behind gradient and vignetting, K.
  Eigen::ArrayXd mean(const FieldModel& model) const;

private:
  Eigen::ArrayXXd Part, X, Y;
};

} // namespace msi
