/**
 * @class   vtkSpectralCubeVolume
 * @brief   A spectral image as a volume: x, y, wavelength
 *
 * Input is a spectral image of one slice. Output is an image with the point array of the same name, one component,
 * and one slice a wavelength: z = WavelengthScale x wavelength (nm), or the number of the channel (from 0) where
 * wavelengths are not known. Wavelengths that are not evenly spaced are interpolated linearly to as many that are.
 * A NaN stays in its pixel.
 *
 * Pieces in x, y and wavelength are computed from the pixels that they show.
 */
#ifndef vtkSpectralCubeVolume_h
#define vtkSpectralCubeVolume_h

#include "MultispectralFiltersSamplingModule.h"
#include "vtkImageAlgorithm.h"

#include <string>
#include <vector>

class MULTISPECTRALFILTERSSAMPLING_EXPORT vtkSpectralCubeVolume : public vtkImageAlgorithm
{
public:
  static vtkSpectralCubeVolume* New();
  vtkTypeMacro(vtkSpectralCubeVolume, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The point array with the spectra. Empty (default): the active scalars.
   */
  vtkSetStdStringFromCharMacro(SpectralArray);
  vtkGetCharFromStdStringMacro(SpectralArray);
  ///@}

  ///@{
  /**
   * Length of a nanometre along z, in the image's units (of a channel, where wavelengths are not known). Positive,
   * default 1.
   */
  vtkSetClampMacro(WavelengthScale, double, 1e-6, 1e6);
  vtkGetMacro(WavelengthScale, double);
  ///@}

protected:
  vtkSpectralCubeVolume() = default;
  ~vtkSpectralCubeVolume() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSpectralCubeVolume(const vtkSpectralCubeVolume&) = delete;
  void operator=(const vtkSpectralCubeVolume&) = delete;

  std::string SpectralArray;
  double WavelengthScale = 1.0;
  std::vector<double> Slices; // nm, or numbers of channels
};

#endif
