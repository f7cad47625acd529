/**
 * @class   vtkSampleTableReader
 * @brief   Reads measured samples: reflectance and camera responses, one sample a row
 *
 * CSV, CGATS (.ti3, .cie, .txt), CxF3, MAT, or numeric matrices without a header (then ResponseFile
 * names the matrix of responses). Output columns: metadata, then R400, R410, .. (reflectance factor,
 * 1 = perfect white), then C400, C420, .. (camera response, 1 = perfect white).
 *
 * What the reader recognized beyond the plain case (percent, orientation) is in Notes and in the
 * output's field data "Notes". Errors name file, line and column.
 */
#ifndef vtkSampleTableReader_h
#define vtkSampleTableReader_h

#include "MultispectralReadersModule.h"
#include "vtkTableAlgorithm.h"

#include <string>

class MULTISPECTRALREADERS_EXPORT vtkSampleTableReader : public vtkTableAlgorithm
{
public:
  static vtkSampleTableReader* New();
  vtkTypeMacro(vtkSampleTableReader, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file with the samples.
   */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

  ///@{
  /**
   * The file with the responses of the same samples; only beside a matrix without a header.
   */
  vtkSetStdStringFromCharMacro(ResponseFile);
  vtkGetCharFromStdStringMacro(ResponseFile);
  ///@}

  enum UnitType
  {
    RECOGNIZE = 0,
    FACTOR = 1,
    PERCENT = 2
  };
  ///@{
  /**
   * Whether reflectance is a factor (1 = perfect white) or in percent; RECOGNIZE (default) decides
   * from the values and says so.
   */
  vtkSetClampMacro(ReflectanceUnit, int, RECOGNIZE, PERCENT);
  vtkGetMacro(ReflectanceUnit, int);
  ///@}

  ///@{
  /**
   * Wavelengths in nm of a matrix without a header: first, last, step. Default 400, 700, 10.
   */
  vtkSetVector3Macro(MatrixWavelengths, double);
  vtkGetVector3Macro(MatrixWavelengths, double);
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
  vtkSampleTableReader();
  ~vtkSampleTableReader() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSampleTableReader(const vtkSampleTableReader&) = delete;
  void operator=(const vtkSampleTableReader&) = delete;

  std::string FileName;
  std::string ResponseFile;
  int ReflectanceUnit = RECOGNIZE;
  double MatrixWavelengths[3] = { 400.0, 700.0, 10.0 };
  std::string Notes;
};

#endif
