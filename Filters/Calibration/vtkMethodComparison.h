/**
 * @class   vtkMethodComparison
 * @brief   How well each estimation method does on a target medium, on samples held out
 *
 * Input 0 is the calibration table (a chart), input 1 the table of the target medium, both with measured
 * reflectance and responses. Inputs 2 and 3, optional: tables of illuminants and of an observer, as CIEDE2000 Evaluator
 * takes them. For every number of tuning samples, and for each of Draws random choices of
 * that many samples of the target, every method is fitted and judged on the target samples left over.
 *
 * Output 0, results: method, channels, tuning, metric, illuminant, mean, median, p95, max; each figure is
 * the mean over draws of that statistic over the held-out samples. Metrics: rms (reflectance factor), dE00 (or
 * the color difference asked for) per illuminant, and coverage90 and coverage95 of methods that know their uncertainty (the share of held-out values
 * within 1.645 and 1.96 standard deviations; in mean).
 * Output 1, draws: the same per draw. Output 2, spectra: wavelength, measured and one column per method,
 * for a typical held-out sample (median rms of the first method) of draw 1; with "transfer -2s" and
 * "transfer +2s". Output 3, curves: one row per number of tuning samples, those of CurveSamples too, increasing: "tuning", the mean rms of
 * each method, its 95 % interval in "METHOD low" and "METHOD high", "own-medium": the rms of a calibration on the target's own samples, and "draws".
 * Output 4, samples: one row per sample of the target, for the first number of tuning samples: "sample", "held out" (in how many draws), and
 * the mean error of each method and metric, "METHOD METRIC ILLUMINANT". Output 5, pairs: each method against each other: method, against, tuning,
 * metric, illuminant, ratio of the mean errors with low and high (95 %), wins (share of the errors where the first is smaller), better (the
 * better method, empty where the interval holds 1). Intervals are about other draws and other samples of the medium
 * (Kernels/Estimation/CrossedErrors.h).
 *
 * A method that cannot be fitted to the samples of some draw is left out at that number of tuning samples, with a
 * warning that gives the reason; where no method is left the reason is the error.
 *
 * Draws run in threads and are spread over ranks; the numbers do not depend on how many there are.
 */
#ifndef vtkMethodComparison_h
#define vtkMethodComparison_h

#include "MultispectralFiltersCalibrationModule.h"
#include "vtkTableAlgorithm.h"

#include <string>

class MULTISPECTRALFILTERSCALIBRATION_EXPORT vtkMethodComparison : public vtkTableAlgorithm
{
public:
  static vtkMethodComparison* New();
  vtkTypeMacro(vtkMethodComparison, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Methods by name, separated by commas or spaces; the names are those of the registry
   * (Kernels/Estimation/EstimationMethod.h), and "all" stands for every one. Default "direct, pinv,
   * pooled, r-model, banded, transfer".
   */
  vtkSetStdStringFromCharMacro(Methods);
  vtkGetCharFromStdStringMacro(Methods);
  void AddMethod(const char* name);
  void ClearMethods();
  ///@}

  ///@{
  /**
   * Numbers of tuning samples, separated by commas or spaces. Default "16".
   */
  vtkSetStdStringFromCharMacro(TuningSamples);
  vtkGetCharFromStdStringMacro(TuningSamples);
  ///@}

  ///@{
  /**
   * Further numbers of tuning samples, for the output curves alone; with at most CurveDraws draws. Default "".
   */
  vtkSetStdStringFromCharMacro(CurveSamples);
  vtkGetCharFromStdStringMacro(CurveSamples);
  vtkSetClampMacro(CurveDraws, int, 1, 100000);
  vtkGetMacro(CurveDraws, int);
  ///@}

  ///@{
  /**
   * Random choices of tuning samples. Range 1 .. 100000, default 10.
   */
  vtkSetClampMacro(Draws, int, 1, 100000);
  vtkGetMacro(Draws, int);
  ///@}

  ///@{
  /**
   * Seed of the choices; the same seed gives the same choices on every machine. Default 1.
   */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * The color difference: ciede2000 (default), cie94, cie94-textiles, cmc, din99, cie76 or hyab, with other factors like
   * "cmc(1:1)"; the measured color is the standard.
   */
  vtkSetStdStringFromCharMacro(Difference);
  vtkGetCharFromStdStringMacro(Difference);
  ///@}

  ///@{
  /**
   * Illuminants of the color difference by name or of the table at input 2, separated by commas or spaces; default
   * "D65, F2".
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

protected:
  vtkMethodComparison();
  ~vtkMethodComparison() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkMethodComparison(const vtkMethodComparison&) = delete;
  void operator=(const vtkMethodComparison&) = delete;

  std::string Methods = "direct, pinv, pooled, r-model, banded, transfer";
  std::string TuningSamples = "16";
  std::string CurveSamples;
  int CurveDraws = 10;
  int Draws = 10;
  int Seed = 1;
  std::string Difference = "ciede2000";
  std::string Illuminants = "D65, F2";
  std::string OtherIlluminants;
  std::string IlluminantFile;
  std::string ObserverFile;
  std::string Observer = "CIE 1931 2 degree";
};

#endif
