/**
 * @class   vtkSpectralImageWriter
 * @brief   Writes a spectral image as spectral OpenEXR or ENVI, complete or not at all
 *
 * The format follows the extension: .exr, else ENVI (.hdr, .img, .dat, .raw, .bsq, .bil, .bip). The image
 * is asked for and written in blocks of rows, so that it never stands in memory whole. Under MPI every
 * rank computes its share of each block and the first rank writes: the same bytes for any number of ranks.
 */
#ifndef vtkSpectralImageWriter_h
#define vtkSpectralImageWriter_h

#include "MultispectralReadersModule.h"
#include "vtkWriter.h"

#include <string>

class MULTISPECTRALREADERS_EXPORT vtkSpectralImageWriter : public vtkWriter
{
public:
  static vtkSpectralImageWriter* New();
  vtkTypeMacro(vtkSpectralImageWriter, vtkWriter);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The file to write; an existing one is replaced when the new one is complete.
   */
  vtkSetStdStringFromCharMacro(FileName);
  vtkGetCharFromStdStringMacro(FileName);
  ///@}

  ///@{
  /**
   * The point array to write. Empty (default): the active scalars.
   */
  vtkSetStdStringFromCharMacro(SpectralArray);
  vtkGetCharFromStdStringMacro(SpectralArray);
  ///@}

  ///@{
  /**
   * Memory in MiB that one block of rows may take. Range 1 .. 65536, default 64.
   */
  vtkSetClampMacro(BlockSize, int, 1, 65536);
  vtkGetMacro(BlockSize, int);
  ///@}

  int Write() override;

protected:
  vtkSpectralImageWriter() = default;
  ~vtkSpectralImageWriter() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  void WriteData() override {}

private:
  vtkSpectralImageWriter(const vtkSpectralImageWriter&) = delete;
  void operator=(const vtkSpectralImageWriter&) = delete;

  void WriteBlocks();

  std::string FileName;
  std::string SpectralArray;
  int BlockSize = 64;
};

#endif
