/**
 * @class   vtkSpectralImageReader
 * @brief   Reads multispectral and spectral images, one file or one file per channel
 *
 * TIFF, PNG and EXR stacks, ENVI, spectral EXR, MAT and HDF5; the format is found from the content.
 * The output has one float point array with one component per channel, ordered by wavelength:
 * "Responses" or, where the file or ArrayKind says so, "Reflectance". Wavelengths (nm) are in the
 * field data "Wavelength". The top row of the file is the last row of the image, so that a view shows
 * it upright.
 *
 * Only the rows and columns asked for are read: the reader streams by extent and by piece.
 */
#ifndef vtkSpectralImageReader_h
#define vtkSpectralImageReader_h

#include "MultispectralReadersModule.h"
#include "vtkImageAlgorithm.h"

#include <memory>
#include <string>
#include <vector>

namespace msi
{
class SpectralImageFile;
}

class MULTISPECTRALREADERS_EXPORT vtkSpectralImageReader : public vtkImageAlgorithm
{
public:
  static vtkSpectralImageReader* New();
  vtkTypeMacro(vtkSpectralImageReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * One file with all channels, or one file per channel in any order.
   */
  void AddFileName(const char* name);
  void ClearFileNames();
  int GetNumberOfFileNames() const { return static_cast<int>(this->FileNames.size()); }
  const char* GetFileName(int i) const;
  ///@}

  ///@{
  /**
   * Wavelengths in nm, one per file (or per channel of the one file), over what the files say. None by
   * default: they come from the metadata or the file names.
   */
  void AddWavelength(double nanometres);
  void ClearWavelengths();
  ///@}

  enum ArrayKindType
  {
    FROM_FILE = 0,
    RESPONSES = 1,
    REFLECTANCE = 2
  };
  ///@{
  /**
   * Whether the values are camera responses or reflectance. FROM_FILE (default) takes what the file
   * says, else responses.
   */
  vtkSetClampMacro(ArrayKind, int, FROM_FILE, REFLECTANCE);
  vtkGetMacro(ArrayKind, int);
  ///@}

  ///@{
  /**
   * Scale 8 and 16 bit integers of image stacks so that the largest value of the type is 1 (default);
   * off gives the stored counts.
   */
  vtkSetMacro(ScaleIntegers, bool);
  vtkGetMacro(ScaleIntegers, bool);
  vtkBooleanMacro(ScaleIntegers, bool);
  ///@}

  ///@{
  /**
   * The variable of a MAT file or the dataset of an HDF5 file; empty (default) for the only cube in it.
   */
  vtkSetStdStringFromCharMacro(Variable);
  vtkGetCharFromStdStringMacro(Variable);
  ///@}

  /**
   * What was recognized when the files were opened, one remark a line.
   */
  vtkGetCharFromStdStringMacro(Notes);

protected:
  vtkSpectralImageReader();
  ~vtkSpectralImageReader() override;

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSpectralImageReader(const vtkSpectralImageReader&) = delete;
  void operator=(const vtkSpectralImageReader&) = delete;

  void Open();

  std::vector<std::string> FileNames;
  std::vector<double> Wavelengths;
  int ArrayKind = FROM_FILE;
  bool ScaleIntegers = true;
  std::string Variable;
  std::string Notes;
  std::unique_ptr<msi::SpectralImageFile> File;
  vtkMTimeType OpenTime = 0;
};

#endif
