/**
 * @class   vtkGapReportWriter
 * @brief   Writes a diagnosis of the sim-to-real gap as report.json, complete or not at all
 *
 * The input is the summary of vtkSimToRealGap; its field data Report is the text that is written.
 */
#ifndef vtkGapReportWriter_h
#define vtkGapReportWriter_h

#include "MultispectralReadersModule.h"
#include "vtkWriter.h"

#include <string>

class MULTISPECTRALREADERS_EXPORT vtkGapReportWriter : public vtkWriter
{
public:
  static vtkGapReportWriter* New();
  vtkTypeMacro(vtkGapReportWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write; an existing one is replaced when the new one is complete.
   */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

protected:
  vtkGapReportWriter() = default;
  ~vtkGapReportWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override;

private:
  vtkGapReportWriter(const vtkGapReportWriter&) = delete;
  void operator=(const vtkGapReportWriter&) = delete;

  std::string FileName;
};

#endif
