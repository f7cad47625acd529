/**
 * @class   vtkSampleTableWriter
 * @brief   Writes a table as CSV, complete or not at all
 *
 * Numbers are the shortest decimals that read back to the last bit. Any vtkTable can be written:
 * sample tables, transforms, error summaries. CGATS where the file name ends in .ti3 or .cie; that
 * needs reflectance (R400, ..).
 */
#ifndef vtkSampleTableWriter_h
#define vtkSampleTableWriter_h

#include "MultispectralReadersModule.h"
#include "vtkWriter.h"

#include <string>

class MULTISPECTRALREADERS_EXPORT vtkSampleTableWriter : public vtkWriter
{
public:
  static vtkSampleTableWriter* New();
  vtkTypeMacro(vtkSampleTableWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write; an existing one is replaced when the new one is complete.
   */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

protected:
  vtkSampleTableWriter() = default;
  ~vtkSampleTableWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkSampleTableWriter(const vtkSampleTableWriter&) = delete;
  void operator=(const vtkSampleTableWriter&) = delete;

  std::string FileName;
};

#endif
