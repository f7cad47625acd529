/**
 * @class   vtkSampleCheck
 * @brief   What to doubt about samples before anything is computed from them
 *
 * Input 0 is a table of samples with measured reflectance and camera responses. Input 1 (optional) is the sample table of the
 * chart that the camera is calibrated with; then the samples are seen by the camera that it shows. The output has a row for each
 * question, column "question": samples in another order, exchanged or odd ones, exchanged or dead channels, another exposure,
 * gamma, saturation, samples that stand twice (see Kernels/Doubts/SampleDoubts.h). Each is a warning, too. No rows: nothing is doubted.
 */
#ifndef vtkSampleCheck_h
#define vtkSampleCheck_h

#include "MultispectralFiltersCalibrationModule.h"
#include "vtkTableAlgorithm.h"

#include <string>

class MULTISPECTRALFILTERSCALIBRATION_EXPORT vtkSampleCheck : public vtkTableAlgorithm
{
public:
  static vtkSampleCheck* New();
  vtkTypeMacro(vtkSampleCheck, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * What the samples are called in the questions. Default "the sample table".
   */
  vtkSetStdStringFromCharMacro(SamplesName);
  vtkGetCharFromStdStringMacro(SamplesName);
  ///@}

protected:
  vtkSampleCheck();
  ~vtkSampleCheck() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSampleCheck(const vtkSampleCheck&) = delete;
  void operator=(const vtkSampleCheck&) = delete;

  std::string SamplesName = "the sample table";
};

#endif
