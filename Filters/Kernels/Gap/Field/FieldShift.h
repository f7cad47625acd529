// Displacements of whole pixels.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"

#include <Eigen/Core>

namespace msi
{

// The displacement (right, down; K x 2) of each channel of the real image, up to ten pixels, by the largest correlation of
// blocks whose means are taken off; zero where it is less than a pixel, so a start for a fit by gradients.
Eigen::MatrixXd wholePixelShifts(const FieldData& data, const FieldLoop& loop);

} // namespace msi
