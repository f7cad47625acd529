/**
 * @class   vtkSpectralToColor
 * @brief   XYZ, CIELAB and other numbers, and a view, of spectral reflectance
 *
 * The input is a spectral image (one component per wavelength, wavelengths in the field data
 * "Wavelength") or a sample table with reflectance (R400, .. measured, E400, .. estimated).
 *
 * Input 1, optional: a table of illuminants, "wavelength" and one column each, whose names Illuminant may be. Input 2,
 * optional: a table of an observer, "wavelength", x-bar, y-bar and z-bar, in the place of Observer.
 *
 * An image keeps its arrays and gets "sRGB" (3 x unsigned char, the new active scalars; "Display P3" where Display
 * asks for it) and on request "XYZ" and "Lab" (3 x float), "OutOfGamut" (unsigned char, 1 where the display does not
 * reach the color) and arrays named after their Quantities (2 x float, the components named). A table gets, per
 * quantity Q in R and E that it holds, the columns Q_X Q_Y Q_Z, Q_L Q_a Q_b, Q_red Q_green Q_blue (0..255) and on
 * request Q_out_of_gamut and two per quantity, like Q_x Q_y, Q_C Q_h, Q_whiteness Q_tint.
 *
 * XYZ are scaled to Y = 100 for the perfect reflecting diffuser. A pixel with a NaN is black in the view
 * and NaN in XYZ and Lab; colors outside of the display's are clipped, how many is told in ClippedCount.
 */
#ifndef vtkSpectralToColor_h
#define vtkSpectralToColor_h

#include "MultispectralFiltersColorimetryModule.h"
#include "vtkPassInputTypeAlgorithm.h"

#include <string>

class vtkImageData;
class vtkTable;

namespace msi
{
class ViewingConditions;
}

class MULTISPECTRALFILTERSCOLORIMETRY_EXPORT vtkSpectralToColor : public vtkPassInputTypeAlgorithm
{
public:
  static vtkSpectralToColor* New();
  vtkTypeMacro(vtkSpectralToColor, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Illuminant by name (Kernels/Colorimetry/Illuminant.h) or of the table at input 1; default D65.
   */
  vtkSetStdStringFromCharMacro(Illuminant);
  vtkGetCharFromStdStringMacro(Illuminant);
  ///@}

  ///@{
  /**
   * The illuminant where Illuminant is "other": for who chooses from a list and types what the list has not.
   */
  vtkSetStdStringFromCharMacro(OtherIlluminant);
  vtkGetCharFromStdStringMacro(OtherIlluminant);
  ///@}

  ///@{
  /**
   * Files with curves of your own (vtkCurveReader): illuminants, whose names OtherIlluminant may be; a file with one
   * needs no name, where Illuminant is "other"; and an observer
   * (x-bar, y-bar, z-bar), in the place of Observer. Empty (default): none.
   */
  vtkSetStdStringFromCharMacro(IlluminantFile);
  vtkGetCharFromStdStringMacro(IlluminantFile);
  vtkSetStdStringFromCharMacro(ObserverFile);
  vtkGetCharFromStdStringMacro(ObserverFile);
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

  ///@{
  /**
   * What is computed besides, separated by commas or spaces: xyY, Luv, LCh, whiteness (CIE whiteness and tint, for C,
   * D50 and D65 and the CIE's observers; NaN for what is not white within the limits of CIE 15). Default none.
   */
  vtkSetStdStringFromCharMacro(Quantities);
  vtkGetCharFromStdStringMacro(Quantities);
  void AddQuantity(const char* name);
  void ClearQuantities();
  ///@}

  ///@{
  /**
   * The display that the view is for, "sRGB" (default) or "Display P3", and how its white becomes that of the
   * illuminant, "Bradford" (default) or "CAT16".
   */
  vtkSetStdStringFromCharMacro(Display);
  vtkGetCharFromStdStringMacro(Display);
  vtkSetStdStringFromCharMacro(Adaptation);
  vtkGetCharFromStdStringMacro(Adaptation);
  ///@}

  ///@{
  /**
   * Whether "OutOfGamut" is added; off by default.
   */
  vtkSetMacro(GamutMask, bool);
  vtkGetMacro(GamutMask, bool);
  vtkBooleanMacro(GamutMask, bool);
  ///@}

  /**
   * Pixels or samples of the last execution that did not fit into the display's colors and were clipped.
   */
  vtkGetMacro(ClippedCount, vtkIdType);

protected:
  vtkSpectralToColor();
  ~vtkSpectralToColor() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSpectralToColor(const vtkSpectralToColor&) = delete;
  void operator=(const vtkSpectralToColor&) = delete;

  struct Colorimetry;

  // Both return how many samples were clipped.
  vtkIdType ColorTable(vtkTable* table, const msi::ViewingConditions& conditions, vtkTable* output);
  vtkIdType ColorImage(
    vtkImageData* image, const msi::ViewingConditions& conditions, vtkImageData* output);

  std::string Illuminant = "D65";
  std::string OtherIlluminant;
  std::string IlluminantFile;
  std::string ObserverFile;
  std::string Observer = "CIE 1931 2 degree";
  std::string SpectralArray;
  std::string Quantities;
  std::string Display = "sRGB";
  std::string Adaptation = "Bradford";
  bool GamutMask = false;
  bool ComputeXYZ = false;
  bool ComputeLab = false;
  vtkIdType ClippedCount = 0;
};

#endif
