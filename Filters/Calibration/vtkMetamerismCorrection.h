/**
 * @class   vtkMetamerismCorrection
 * @brief   Carries a chart's calibration over to another medium by a few tuning samples of it
 *
 * Input 0 is the calibration table (the chart), input 1 the tuning table (samples of the target
 * medium); both with measured reflectance (R400, ..) and camera responses (C400, ..) of the same
 * bands and channels.
 *
 * Output 0 is the reflectance transform W (for a method that is not linear: its model), output 1 the
 * metamerism transform D (the identity where the method has none); both are for Reflectance
 * Estimation, which computes W D v. Output 2 is the summary of the fit, output 3 the history of the
 * rounds of the method Banded.
 */
#ifndef vtkMetamerismCorrection_h
#define vtkMetamerismCorrection_h

#include "MultispectralFiltersCalibrationModule.h"
#include "vtkTableAlgorithm.h"

#include <string>

class MULTISPECTRALFILTERSCALIBRATION_EXPORT vtkMetamerismCorrection : public vtkTableAlgorithm
{
public:
  static vtkMetamerismCorrection* New();
  vtkTypeMacro(vtkMetamerismCorrection, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  // The first of the registry msi::estimationMethods(), whose order is the numbering of Method.
  enum MethodType
  {
    DIRECT = 0,
    PINV = 1,
    POOLED = 2,
    R_MODEL = 3,
    BANDED = 4,
    TRANSFER = 5
  };
  enum StructureType
  {
    AUTOMATIC = 0,
    DIAGONAL = 1,
    TRIDIAGONAL = 2
  };

  ///@{
  /**
   * How the tuning samples are used: DIRECT (not at all), PINV (they alone), POOLED (together with
   * the chart), R_MODEL (a band-wise correction of the estimate), BANDED (the banded metamerism
   * transform D and W solved in turn), TRANSFER (statistical transfer with uncertainty); further numbers are
   * the other methods of the registry. Default TRANSFER.
   */
  void SetMethod(int method);
  vtkGetMacro(Method, int);
  ///@}

  ///@{
  /**
   * Free elements of D beside the constant: the channel alone (DIAGONAL), or also its neighbours
   * (TRIDIAGONAL). AUTOMATIC (default) takes DIAGONAL for channels 30 nm or more apart. For BANDED.
   */
  vtkSetClampMacro(Structure, int, AUTOMATIC, TRIDIAGONAL);
  vtkGetMacro(Structure, int);
  ///@}

  ///@{
  /**
   * Rounds of solving for D and W in turn. Range 1 .. 100, default 2. For BANDED.
   */
  vtkSetClampMacro(MaximumRounds, int, 1, 100);
  vtkGetMacro(MaximumRounds, int);
  ///@}

  ///@{
  /**
   * Also stop when the mean CIEDE2000 of the tuning samples changes by less than ColorThreshold from
   * one round to the next. Off by default; threshold 0.01. For BANDED.
   */
  vtkSetMacro(StopOnColor, bool);
  vtkGetMacro(StopOnColor, bool);
  vtkBooleanMacro(StopOnColor, bool);
  vtkSetClampMacro(ColorThreshold, double, 0.0, 100.0);
  vtkGetMacro(ColorThreshold, double);
  ///@}

  ///@{
  /**
   * Illuminant and observer of that color difference. Defaults D65 and "CIE 1931 2 degree".
   */
  vtkSetStdStringFromCharMacro(Illuminant);
  vtkGetCharFromStdStringMacro(Illuminant);
  vtkSetStdStringFromCharMacro(Observer);
  vtkGetCharFromStdStringMacro(Observer);
  ///@}

  ///@{
  /**
   * Weight of a tuning sample beside a calibration sample. Range 0 .. 1e6; 0 (default) stands for
   * sqrt(L_A / L_T) in BANDED and for 1 in POOLED.
   */
  vtkSetClampMacro(TuningWeight, double, 0.0, 1e6);
  vtkGetMacro(TuningWeight, double);
  ///@}

protected:
  vtkMetamerismCorrection();
  ~vtkMetamerismCorrection() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkMetamerismCorrection(const vtkMetamerismCorrection&) = delete;
  void operator=(const vtkMetamerismCorrection&) = delete;

  int Method = TRANSFER;
  int Structure = AUTOMATIC;
  int MaximumRounds = 2;
  bool StopOnColor = false;
  double ColorThreshold = 0.01;
  std::string Illuminant = "D65";
  std::string Observer = "CIE 1931 2 degree";
  double TuningWeight = 0.0;
};

#endif
