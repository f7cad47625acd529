/**
 * @class   vtkCIEDE2000Evaluator
 * @brief   Where an estimated reflectance is wrong: spectral rms and CIEDE2000
 *
 * Input 0 is the estimate: a spectral image, or a sample table with E400, E410, .. . Input 1 is the
 * reference: a spectral image of the same extent and bands (NaN where nothing is known), or a table
 * with R400, R410, .. and as many rows; it may be left out where the first table has the measured
 * reflectance (R400, ..) too. Input 2, optional: a table of illuminants, "wavelength" and one column each, whose
 * names Illuminants may hold. Input 3, optional: a table of an observer, "wavelength", x-bar, y-bar and z-bar, in the
 * place of Observer. Input 4, optional: a reflectance transform or transfer model; input 0 then holds camera responses
 * (an image, or C400, ..), whose reflectance is estimated on the way and not kept. Input 5, optional: a metamerism
 * transform that comes before it.
 *
 * Output 0 is input 0 with the arrays or columns "rms" (sqrt of the mean squared difference over
 * bands, in reflectance factor) and "dE00 D65", "dE00 F2", .. (one per illuminant), or the others that Metrics asks
 * for. Output 1 is the summary table: metric, illuminant, mean, median, p95, max, count, left_out (not finite).
 *
 * Where ranks hold pieces of the image, the summary covers the whole, with the same bytes for any
 * number of ranks.
 */
#ifndef vtkCIEDE2000Evaluator_h
#define vtkCIEDE2000Evaluator_h

#include "MultispectralFiltersColorimetryModule.h"
#include "vtkPassInputTypeAlgorithm.h"

#include <string>

class vtkMultiProcessController;

class MULTISPECTRALFILTERSCOLORIMETRY_EXPORT vtkCIEDE2000Evaluator
  : public vtkPassInputTypeAlgorithm
{
public:
  static vtkCIEDE2000Evaluator* New();
  vtkTypeMacro(vtkCIEDE2000Evaluator, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What is computed beside rms, separated by commas or spaces; default "ciede2000". Color differences under each
   * illuminant, the reference being the standard: ciede2000, cie94, cie94-textiles, cmc (2 : 1), din99, cie76, hyab, with
   * other factors like "cmc(1:1)" and "cie94(2:1:1)". Measures between spectra: mae, gfc, sam. And metamerism, the
   * special metamerism index from the first illuminant to each other one. The columns are "dE94 D65", "gfc",
   * "metamerism A".
   */
  vtkSetStdStringFromCharMacro(Metrics);
  vtkGetCharFromStdStringMacro(Metrics);
  void AddMetric(const char* name);
  void ClearMetrics();
  ///@}

  ///@{
  /**
   * Illuminants by name (Kernels/Colorimetry/Illuminant.h) or of the table at input 2, separated by commas or spaces;
   * default "D65, F2".
   */
  vtkSetStdStringFromCharMacro(Illuminants);
  vtkGetCharFromStdStringMacro(Illuminants);
  void AddIlluminant(const char* name);
  void ClearIlluminants();
  ///@}

  ///@{
  /**
   * More of them, for who ticks those of a list; default none.
   */
  vtkSetStdStringFromCharMacro(OtherIlluminants);
  vtkGetCharFromStdStringMacro(OtherIlluminants);
  ///@}

  ///@{
  /**
   * Files with curves of your own (vtkCurveReader): illuminants, which are added to Illuminants; and an observer
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
   * The point arrays with the spectra of the two images. Empty (default): the active scalars.
   */
  vtkSetStdStringFromCharMacro(EstimateArray);
  vtkGetCharFromStdStringMacro(EstimateArray);
  vtkSetStdStringFromCharMacro(ReferenceArray);
  vtkGetCharFromStdStringMacro(ReferenceArray);
  ///@}

  ///@{
  /**
   * Whether "rms" is computed; default on. Without it, and with color differences alone, responses become colors by one
   * matrix where the transform is affine: two to three times as fast.
   */
  vtkSetMacro(SpectralRms, bool);
  vtkGetMacro(SpectralRms, bool);
  vtkBooleanMacro(SpectralRms, bool);
  ///@}

  ///@{
  /**
   * Parametric factors of ciede2000 where Metrics gives none; each positive, default 1. Textile work often sets KL to 2.
   */
  vtkSetMacro(KL, double);
  vtkGetMacro(KL, double);
  vtkSetMacro(KC, double);
  vtkGetMacro(KC, double);
  vtkSetMacro(KH, double);
  vtkGetMacro(KH, double);
  ///@}

protected:
  vtkCIEDE2000Evaluator();
  ~vtkCIEDE2000Evaluator() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestDataObject(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkCIEDE2000Evaluator(const vtkCIEDE2000Evaluator&) = delete;
  void operator=(const vtkCIEDE2000Evaluator&) = delete;

  std::string Metrics = "ciede2000";
  std::string Illuminants = "D65, F2";
  std::string OtherIlluminants;
  std::string IlluminantFile;
  std::string ObserverFile;
  std::string Observer = "CIE 1931 2 degree";
  std::string EstimateArray;
  std::string ReferenceArray;
  bool SpectralRms = true;
  double KL = 1.0;
  double KC = 1.0;
  double KH = 1.0;
};

#endif
