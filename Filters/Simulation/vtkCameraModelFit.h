/**
 * @class   vtkCameraModelFit
 * @brief   The camera's responsivity and dark response from one measured chart, without knowing its curves
 *
 * Input 0 is a sample table with measured reflectance (R400, R410, ..) and camera responses (C400, .. or C1, ..).
 * Input 1 (optional) is a camera table with the filters as designed; the fit departs from it as little as the chart
 * asks for. See Kernels/Camera/CameraModelFit.h.
 *
 * Output 0: the camera as a table (DataModel/CameraTable.h), for Camera Simulator.
 * Output 1: standard errors on the same grid, the errors of Dark in the field data, and `resolution`: the width in nm
 *           over which the chart alone smears the responsivity at each wavelength; `low C400`, `high C400`, ..: the
 *           responsivity within 95 %.
 * Output 2: one row: held-out rms, weights, what the chart determines, and in `status` what it cannot determine.
 * Output 3: one row a channel: centroid, dark response and its standard error, rms of the residuals.
 */
#ifndef vtkCameraModelFit_h
#define vtkCameraModelFit_h

#include "MultispectralFiltersSimulationModule.h"
#include "vtkTableAlgorithm.h"

class MULTISPECTRALFILTERSSIMULATION_EXPORT vtkCameraModelFit : public vtkTableAlgorithm
{
public:
  static vtkCameraModelFit* New();
  vtkTypeMacro(vtkCameraModelFit, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Distance in nm from a channel's center at which the penalty on far light sets in. Range above 0, default 15.
   */
  vtkSetMacro(PassbandWidth, double);
  vtkGetMacro(PassbandWidth, double);
  ///@}

  ///@{
  /**
   * Folds of the cross-validation that chooses the weights of the penalties. Range from 2 up, default 5.
   */
  vtkSetClampMacro(Folds, int, 2, VTK_INT_MAX);
  vtkGetMacro(Folds, int);
  ///@}

  ///@{
  /**
   * Draws of the bootstrap that gives the standard errors; 0 leaves them out. Range from 0 up, default 100.
   */
  vtkSetClampMacro(Draws, int, 0, VTK_INT_MAX);
  vtkGetMacro(Draws, int);
  ///@}

  ///@{
  /**
   * Seed of folds and draws. Range from 0 up, default 1.
   */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Take the dark response of the nominal camera instead of fitting it. Default off.
   */
  // Straighten the responses by the detector's curve, where one is found; the camera then has it as an effect. Default
  // off.
  vtkSetMacro(DetectorCurve, bool);
  vtkGetMacro(DetectorCurve, bool);
  vtkBooleanMacro(DetectorCurve, bool);
  vtkSetMacro(KeepDark, bool);
  vtkGetMacro(KeepDark, bool);
  vtkBooleanMacro(KeepDark, bool);
  ///@}

protected:
  vtkCameraModelFit();
  ~vtkCameraModelFit() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkCameraModelFit(const vtkCameraModelFit&) = delete;
  void operator=(const vtkCameraModelFit&) = delete;

  double PassbandWidth = 15.0;
  int Folds = 5;
  int Draws = 100;
  int Seed = 1;
  bool DetectorCurve = false;
  bool KeepDark = false;
};

#endif
