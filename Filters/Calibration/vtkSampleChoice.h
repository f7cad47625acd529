/**
 * @class   vtkSampleChoice
 * @brief   Which samples of a medium to measure next, from their camera responses alone
 *
 * Input 0 is the sample table of the chart, input 1 that of the candidates; of both only the camera
 * responses (C400, C420, ..) are used. The output has the chosen candidates, the most informative
 * first: all columns of the candidates between rank (1, 2, ..) and explained, the share of the expected
 * error over all candidates that measuring this sample and those before it takes away
 * (see Kernels/Estimation/SampleChoice.h).
 */
#ifndef vtkSampleChoice_h
#define vtkSampleChoice_h

#include "MultispectralFiltersCalibrationModule.h"
#include "vtkTableAlgorithm.h"

class MULTISPECTRALFILTERSCALIBRATION_EXPORT vtkSampleChoice : public vtkTableAlgorithm
{
public:
  static vtkSampleChoice* New();
  vtkTypeMacro(vtkSampleChoice, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * How many samples are chosen. At least 1 and at most as many as there are candidates; default 8.
   */
  vtkSetClampMacro(Count, int, 1, VTK_INT_MAX);
  vtkGetMacro(Count, int);
  ///@}

protected:
  vtkSampleChoice();
  ~vtkSampleChoice() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSampleChoice(const vtkSampleChoice&) = delete;
  void operator=(const vtkSampleChoice&) = delete;

  int Count = 8;
};

#endif
