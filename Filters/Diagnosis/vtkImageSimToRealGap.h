/**
 * @class   vtkImageSimToRealGap
 * @brief   Where a real and a simulated image of the same scene disagree, because of which effects, and how far that would shrink
 *
 * Input 0 is the real image, input 1 the simulated one: the same size and channels, responses relative to white. Input 2 (optional)
 * is a label image: one number a pixel, 0 for none. NaN: no value.
 *
 * Outputs: 0 the gap map: the real image's geometry with the arrays "Gap" (real - simulated), "GapAfter" (real - corrected) and
 * "Corrected" (the simulated image with the effects that were found); 1 summary, 2 where, 3 causes, 4 candidates,
 * 5 notes, in the columns of vtkSimToRealGap. The summary's field data: Report, the text of report.json; Effects, the
 * list of effects for a camera.
 *
 * Works on the whole images; blocks run in threads and the result does not depend on how many there are.
 */
#ifndef vtkImageSimToRealGap_h
#define vtkImageSimToRealGap_h

#include "MultispectralFiltersDiagnosisModule.h"
#include "vtkImageAlgorithm.h"

#include <string>
#include <vector>

class MULTISPECTRALFILTERSDIAGNOSIS_EXPORT vtkImageSimToRealGap : public vtkImageAlgorithm
{
public:
  static vtkImageSimToRealGap* New();
  vtkTypeMacro(vtkImageSimToRealGap, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum OutputPort
  {
    GAP_MAP = 0,
    SUMMARY = 1,
    WHERE = 2,
    CAUSES = 3,
    CANDIDATES = 4,
    NOTES = 5,
    NUMBER_OF_OUTPUTS = 6
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
   * Whether to add the effect unmodelled_response, which models what no cause explains, to the corrected simulator. Default off.
   */
  vtkSetMacro(AddRest, bool);
  vtkGetMacro(AddRest, bool);
  vtkBooleanMacro(AddRest, bool);
  ///@}

  ///@{
  /**
   * Seed of blocks, folds and resampling; the same seed gives the same result on every machine. Default 1.
   */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

protected:
  vtkImageSimToRealGap();
  ~vtkImageSimToRealGap() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkImageSimToRealGap(const vtkImageSimToRealGap&) = delete;
  void operator=(const vtkImageSimToRealGap&) = delete;

  std::vector<std::string> Without;
  int MaximumCauses = 5;
  int Seed = 1;
  bool AddRest = false;
};

#endif
