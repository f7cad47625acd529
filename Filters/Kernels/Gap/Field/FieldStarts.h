// What the images show before a fit: where displacements and clipping start.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"

#include <Eigen/Core>

namespace msi
{

// Where each channel of the real image lies: right, down (pixels), magnification, rotation (degrees); K x 4.
struct FieldStart
{
  Eigen::MatrixXd shift;      // displacements alone, the rest zero
  Eigen::MatrixXd similarity; // all of them
};

// The largest correlation of blocks whose means are taken off, with displacements of up to ten whole pixels in every
// block. Zero where it is no better than no displacement, so a start for a fit by gradients.
FieldStart registrationStart(const FieldData& data, const FieldLoop& loop);

// Weight and level of the effect that limits the response.
const std::vector<ImageTerm>& clippingTerms();

// The level beyond which the real image stays at one value while the model goes on: that of the least squares of
// real - min(model, level), among quantiles of the model; the neutral level where the image shows none. The residuals are those
// of a model that does not clip.
double findClipLevel(const std::vector<FieldResidual>& residuals);

} // namespace msi
