/**
 * @class   vtkCameraWriter
 * @brief   Writes a camera: NAME.json with NAME.csv beside it
 *
 * The input is a camera as a table (DataModel/CameraTable.h). Numbers read back to the last bit; each file is complete
 * or absent.
 */
#ifndef vtkCameraWriter_h
#define vtkCameraWriter_h

#include "MultispectralReadersModule.h"
#include "vtkWriter.h"

#include <string>

class MULTISPECTRALREADERS_EXPORT vtkCameraWriter : public vtkWriter
{
public:
  static vtkCameraWriter* New();
  vtkTypeMacro(vtkCameraWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write, a name that ends in .json; existing ones are replaced when the new ones are complete.
   */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

protected:
  vtkCameraWriter() = default;
  ~vtkCameraWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkCameraWriter(const vtkCameraWriter&) = delete;
  void operator=(const vtkCameraWriter&) = delete;

  std::string FileName;
};

#endif
