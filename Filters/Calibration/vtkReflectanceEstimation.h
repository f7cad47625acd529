/**
 * @class   vtkReflectanceEstimation
 * @brief   Spectral reflectance from camera responses
 *
 * Input 0 is an image of camera responses or a sample table with responses (C400, ..). Input 1 is a
 * reflectance transform or transfer model, input 2 (optional) a metamerism transform, as Reflectance
 * Calibration and Metamerism Correction make them.
 *
 * An image gets the point array "Reflectance" in place of its responses, one component per band, with
 * the wavelengths as field data; a table gets the columns E400, E410, .. . With a transfer model and
 * EstimateUncertainty also "Uncertainty" or U400, U410, ..: one standard deviation of the error.
 * A NaN stays in its pixel. Float images are computed in float, all else in double.
 */
#ifndef vtkReflectanceEstimation_h
#define vtkReflectanceEstimation_h

#include "MultispectralFiltersCalibrationModule.h"
#include "vtkPassInputTypeAlgorithm.h"

#include <memory>
#include <string>

class MULTISPECTRALFILTERSCALIBRATION_EXPORT vtkReflectanceEstimation
  : public vtkPassInputTypeAlgorithm
{
public:
  static vtkReflectanceEstimation* New();
  vtkTypeMacro(vtkReflectanceEstimation, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The point array that holds the responses. Empty (default): the active scalars.
   */
  vtkSetStdStringFromCharMacro(ResponseArray);
  vtkGetCharFromStdStringMacro(ResponseArray);
  ///@}

  ///@{
  /**
   * Also give the standard uncertainty of each band where the transform knows it. Default on for
   * tables and off for images, where it doubles the memory: AUTOMATIC (0), OFF (1), ON (2).
   */
  vtkSetClampMacro(Uncertainty, int, 0, 2);
  vtkGetMacro(Uncertainty, int);
  ///@}

  ///@{
  /**
   * Add the point array "sRGB" (3 bytes per pixel), the colors that a view shows at first: sRGB under D65 where the
   * bands reach over the visible spectrum. Default on.
   */
  vtkSetMacro(Preview, bool);
  vtkGetMacro(Preview, bool);
  vtkBooleanMacro(Preview, bool);
  ///@}

  ///@{
  /**
   * Also give an image what tells how far to trust a pixel. "OutOfRange": how far its responses lie outside of those
   * that the transform was fitted on, in units of a channel's range, 0 within. "UncertaintyRms", where the transform knows
   * its uncertainty: the root mean square over the bands. Default off.
   */
  vtkSetMacro(QualityMaps, bool);
  vtkGetMacro(QualityMaps, bool);
  vtkBooleanMacro(QualityMaps, bool);
  ///@}

  ///@{
  /**
   * Estimate also an image whose responses are so small or so large beside those of the calibration that they look like
   * raw counts or like frames in each other's place: a warning then, else an error. Default off.
   */
  vtkSetMacro(TrustResponses, bool);
  vtkGetMacro(TrustResponses, bool);
  vtkBooleanMacro(TrustResponses, bool);
  ///@}

  ///@{
  /**
   * Share of the last whole image's pixels whose responses lie outside of the range of the samples that the transform was
   * fitted on by more than a tenth of it; -1 where it is not known.
   */
  vtkGetMacro(OutOfRangeShare, double);
  ///@}

  ///@{
  /**
   * Share of the last whole image's pixels without an estimate, as a response of theirs is not finite (dead, saturated or
   * missing); -1 where no whole image was estimated.
   */
  vtkGetMacro(MissingShare, double);
  ///@}

protected:
  vtkReflectanceEstimation();
  ~vtkReflectanceEstimation() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkReflectanceEstimation(const vtkReflectanceEstimation&) = delete;
  void operator=(const vtkReflectanceEstimation&) = delete;

  std::string ResponseArray;
  int Uncertainty = 0;

  bool Preview = true;
  bool QualityMaps = false;
  bool TrustResponses = false;
  double OutOfRangeShare = -1.0;
  double MissingShare = -1.0;

  struct KnownModel;
  std::unique_ptr<KnownModel> Known;
};

#endif
