/**
 * @class   vtkFlatFieldCorrection
 * @brief   From raw counts to responses relative to white: (raw - dark) / (white - dark)
 *
 * Input 0 is the raw image, input 1 (optional) an image of a white reference under the same light and
 * exposure, input 2 (optional) an image taken with the lens covered. All have the same size and
 * channels. The output array "Responses" is 1 where the raw image equals the white one, times
 * WhiteReflectance. Pixels whose white is not above the dark become NaN; how many is told in DeadCount.
 */
#ifndef vtkFlatFieldCorrection_h
#define vtkFlatFieldCorrection_h

#include "MultispectralFiltersSamplingModule.h"
#include "vtkImageAlgorithm.h"

class MULTISPECTRALFILTERSSAMPLING_EXPORT vtkFlatFieldCorrection : public vtkImageAlgorithm
{
public:
  static vtkFlatFieldCorrection* New();
  vtkTypeMacro(vtkFlatFieldCorrection, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Reflectance factor of the white reference. Range (0, 2], default 1.
   */
  vtkSetClampMacro(WhiteReflectance, double, 1e-3, 2.0);
  vtkGetMacro(WhiteReflectance, double);
  ///@}

  ///@{
  /**
   * Level of the white where no white image is connected. Positive, default 1.
   */
  vtkSetMacro(WhiteLevel, double);
  vtkGetMacro(WhiteLevel, double);
  ///@}

  /**
   * Values of the last execution whose white was not above the dark.
   */
  vtkGetMacro(DeadCount, vtkIdType);

protected:
  vtkFlatFieldCorrection();
  ~vtkFlatFieldCorrection() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkFlatFieldCorrection(const vtkFlatFieldCorrection&) = delete;
  void operator=(const vtkFlatFieldCorrection&) = delete;

  double WhiteReflectance = 1.0;
  double WhiteLevel = 1.0;
  vtkIdType DeadCount = 0;
};

#endif
