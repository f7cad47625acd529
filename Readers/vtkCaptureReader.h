/**
 * @class   vtkCaptureReader
 * @brief   Reads a capture: what a real camera answered to measured samples, and the camera simulated beside it
 *
 * A capture is a folder with capture.json, camera.csv, samples.csv and responses.csv.
 *
 * Output 0, camera: wavelength (nm) and one column per channel (responsivity; a response is the sum over rows of
 * responsivity times reflectance, plus Dark), field data Dark and, where known, Noise (read, shot). Output 1, samples:
 * the sample table. Output 2, responses: sample, repeat and one column per channel, one row a reading. Field data
 * Notes of output 1: what was recognized. Errors name file, line and column.
 */
#ifndef vtkCaptureReader_h
#define vtkCaptureReader_h

#include "MultispectralReadersModule.h"
#include "vtkTableAlgorithm.h"

#include <string>
#include <vector>

class MULTISPECTRALREADERS_EXPORT vtkCaptureReader : public vtkTableAlgorithm
{
public:
  static vtkCaptureReader* New();
  vtkTypeMacro(vtkCaptureReader, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The capture's folder, or the capture.json in it.
   */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Captures of the same camera that are read beside the first one, each as a scene of its own: the capture that a diagnosis
   * asked for, say. Folders, or the capture.json in them.
   */
  void AddFurtherCapture(const char* name);
  void ClearFurtherCaptures();
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
  vtkCaptureReader();
  ~vtkCaptureReader() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkCaptureReader(const vtkCaptureReader&) = delete;
  void operator=(const vtkCaptureReader&) = delete;

  std::string FileName;
  std::vector<std::string> FurtherCaptures;
  std::string Notes;
};

#endif
