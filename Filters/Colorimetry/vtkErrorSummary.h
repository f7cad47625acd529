/**
 * @class   vtkErrorSummary
 * @brief   The statistics of error maps that are larger than memory
 *
 * Input is an image with error maps: arrays of one component named "rms", "dE00 D65", .. as CIEDE2000
 * Evaluator makes them, or one array whose components have these names, as an error map that was written
 * and read again. Output is the summary table of CIEDE2000 Evaluator: metric, illuminant, mean, median,
 * p95, max, count, left_out (not finite).
 *
 * The image is taken in blocks of rows, twice: order statistics need a second look. Ranks share the
 * rows. The figures are exact: the same bytes as of the whole image at once, for any number of ranks and
 * any size of the blocks.
 */
#ifndef vtkErrorSummary_h
#define vtkErrorSummary_h

#include "MultispectralFiltersColorimetryModule.h"
#include "vtkTableAlgorithm.h"

#include <memory>

class MULTISPECTRALFILTERSCOLORIMETRY_EXPORT vtkErrorSummary : public vtkTableAlgorithm
{
public:
  static vtkErrorSummary* New();
  vtkTypeMacro(vtkErrorSummary, vtkTableAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  ///@{
  /**
   * Memory in MiB that one block of rows may take. Range 1 .. 65536, default 16.
   */
  vtkSetClampMacro(BlockSize, int, 1, 65536);
  vtkGetMacro(BlockSize, int);
  ///@}

protected:
  vtkErrorSummary();
  ~vtkErrorSummary() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkErrorSummary(const vtkErrorSummary&) = delete;
  void operator=(const vtkErrorSummary&) = delete;

  struct Passes;

  int BlockSize = 16;
  std::unique_ptr<Passes> Current;
};

#endif
