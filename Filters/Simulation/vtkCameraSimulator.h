/**
 * @class   vtkCameraSimulator
 * @brief   From reflectance to camera responses: an ideal camera, and everything that can be wrong with one
 *
 * Input 0 is a sample table with reflectance (R400, R410, ..; columns medium, scene, x, y and order are used where an
 * effect asks for them) or a spectral image of reflectance. Input 1 is the camera: a table with `wavelength` and one
 * curve a channel, whose field data may hold Dark, Noise and Effects (DataModel/CameraTable.h). Reflectance on another
 * grid is interpolated.
 *
 * Output: the table with the responses as columns C400 or C1, .. in place of those it had, metadata kept, Repeats
 * times; or the image with the array "Responses".
 *
 * Pieces: an image is asked for in the extent wanted, with the margin that distortion, misregistration, defocus
 * and local stray light reach; whole where veiling glare needs the scene's mean. The same bytes for any number of threads and pieces.
 */
#ifndef vtkCameraSimulator_h
#define vtkCameraSimulator_h

#include "MultispectralFiltersSimulationModule.h"
#include "vtkPassInputTypeAlgorithm.h"

#include <memory>
#include <string>

class vtkImageData;
class vtkTable;

class MULTISPECTRALFILTERSSIMULATION_EXPORT vtkCameraSimulator : public vtkPassInputTypeAlgorithm
{
public:
  static vtkCameraSimulator* New();
  vtkTypeMacro(vtkCameraSimulator, vtkPassInputTypeAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum EffectsType
  {
    IDEAL = 0,
    OF_CAMERA = 1,
    EFFECT_LIST = 2,
    EFFECT_FILE = 3
  };
  ///@{
  /**
   * Which effects are at work: none (IDEAL), those that the camera table carries (OF_CAMERA, default), those of
   * EffectList (EFFECT_LIST) or of EffectFile (EFFECT_FILE).
   */
  vtkSetClampMacro(Effects, int, IDEAL, EFFECT_FILE);
  vtkGetMacro(Effects, int);
  ///@}

  ///@{
  /**
   * Effects as JSON text: [{"effect": "filter_shift", "parameters": {"shift": 2.9}}, ..]. For EFFECT_LIST.
   */
  vtkSetStdStringFromCharMacro(EffectList);
  vtkGetCharFromStdStringMacro(EffectList);
  ///@}

  ///@{
  /**
   * A file with such a list, or with the description of a camera that has one. For EFFECT_FILE.
   */
  vtkSetStdStringFromCharMacro(EffectFile);
  vtkGetCharFromStdStringMacro(EffectFile);
  ///@}

  ///@{
  /**
   * The white was taken with the light and filters as they really are. Default off; on where the camera table says
   * so and its own effects are used.
   */
  vtkSetMacro(WhiteAfterEffects, bool);
  vtkGetMacro(WhiteAfterEffects, bool);
  vtkBooleanMacro(WhiteAfterEffects, bool);
  ///@}

  ///@{
  /**
   * Factor on the light that reaches the detector; the dark response stays. Range above 0, default 1.
   */
  vtkSetMacro(Exposure, double);
  vtkGetMacro(Exposure, double);
  ///@}

  enum NoiseType
  {
    NO_NOISE = 0,
    NOISE_OF_CAMERA = 1,
    NOISE_AS_GIVEN = 2
  };
  ///@{
  /**
   * No noise, that of the camera table where it has one (default), or the following values.
   */
  vtkSetClampMacro(Noise, int, NO_NOISE, NOISE_AS_GIVEN);
  vtkGetMacro(Noise, int);
  ///@}

  ///@{
  /**
   * Standard deviations relative to white, from 0 up, default 0: variance = ReadNoise^2 + ShotNoise^2 u.
   */
  vtkSetMacro(ReadNoise, double);
  vtkGetMacro(ReadNoise, double);
  vtkSetMacro(ShotNoise, double);
  vtkGetMacro(ShotNoise, double);
  ///@}

  ///@{
  /**
   * Standard deviations of each pixel's (or sample's) own gain and offset, from 0 up, default 0. The same in all
   * exposures.
   */
  vtkSetMacro(FixedPatternGain, double);
  vtkGetMacro(FixedPatternGain, double);
  vtkSetMacro(FixedPatternOffset, double);
  vtkGetMacro(FixedPatternOffset, double);
  ///@}

  ///@{
  /**
   * Step of the responses, relative to white; 0 (default) leaves them continuous. 12 bit: 1/4095.
   */
  vtkSetMacro(QuantisationStep, double);
  vtkGetMacro(QuantisationStep, double);
  ///@}

  ///@{
  /**
   * Seed of the noise: from 0 up, default 1. Another seed is another camera: also its fixed pattern changes.
   */
  vtkSetClampMacro(Seed, int, 0, VTK_INT_MAX);
  vtkGetMacro(Seed, int);
  ///@}

  ///@{
  /**
   * Number of the (first) exposure: from 0 up, default 0. Another exposure has other noise, but the same fixed pattern.
   */
  vtkSetClampMacro(ExposureNumber, int, 0, VTK_INT_MAX);
  vtkGetMacro(ExposureNumber, int);
  ///@}

  ///@{
  /**
   * Exposures of every sample of a table: from 1 up, default 1. From 2 on there is a column `repeat`.
   */
  vtkSetClampMacro(Repeats, int, 1, VTK_INT_MAX);
  vtkGetMacro(Repeats, int);
  ///@}

  ///@{
  /**
   * The point array with the reflectance of an image. Empty (default): the active scalars.
   */
  vtkSetStdStringFromCharMacro(ReflectanceArray);
  vtkGetCharFromStdStringMacro(ReflectanceArray);
  ///@}

  ///@{
  /**
   * Names of the media of an image, separated by commas; one name: all of the image.
   */
  vtkSetStdStringFromCharMacro(Media);
  vtkGetCharFromStdStringMacro(Media);
  ///@}

  ///@{
  /**
   * The point array of an image that counts in Media, from 0. Empty (default): every pixel is of the first.
   */
  vtkSetStdStringFromCharMacro(MediumArray);
  vtkGetCharFromStdStringMacro(MediumArray);
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
  vtkCameraSimulator();
  ~vtkCameraSimulator() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkCameraSimulator(const vtkCameraSimulator&) = delete;
  void operator=(const vtkCameraSimulator&) = delete;

  struct Work; // what one execution puts together from the inputs and properties
  Work Prepare(vtkTable* camera);
  void SimulateTable(const Work& work, vtkTable* input, vtkTable* output);
  // Returns false where more of the image has to be asked for first.
  bool SimulateImage(const Work& work, vtkInformation* information, vtkImageData* image,
    vtkInformation* outputInformation, vtkImageData* output);

  int Effects = OF_CAMERA;
  std::string EffectList;
  std::string EffectFile;
  bool WhiteAfterEffects = false;
  double Exposure = 1.0;
  int Noise = NOISE_OF_CAMERA;
  double ReadNoise = 0.0;
  double ShotNoise = 0.0;
  double FixedPatternGain = 0.0;
  double FixedPatternOffset = 0.0;
  double QuantisationStep = 0.0;
  int Seed = 1;
  int ExposureNumber = 0;
  int Repeats = 1;
  std::string ReflectanceArray;
  std::string Media;
  std::string MediumArray;
  // Of the last execution, and so most likely of the next: pixels around the extent wanted, or the whole image.
  int Margin = 0;
  bool WholeImage = false;

  bool Preview = true;
};

#endif
