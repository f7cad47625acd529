/**
 * @class   vtkSimToRealGap
 * @brief   Where a simulated and a real camera disagree, because of which effects, and how far that would shrink
 *
 * Input 0 is the simulated camera: a table with wavelength (nm) and one column per channel (responsivity), field data
 * Dark (response) and Noise (read, shot; where known). Input 1 is the samples table: reflectance (R400, ..) and, where
 * known, sample, medium, scene, x, y, order. Input 2 is the responses table of the real camera: sample and one column
 * per channel (C1, ..), one row a reading; without it the responses stand in the samples table.
 *
 * Outputs: 0 summary, 1 where, 2 causes, 3 candidates, 4 heat map (channel x sample group), 5 trend over the capture
 * order, 6 samples (the gap of each), 7 corrected camera (the input camera with the effects in its field data), 8
 * notes: what the data cannot decide, and why. All figures of the gap are held out, in response relative to white.
 * The summary's field data Report is the text of report.json.
 *
 * Folds run in threads; the result does not depend on how many there are.
 */
#ifndef vtkSimToRealGap_h
#define vtkSimToRealGap_h

#include "MultispectralFiltersDiagnosisModule.h"
#include "vtkTableAlgorithm.h"

#include <string>
#include <vector>

class MULTISPECTRALFILTERSDIAGNOSIS_EXPORT vtkSimToRealGap : public vtkTableAlgorithm
{
public:
  static vtkSimToRealGap* New();
  vtkTypeMacro(vtkSimToRealGap, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OutputPort
  {
    SUMMARY = 0,
    WHERE = 1,
    CAUSES = 2,
    CANDIDATES = 3,
    HEAT_MAP = 4,
    TREND = 5,
    SAMPLES = 6,
    CORRECTED_CAMERA = 7,
    NOTES = 8,
    NUMBER_OF_OUTPUTS = 9
  };

  ///@{
  /**
   * Effects that may not be blamed, by name. Default none.
   */
  void AddWithout(const char* effect);
  void ClearWithout();
  ///@}

  ///@{
  /**
   * Largest number of causes. Range 1 .. 8, default 5.
   */
  vtkSetClampMacro(MaximumCauses, int, 1, 8);
  vtkGetMacro(MaximumCauses, int);
  ///@}

  ///@{
  /**
   * Largest number of samples that are used; of more, as many are chosen, spread evenly over media, scenes and levels,
   * and a note says so. 0: all. Default 2000.
   */
  vtkSetClampMacro(MaximumSamples, int, 0, VTK_INT_MAX);
  vtkGetMacro(MaximumSamples, int);
  ///@}

  ///@{
  /**
   * Folds of the samples; each takes no part once in choosing and fitting the effects. Range 2 .. 20, default 5.
   */
  vtkSetClampMacro(Folds, int, 2, 20);
  vtkGetMacro(Folds, int);
  ///@}

  ///@{
  /**
   * Whether to add the effect unmodelled_response, which models what no cause explains, to the corrected simulator. Default off.
   */
  vtkSetMacro(AddRest, bool);
  vtkGetMacro(AddRest, bool);
  vtkBooleanMacro(AddRest, bool);
  ///@}

  ///@{
  /**
   * Seed of folds and resampling; the same seed gives the same result on every machine. Default 1.
   */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Standard deviation of the measured reflectance, reflectance factor. Below 0 (default -1): what the capture itself
   * shows, up to 0.003.
   */
  vtkSetMacro(ReflectanceNoise, double);
  vtkGetMacro(ReflectanceNoise, double);
  ///@}

protected:
  vtkSimToRealGap();
  ~vtkSimToRealGap() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSimToRealGap(const vtkSimToRealGap&) = delete;
  void operator=(const vtkSimToRealGap&) = delete;

  std::vector<std::string> Without;
  int MaximumCauses = 5;
  int MaximumSamples = 2000;
  int Folds = 5;
  int Seed = 1;
  bool AddRest = false;
  double ReflectanceNoise = -1.0;
};

#endif
