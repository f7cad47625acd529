/**
 * @class   vtkPatchSampler
 * @brief   From an image of a chart to a table of its patches: mean, deviation and count per channel
 *
 * Input 0 is a spectral image. Input 1 (optional) is a label image (point array of integers: 0 none, 1,
 * 2, ... a patch); without it the patches are a grid between four corners. Input 2 (optional) is a table
 * with the column "label": its rows (names, medium, measured reflectance R400, ..) are joined to the
 * patches, one output row per row of the table; without it every patch that has pixels gives a row.
 *
 * Output columns: those of the joined table, else "label"; "x", "y" (mean pixel position), "count",
 * "left_out" (pixels that are not finite), then C400, .. (of an array "Reflectance": R400, .., or E400, ..
 * where the joined table has measured reflectance) and "deviation C400", .. (of the sample).
 *
 * The images are taken in blocks of rows, which the ranks share; the sums are exact: the same bytes for any
 * number of ranks and any size of the blocks.
 */
#ifndef vtkPatchSampler_h
#define vtkPatchSampler_h

#include "MultispectralFiltersSamplingModule.h"
#include "vtkTableAlgorithm.h"

#include <memory>
#include <string>

namespace msi
{
class PatchGrid;
}

class MULTISPECTRALFILTERSSAMPLING_EXPORT vtkPatchSampler : public vtkTableAlgorithm
{
public:
  static vtkPatchSampler* New();
  vtkTypeMacro(vtkPatchSampler, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * The point array with the spectra. Empty (default): the active scalars.
   */
  vtkSetStdStringFromCharMacro(SpectralArray);
  vtkGetCharFromStdStringMacro(SpectralArray);
  ///@}

  ///@{
  /**
   * Patches along a row and along a column of the grid, where no label image is connected. Range
   * 1 .. 1000, default 6 and 4.
   */
  vtkSetClampMacro(GridColumns, int, 1, 1000);
  vtkGetMacro(GridColumns, int);
  vtkSetClampMacro(GridRows, int, 1, 1000);
  vtkGetMacro(GridRows, int);
  ///@}

  ///@{
  /**
   * Outer corners of the chart in the image's coordinates: first patch, end of the first row, last patch,
   * start of the last row. Patch 1 is at the first corner. All zero (default): the whole image, first
   * patch at the top left, with a warning.
   */
  vtkSetVector2Macro(Corner1, double);
  vtkGetVector2Macro(Corner1, double);
  vtkSetVector2Macro(Corner2, double);
  vtkGetVector2Macro(Corner2, double);
  vtkSetVector2Macro(Corner3, double);
  vtkGetVector2Macro(Corner3, double);
  vtkSetVector2Macro(Corner4, double);
  vtkGetVector2Macro(Corner4, double);
  ///@}

  ///@{
  /**
   * Share of a grid cell's width and height that is sampled, around its middle. Range (0, 1], default 0.5.
   */
  vtkSetClampMacro(PatchFraction, double, 0.01, 1.0);
  vtkGetMacro(PatchFraction, double);
  ///@}

  ///@{
  /**
   * Memory in MiB that one block of rows may take. Range 1 .. 65536, default 16.
   */
  vtkSetClampMacro(BlockSize, int, 1, 65536);
  vtkGetMacro(BlockSize, int);
  ///@}

protected:
  vtkPatchSampler();
  ~vtkPatchSampler() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkPatchSampler(const vtkPatchSampler&) = delete;
  void operator=(const vtkPatchSampler&) = delete;

  struct Sampling;

  bool HasCorners() const;
  msi::PatchGrid MakeGrid(vtkInformation* imageInfo) const;
  void AddBlock(vtkInformationVector** inputs);
  void WriteTable(vtkTable* patchTable, vtkInformation* outInfo);

  std::string SpectralArray;
  int GridColumns = 6;
  int GridRows = 4;
  double Corner1[2] = { 0.0, 0.0 };
  double Corner2[2] = { 0.0, 0.0 };
  double Corner3[2] = { 0.0, 0.0 };
  double Corner4[2] = { 0.0, 0.0 };
  double PatchFraction = 0.5;
  int BlockSize = 16;
  std::unique_ptr<Sampling> Current;
};

#endif
