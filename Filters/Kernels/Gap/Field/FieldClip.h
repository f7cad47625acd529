// Saturation: the level at which responses stop to rise.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldModel.h"

namespace msi
{

// The level beyond which the real image stays at one value while the model goes on: that of the least squares of
// real - min(model, level), among quantiles of the model; the neutral level where the image shows none.
double findClipLevel(const FieldData& data, const FieldModel& model, const FieldLoop& loop);

} // namespace msi
