#include "Kernels/Camera/CameraResampling.h"

#include "Kernels/Spectra/Interpolation.h"

namespace msi
{

CameraModel resampled(const CameraModel& camera, const WavelengthGrid& wavelengths)
{
  if (wavelengths == camera.wavelengths())
  {
    return camera;
  }
  return { wavelengths, camera.responsivity() * resamplingMatrix(wavelengths, camera.wavelengths()),
    camera.dark(), camera.channels() };
}

} // namespace msi
