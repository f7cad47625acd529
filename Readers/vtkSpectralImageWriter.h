/**
 * @class   vtkSpectralImageWriter
 * @brief   Writes a spectral image as spectral OpenEXR or ENVI, complete or not at all
 *
 * The format follows the extension: .exr, or ENVI (.hdr, .img, .dat, .raw, .bsq, .bil, .bip). The image
 * is asked for and written in blocks of rows, so that it never stands in memory whole. Under MPI every
 * rank computes its share of each block and the first rank writes: the same bytes for any number of ranks.
 */
#ifndef vtkSpectralImageWriter_h
#define vtkSpectralImageWriter_h

#include "MultispectralReadersModule.h"
#include "vtkWriter.h"

#include <memory>
#include <string>
#include <vector>

namespace msi
{
class SpectralImageWriter;
}
class vtkDataArray;
class vtkImageData;

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
   * Several point arrays, whose components become the bands one after another, over SpectralArray; their names
   * become the names of the bands. For maps, such as those of errors. None by default.
   */
  void AddPointArray(const char* name);
  void ClearPointArrays();
  ///@}

  enum InterleaveType
  {
    FROM_NAME = 0,
    BSQ = 1,
    BIL = 2,
    BIP = 3
  };
  ///@{
  /**
   * How an ENVI file is interleaved. FROM_NAME (default): as the extension .bsq, .bil or .bip says, else BIL.
   */
  vtkSetClampMacro(Interleave, int, FROM_NAME, BIP);
  vtkGetMacro(Interleave, int);
  ///@}

  enum SampleTypeType
  {
    FLOAT32 = 0,
    FLOAT64 = 1,
    UINT8 = 2,
    INT16 = 3,
    UINT16 = 4,
    INT32 = 5,
    UINT32 = 6
  };
  ///@{
  /**
   * The type of the samples of an ENVI file; default FLOAT32. Integers are rounded; values out of their range and
   * NaN are refused.
   */
  vtkSetClampMacro(SampleType, int, FLOAT32, UINT32);
  vtkGetMacro(SampleType, int);
  ///@}

  ///@{
  /**
   * ENVI: write the most significant byte of a sample first. Default off.
   */
  vtkSetMacro(BigEndian, bool);
  vtkGetMacro(BigEndian, bool);
  vtkBooleanMacro(BigEndian, bool);
  ///@}

  ///@{
  /**
   * ENVI: values are multiplied by this, and the header says so ("reflectance scale factor"). Positive, default 1:
   * as they are.
   */
  vtkSetMacro(ScaleFactor, double);
  vtkGetMacro(ScaleFactor, double);
  ///@}

  ///@{
  /**
   * Memory in MiB that one block of rows may take on its way through the pipeline. Range 1 .. 65536, default 64.
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
  std::vector<vtkDataArray*> ArraysOf(vtkImageData* image) const;
  std::unique_ptr<msi::SpectralImageWriter> CreateFile(
    vtkImageData* image, const std::vector<vtkDataArray*>& arrays, const int whole[6]) const;

  std::string FileName;
  std::string SpectralArray;
  std::vector<std::string> PointArrays;
  int Interleave = FROM_NAME;
  int SampleType = FLOAT32;
  bool BigEndian = false;
  double ScaleFactor = 1.0;
  int BlockSize = 64;
};

#endif
