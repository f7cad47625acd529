/**
 * @class   vtkCameraWriter
 * @brief   Writes a camera as NAME.json and NAME.csv, each complete or not at all
 *
 * The input is a camera table: wavelength and one column per channel, field data Dark, Noise, Effects and
 * WhiteAfterEffects. The CSV file holds the curves, the JSON file all else.
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
   * The JSON file to write, with the ending .json; the curves go beside it. Existing files are replaced when the new
   * ones are complete.
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
