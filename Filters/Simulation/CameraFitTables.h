// A camera model fit as vtkTables.
#ifndef CameraFitTables_h
#define CameraFitTables_h

#include "Kernels/Camera/CameraModelFit.h"

class vtkTable;

namespace msi
{

// wavelength | one standard error a channel | resolution | `low C400`, `high C400`, ..: the responsivity within 95 %
// (not below 0); field data Dark: standard errors. Without draws wavelength and resolution alone.
void writeUncertainty(const CameraModelFit& fit, vtkTable* table);

// One row: samples, channels, held_out_rms, residual_rms, locality, smoothness, freedom, determined, directions,
// condition, complete, status.
void writeSummary(const CameraModelFit& fit, vtkTable* table);

// One row a channel: channel, centroid (nm), dark, dark_error (where the fit has it), rms.
void writeChannels(const CameraModelFit& fit, vtkTable* table);

} // namespace msi

#endif
