/**
 * @class   vtkSceneReader
 * @brief   Opens the folder of a scene: the image, divided by its white reference, and what belongs to it
 *
 * Finds the image, the white and dark frames, the label image and the tables by name and content
 * (Readers/Formats/SceneFolder.h). Output 0 is the image "Responses", from which the frames are taken away as
 * vtkFlatFieldCorrection does; output 1 the label image; outputs 2 to 4 the tables of the patches, of the chart and of
 * the tuning samples. An output whose file is not there is empty.
 */
#ifndef vtkSceneReader_h
#define vtkSceneReader_h

#include "MultispectralSceneModule.h"
#include "vtkImageAlgorithm.h"

#include <memory>
#include <string>

class MULTISPECTRALSCENE_EXPORT vtkSceneReader : public vtkImageAlgorithm
{
public:
  static vtkSceneReader* New();
  vtkTypeMacro(vtkSceneReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The folder, or any file in it.
   */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Reflectance factor of the white reference. Range (0, 2], default 1.
   */
  vtkSetClampMacro(WhiteReflectance, double, 1e-3, 2.0);
  vtkGetMacro(WhiteReflectance, double);
  ///@}

  ///@{
  /**
   * Raw and white values from this level on are saturated and become NaN. 0 (default): none is.
   */
  vtkSetMacro(SaturationLevel, double);
  vtkGetMacro(SaturationLevel, double);
  ///@}

  ///@{
  /**
   * What was found, one part a line.
   */
  vtkGetCharFromStdStringMacro(Notes);
  ///@}

  /**
   * Whether it is a folder with a scene in it; ParaView asks before it opens a folder.
   */
  virtual int CanReadFile(const char* name);

  vtkTypeBool ProcessRequest(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

protected:
  vtkSceneReader();
  ~vtkSceneReader() override;

  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSceneReader(const vtkSceneReader&) = delete;
  void operator=(const vtkSceneReader&) = delete;

  void Open();

  struct Pipeline;
  std::unique_ptr<Pipeline> Parts;
  vtkMTimeType OpenTime = 0;
  std::string FileName;
  std::string Notes;
  double WhiteReflectance = 1.0;
  double SaturationLevel = 0.0;
};

#endif
