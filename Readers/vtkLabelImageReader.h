/**
 * @class   vtkLabelImageReader
 * @brief   Reads an image whose values name regions: 0 for none, 1, 2, ... for the patches of a chart
 *
 * PNG or TIFF with one integer channel, unscaled. The output has the point array "Label" (int). The top
 * row of the file is the last row of the image, as in the Spectral Image Reader. Only the rows and columns
 * asked for are read.
 */
#ifndef vtkLabelImageReader_h
#define vtkLabelImageReader_h

#include "MultispectralReadersModule.h"
#include "vtkImageAlgorithm.h"

#include <memory>
#include <string>

namespace msi
{
class LabelImageFile;
}

class MULTISPECTRALREADERS_EXPORT vtkLabelImageReader : public vtkImageAlgorithm
{
public:
  static vtkLabelImageReader* New();
  vtkTypeMacro(vtkLabelImageReader, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The label image.
   */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

  ///@{
  /**
   * Read every n-th column and row. From 1 on, default 1, 1.
   */
  vtkSetVector2Macro(Stride, int);
  vtkGetVector2Macro(Stride, int);
  ///@}

  /**
   * Whether the content of the file is what this reader reads; ParaView asks before it opens a file.
   */
  virtual int CanReadFile(const char* name);

protected:
  vtkLabelImageReader();
  ~vtkLabelImageReader() override;

  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkLabelImageReader(const vtkLabelImageReader&) = delete;
  void operator=(const vtkLabelImageReader&) = delete;

  void Open();
  double Bottom() const;

  std::string FileName;
  int Stride[2] = { 1, 1 };
  std::unique_ptr<msi::LabelImageFile> File;
  vtkMTimeType OpenTime = 0;
};

#endif
