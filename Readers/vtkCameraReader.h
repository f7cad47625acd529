/**
 * @class   vtkCameraReader
 * @brief   Reads a camera: its curves, dark response, noise and effects
 *
 * NAME.json with NAME.csv beside it, or a table of curves alone (Formats/CameraDescription.h). The output is the
 * camera as a table (DataModel/CameraTable.h), for Camera Simulator and Camera Model Fit. What was recognized beyond the plain case
 * is in Notes. Errors name file, line and key.
 */
#ifndef vtkCameraReader_h
#define vtkCameraReader_h

#include "MultispectralReadersModule.h"
#include "vtkTableAlgorithm.h"

#include <string>

class MULTISPECTRALREADERS_EXPORT vtkCameraReader : public vtkTableAlgorithm
{
public:
  static vtkCameraReader* New();
  vtkTypeMacro(vtkCameraReader, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The description (.json) or the table of curves.
   */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

  /**
   * What the last reading recognized, one remark a line; empty when there was nothing to say.
   */
  vtkGetCharFromStdStringMacro(Notes);

  /**
   * Whether the content of the file is what this reader reads; ParaView asks before it opens a file.
   */
  virtual int CanReadFile(const char* name);

protected:
  vtkCameraReader();
  ~vtkCameraReader() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkCameraReader(const vtkCameraReader&) = delete;
  void operator=(const vtkCameraReader&) = delete;

  std::string FileName;
  std::string Notes;
};

#endif
