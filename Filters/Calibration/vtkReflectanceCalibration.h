/**
 * @class   vtkReflectanceCalibration
 * @brief   The linear transform from camera response to reflectance, from measured samples
 *
 * Input 0 is a sample table with measured reflectance (R400, R410, ..) and camera responses
 * (C400, C420, ..). Output 0 is the reflectance transform W, one row per band, for Reflectance
 * Estimation; output 1 the summary of the fit (rank, condition, residual).
 *
 * W is the least-squares solution by pseudoinverse (see Kernels/Estimation/PseudoinverseCalibration.h).
 * Calibrating on a chart is the method "direct", on tuning samples of the target medium "PINV".
 */
#ifndef vtkReflectanceCalibration_h
#define vtkReflectanceCalibration_h

#include "MultispectralFiltersCalibrationModule.h"
#include "vtkTableAlgorithm.h"

class MULTISPECTRALFILTERSCALIBRATION_EXPORT vtkReflectanceCalibration : public vtkTableAlgorithm
{
public:
  static vtkReflectanceCalibration* New();
  vtkTypeMacro(vtkReflectanceCalibration, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum MethodType
  {
    PSEUDOINVERSE = 0,
    RIDGE = 1
  };
  ///@{
  /**
   * PSEUDOINVERSE (default): least squares, the source's W. RIDGE: with a penalty chosen by leave-one-out,
   * for few samples (Kernels/Estimation/RidgeCalibration.h).
   */
  vtkSetClampMacro(Method, int, PSEUDOINVERSE, RIDGE);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /**
   * Singular values below this share of the largest one count as zero. Range [0, 1); negative (the
   * default, -1) takes the rounding error of the system. For PSEUDOINVERSE.
   */
  vtkSetMacro(RankTolerance, double);
  vtkGetMacro(RankTolerance, double);
  ///@}

protected:
  vtkReflectanceCalibration();
  ~vtkReflectanceCalibration() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkReflectanceCalibration(const vtkReflectanceCalibration&) = delete;
  void operator=(const vtkReflectanceCalibration&) = delete;

  int Method = PSEUDOINVERSE;
  double RankTolerance = -1.0;
};

#endif
