/**
 * @class   vtkSpectralToColor
 * @brief   XYZ, CIELAB and an sRGB view of spectral reflectance
 *
 * The input is a spectral image (one component per wavelength, wavelengths in the field data
 * "Wavelength") or a sample table with reflectance (R400, .. measured, E400, .. estimated).
 *
 * An image keeps its arrays and gets "sRGB" (3 x unsigned char, the new active scalars) and on
 * request "XYZ" and "Lab" (3 x float). A table gets, per quantity Q in R and E that it holds, the
 * columns Q_X Q_Y Q_Z, Q_L Q_a Q_b and Q_red Q_green Q_blue (0..255).
 *
 * XYZ are scaled to Y = 100 for the perfect reflecting diffuser. A pixel with a NaN is black in sRGB
 * and NaN in XYZ and Lab; colors outside sRGB are clipped, how many is told in ClippedCount.
 */
#ifndef vtkSpectralToColor_h
#define vtkSpectralToColor_h

#include "MultispectralFiltersColorimetryModule.h"
#include "vtkPassInputTypeAlgorithm.h"

#include <string>

class vtkImageData;
class vtkTable;

class MULTISPECTRALFILTERSCOLORIMETRY_EXPORT vtkSpectralToColor : public vtkPassInputTypeAlgorithm
{
public:
  static vtkSpectralToColor* New();
  vtkTypeMacro(vtkSpectralToColor, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * CIE illuminant by name (A, D50, D65, FL1 .. FL12 or F1 .. F12, LED-B1 .. LED-B5); default D65.
   */
  vtkSetStdStringFromCharMacro(Illuminant);
  vtkGetCharFromStdStringMacro(Illuminant);
  ///@}

  ///@{
  /**
   * "CIE 1931 2 degree" (default) or "CIE 1964 10 degree".
   */
  vtkSetStdStringFromCharMacro(Observer);
  vtkGetCharFromStdStringMacro(Observer);
  ///@}

  ///@{
  /**
   * The point array with the spectra of an image. Empty (default): the active scalars.
   */
  vtkSetStdStringFromCharMacro(SpectralArray);
  vtkGetCharFromStdStringMacro(SpectralArray);
  ///@}

  ///@{
  /**
   * Whether an image also gets "XYZ" and "Lab". Both off by default.
   */
  vtkSetMacro(ComputeXYZ, bool);
  vtkGetMacro(ComputeXYZ, bool);
  vtkBooleanMacro(ComputeXYZ, bool);
  vtkSetMacro(ComputeLab, bool);
  vtkGetMacro(ComputeLab, bool);
  vtkBooleanMacro(ComputeLab, bool);
  ///@}

  /**
   * Pixels or samples of the last execution that did not fit into sRGB and were clipped.
   */
  vtkGetMacro(ClippedCount, vtkIdType);

protected:
  vtkSpectralToColor();
  ~vtkSpectralToColor() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSpectralToColor(const vtkSpectralToColor&) = delete;
  void operator=(const vtkSpectralToColor&) = delete;

  // Both return how many samples were clipped.
  vtkIdType ColorTable(vtkTable* table, vtkTable* output);
  vtkIdType ColorImage(vtkImageData* image, vtkImageData* output);

  std::string Illuminant = "D65";
  std::string Observer = "CIE 1931 2 degree";
  std::string SpectralArray;
  bool ComputeXYZ = false;
  bool ComputeLab = false;
  vtkIdType ClippedCount = 0;
};

#endif
