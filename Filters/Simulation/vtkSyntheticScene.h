/**
 * @class   vtkSyntheticScene
 * @brief   A chart or a book of dyed fabric as a reflectance image of any size
 *
 * Output 0: an image with the point arrays "Reflectance" (one component a wavelength, relative to a perfect white) and
 * "Label" (0 between the patches, 1, 2, ... well inside them). Output 1: the patches as a sample table: `sample`,
 * `medium`, `label`, `x`, `y` (center, pixels) and `R400`, .., the mean reflectance of the patch. Only the pixels asked
 * for are computed, and a pixel's bytes depend on nothing but its place (Kernels/Scenes/SyntheticScene.h).
 */
#ifndef vtkSyntheticScene_h
#define vtkSyntheticScene_h

#include "MultispectralFiltersSimulationModule.h"
#include "vtkImageAlgorithm.h"

class MULTISPECTRALFILTERSSIMULATION_EXPORT vtkSyntheticScene : public vtkImageAlgorithm
{
public:
  static vtkSyntheticScene* New();
  vtkTypeMacro(vtkSyntheticScene, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum Subjects
  {
    CHART_24 = 0,
    CHART_140 = 1,
    FABRIC = 2
  };

  ///@{
  /**
   * What the image shows. Default CHART_24.
   */
  vtkSetClampMacro(Subject, int, CHART_24, FABRIC);
  vtkGetMacro(Subject, int);
  ///@}

  ///@{
  /**
   * Columns and rows in pixels. Default 768, 512.
   */
  vtkSetVector2Macro(Size, int);
  vtkGetVector2Macro(Size, int);
  ///@}

  ///@{
  /**
   * Shortest and longest wavelength and the step between, nm. Default 400, 700, 10.
   */
  vtkSetVector3Macro(Wavelengths, double);
  vtkGetVector3Macro(Wavelengths, double);
  ///@}

  ///@{
  /**
   * Another seed, other dyes and another texture. Default 1.
   */
  vtkSetMacro(Seed, int);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Scatter and relief of the surface: 1 as usual, 0 none. 0 to 3, default 1.
   */
  vtkSetMacro(Texture, double);
  vtkGetMacro(Texture, double);
  ///@}

  ///@{
  /**
   * Fabric: probability that light from a yarn strikes a yarn again. 0 to 0.5, default 0.16.
   */
  vtkSetMacro(Interreflection, double);
  vtkGetMacro(Interreflection, double);
  ///@}

  ///@{
  /**
   * Fabric: mean width of a yarn in pixels. 2 to 64, default 4.4.
   */
  vtkSetMacro(YarnWidth, double);
  vtkGetMacro(YarnWidth, double);
  ///@}

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
  vtkSyntheticScene();
  ~vtkSyntheticScene() override = default;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSyntheticScene(const vtkSyntheticScene&) = delete;
  void operator=(const vtkSyntheticScene&) = delete;

  int Subject = CHART_24;
  int Size[2] = { 768, 512 };
  double Wavelengths[3] = { 400.0, 700.0, 10.0 };
  int Seed = 1;
  double Texture = 1.0;
  double Interreflection = 0.16;
  double YarnWidth = 4.4;

  bool Preview = true;
};

#endif
