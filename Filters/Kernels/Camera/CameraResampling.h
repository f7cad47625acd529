// The same camera for spectra on another wavelength grid.
#pragma once

#include "Kernels/Camera/CameraModel.h"

namespace msi
{

// The camera M T with T = resamplingMatrix(wavelengths, camera's grid): it answers to a spectrum on `wavelengths` as
// the given camera answers to that spectrum interpolated to its own grid. The response to white is kept.
// Errors: as resamplingMatrix.
CameraModel resampled(const CameraModel& camera, const WavelengthGrid& wavelengths);

} // namespace msi
