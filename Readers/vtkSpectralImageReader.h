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
class SpectralPreview;
}
class vtkFloatArray;
class vtkImageData;

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
   * Scale the integers of image stacks (TIFF, PNG, EXR) so that the largest value of their type is 1 (default);
   * off gives the stored counts. ENVI, MAT and HDF5 are read as stored, over the scale factor that an ENVI header
   * states.
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
   * What Variable may be, one name a line: the cubes and matrices of a MAT or HDF5 file. Also known where the file could not be
   * opened because it holds several cubes.
   */
  vtkGetCharFromStdStringMacro(Variables);

  ///@{
  /**
   * The bands to read, counted from 1 in the order of the wavelengths: "1-16, 20". Empty (default): all.
   */
  vtkSetStdStringFromCharMacro(Bands);
  vtkGetCharFromStdStringMacro(Bands);
  ///@}

  ///@{
  /**
   * Read the bands from the first to the second wavelength, nm, both included. 0, 0 (default): all.
   */
  vtkSetVector2Macro(WavelengthRange, double);
  vtkGetVector2Macro(WavelengthRange, double);
  ///@}

  ///@{
  /**
   * Leave out the bands that the file marks as bad (bbl of ENVI). Default off.
   */
  vtkSetMacro(OnlyGoodBands, bool);
  vtkGetMacro(OnlyGoodBands, bool);
  vtkBooleanMacro(OnlyGoodBands, bool);
  ///@}

  ///@{
  /**
   * First and last column, first and last row to read, counted from 0 at the top left of the image. The output
   * keeps its place: its origin is that of the region. 0, -1, 0, -1 (default): the whole image.
   */
  vtkSetVector4Macro(Region, int);
  vtkGetVector4Macro(Region, int);
  ///@}

  ///@{
  /**
   * Read every n-th column and row of the region. From 1 on, default 1, 1.
   */
  vtkSetVector2Macro(Stride, int);
  vtkGetVector2Macro(Stride, int);
  ///@}

  ///@{
  /**
   * Add the point array "sRGB" (3 bytes a pixel), the picture that a view shows, and make it the active scalars; filters
   * of spectra pass over it. Default on.
   */
  vtkSetMacro(Preview, bool);
  vtkGetMacro(Preview, bool);
  vtkBooleanMacro(Preview, bool);
  ///@}

  ///@{
  /**
   * Read a single file together with those beside it whose names differ in the wavelength alone (channel_450nm.tif), as
   * one image. Default off: the file alone, with a warning where it is one channel of such a stack.
   */
  vtkSetMacro(WholeStack, bool);
  vtkGetMacro(WholeStack, bool);
  vtkBooleanMacro(WholeStack, bool);
  ///@}

  /**
   * The names of the stack's files, channel_*nm.tif, where WholeStack has found some; else empty.
   */
  vtkGetCharFromStdStringMacro(StackPattern);

  /**
   * What was recognized when the files were opened, one remark a line.
   */
  vtkGetCharFromStdStringMacro(Notes);

  /**
   * Whether the content of the file is what this reader reads; ParaView asks before it opens a file.
   */
  virtual int CanReadFile(const char* name);

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
  // The files to read, by FileNames and WholeStack.
  std::vector<std::string> FilesToRead();
  void WarnOfPicture();
  void AddPreview(vtkImageData* image, vtkFloatArray* spectra);

  std::vector<std::string> FileNames;
  std::vector<double> Wavelengths;
  int ArrayKind = FROM_FILE;
  bool ScaleIntegers = true;
  std::string Variable;
  std::string Variables;
  std::string Bands;
  double WavelengthRange[2] = { 0.0, 0.0 };
  bool OnlyGoodBands = false;
  bool Preview = true;
  bool WholeStack = false;
  std::string StackPattern;
  std::string Warning; // of what a view shows
  int Region[4] = { 0, -1, 0, -1 };
  int Stride[2] = { 1, 1 };
  double Origin[2] = { 0.0, 0.0 };
  std::string Notes;
  std::unique_ptr<msi::SpectralImageFile> File;
  std::unique_ptr<msi::SpectralPreview> Picture;
  vtkMTimeType OpenTime = 0;
};

#endif
