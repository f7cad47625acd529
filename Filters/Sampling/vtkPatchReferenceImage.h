/**
 * @class   vtkPatchReferenceImage
 * @brief   The image that a perfect estimate of a chart would give: measured spectra painted by label
 *
 * Input 0 is a label image, input 1 a sample table with the column "label" and measured reflectance
 * (R400, ..). The output has the array "Reflectance" (float) with a patch's measured spectrum in each of
 * its pixels, and NaN where no row of the table names the label: outside patches, and in patches that
 * were left out of the table, for example because they took part in the calibration.
 */
#ifndef vtkPatchReferenceImage_h
#define vtkPatchReferenceImage_h

#include "MultispectralFiltersSamplingModule.h"
#include "vtkImageAlgorithm.h"

class MULTISPECTRALFILTERSSAMPLING_EXPORT vtkPatchReferenceImage : public vtkImageAlgorithm
{
public:
  static vtkPatchReferenceImage* New();
  vtkTypeMacro(vtkPatchReferenceImage, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Add the point array "sRGB" (3 bytes a pixel), the colors that a view shows at first: sRGB under D65 where the
   * bands reach over the visible spectrum. Default on.
   */
  vtkSetMacro(Preview, bool);
  vtkGetMacro(Preview, bool);
  vtkBooleanMacro(Preview, bool);
  ///@}

protected:
  vtkPatchReferenceImage();
  ~vtkPatchReferenceImage() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPatchReferenceImage(const vtkPatchReferenceImage&) = delete;
  void operator=(const vtkPatchReferenceImage&) = delete;

  bool Preview = true;
};

#endif
