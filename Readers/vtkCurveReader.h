/**
 * @class   vtkCurveReader
 * @brief   Reads curves over wavelength: lamps, observers
 *
 * Each file is a table with the wavelength first (nm, any spacing) and one column a curve (Formats/Curves.h). The output
 * is one table by increasing wavelength, "wavelength" and one column a curve, for the inputs of Spectral To Color,
 * CIEDE2000 Evaluator and Method Comparison that take illuminants and an observer; NaN at the wavelengths that a
 * curve's file does not have. A file with one curve names it: lamp.csv gives "lamp"; else the header does. Blanks and
 * commas in names become "-", since lists of illuminants are separated by them. Errors name file, line and column.
 */
#ifndef vtkCurveReader_h
#define vtkCurveReader_h

#include "MultispectralReadersModule.h"
#include "vtkTableAlgorithm.h"

#include <string>
#include <vector>

class MULTISPECTRALREADERS_EXPORT vtkCurveReader : public vtkTableAlgorithm
{
public:
  static vtkCurveReader* New();
  vtkTypeMacro(vtkCurveReader, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The files.
   */
  void AddFileName(const char* name);
  void ClearFileNames();
  ///@}

  /**
   * What the last reading recognized, one remark a line; empty when there was nothing to say.
   */
  vtkGetCharFromStdStringMacro(Notes);

protected:
  vtkCurveReader();
  ~vtkCurveReader() override = default;

  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkCurveReader(const vtkCurveReader&) = delete;
  void operator=(const vtkCurveReader&) = delete;

  std::vector<std::string> FileNames;
  std::string Notes;
};

#endif
