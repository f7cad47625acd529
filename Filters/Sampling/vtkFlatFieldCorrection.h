/**
 * @class   vtkFlatFieldCorrection
 * @brief   From raw counts to responses relative to white: (raw - dark) / (white - dark)
 *
 * Input 0 is the raw image, input 1 (optional) an image of a white reference under the same light, input 2
 * (optional) an image taken with the lens covered. References have the size of the raw image, or one row or one
 * column, which then counts for all; and the same channels. The output array "Responses" is 1 where the raw image
 * equals the white one, times WhiteReflectance. Where exposure times are given, signals are compared per time.
 *
 * Values whose white is not above the dark, and values that are saturated, become NaN; how many is told in DeadCount
 * and SaturatedCount, and where in the array "Mask". A whole image whose white is nowhere above the dark is an error;
 * warnings tell where most values lie below the dark or far above the white, and where there is neither frame.
 */
#ifndef vtkFlatFieldCorrection_h
#define vtkFlatFieldCorrection_h

#include "MultispectralFiltersSamplingModule.h"
#include "vtkImageAlgorithm.h"

#include <vector>

class vtkMultiProcessController;

class MULTISPECTRALFILTERSSAMPLING_EXPORT vtkFlatFieldCorrection : public vtkImageAlgorithm
{
public:
  static vtkFlatFieldCorrection* New();
  vtkTypeMacro(vtkFlatFieldCorrection, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Reflectance factor of the white reference. Range (0, 2], default 1.
   */
  vtkSetClampMacro(WhiteReflectance, double, 1e-3, 2.0);
  vtkGetMacro(WhiteReflectance, double);
  ///@}

  ///@{
  /**
   * Level of the white where no white image is connected. Positive, default 1.
   */
  vtkSetMacro(WhiteLevel, double);
  vtkGetMacro(WhiteLevel, double);
  ///@}

  ///@{
  /**
   * Exposure times of the raw image and of the white reference, in any one unit: one for all channels, or one for each.
   * None (default): equal.
   */
  void AddExposureTime(double time);
  void ClearExposureTimes();
  void AddWhiteExposureTime(double time);
  void ClearWhiteExposureTimes();
  ///@}

  ///@{
  /**
   * Raw and white values from this level on are saturated. 0 (default): none is.
   */
  vtkSetMacro(SaturationLevel, double);
  vtkGetMacro(SaturationLevel, double);
  ///@}

  enum MaskBits : unsigned char
  {
    DEAD = 1,
    RAW_SATURATED = 2,
    WHITE_SATURATED = 4
  };
  ///@{
  /**
   * Add the point array "Mask" (bytes, one component a channel): the sum of MaskBits, 0 where the value is good. Default
   * off.
   */
  vtkSetMacro(ComputeMask, bool);
  vtkGetMacro(ComputeMask, bool);
  vtkBooleanMacro(ComputeMask, bool);
  ///@}

  ///@{
  /**
   * Values of the last execution whose white was not above the dark, and those that were saturated.
   */
  vtkGetMacro(DeadCount, vtkIdType);
  vtkGetMacro(SaturatedCount, vtkIdType);
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
  vtkFlatFieldCorrection();
  ~vtkFlatFieldCorrection() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkFlatFieldCorrection(const vtkFlatFieldCorrection&) = delete;
  void operator=(const vtkFlatFieldCorrection&) = delete;

  struct Judgement;
  Judgement Correct(vtkInformationVector** inputs, vtkInformationVector* outputs, bool judged);
  // Collective where there is a controller.
  void Judge(const Judgement& judgement, vtkMultiProcessController* controller);

  double WhiteReflectance = 1.0;
  double WhiteLevel = 1.0;
  std::vector<double> ExposureTimes;
  std::vector<double> WhiteExposureTimes;
  double SaturationLevel = 0.0;
  bool ComputeMask = false;
  vtkIdType DeadCount = 0;
  vtkIdType SaturatedCount = 0;

  bool Preview = true;
};

#endif
