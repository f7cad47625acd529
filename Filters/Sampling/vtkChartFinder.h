/**
 * @class   vtkChartFinder
 * @brief   Finds a chart of equal patches in an image and numbers its pixels by patch
 *
 * Input 0 is an image of responses. Input 1 (optional) is the chart's measured reflectance (R400, ..), one row a patch:
 * it tells which way up the chart lies. Rows are patches by the column "label", else by names such as A1 (column A, row
 * 1), else along the rows.
 *
 * Output 0: the image's frame with the arrays "Label" (0 none, 1, 2, .. along the rows of the chart) and "Overlay" (the
 * image's colors with an outline around each patch: green, red where it is clipped, orange where it is not even; the
 * first patch has a yellow middle). Output 1: the rows of the reference, or one row a patch, with the columns "label",
 * "clipped", "outliers" and "slope" (shares, see Kernels/Sampling/PatchQuality.h) and "note". Output 2: one row with the
 * corners and how sure the search is.
 *
 * The search needs the whole image on every rank; the output is made piece by piece.
 */
#ifndef vtkChartFinder_h
#define vtkChartFinder_h

#include "MultispectralFiltersSamplingModule.h"
#include "vtkImageAlgorithm.h"

class MULTISPECTRALFILTERSSAMPLING_EXPORT vtkChartFinder : public vtkImageAlgorithm
{
public:
  static vtkChartFinder* New();
  vtkTypeMacro(vtkChartFinder, vtkImageAlgorithm);
  void PrintSelf(ostream& os, vtkIndent indent) override;

  enum PlacementType
  {
    AUTOMATIC = 0,
    CORNERS = 1
  };
  ///@{
  /**
   * Search for the chart (default), or take the four corners.
   */
  vtkSetClampMacro(Placement, int, AUTOMATIC, CORNERS);
  vtkGetMacro(Placement, int);
  ///@}

  ///@{
  /**
   * Patches along a row and along a column of the chart. Range 1 .. 1000, default 6 and 4.
   */
  vtkSetClampMacro(GridColumns, int, 1, 1000);
  vtkGetMacro(GridColumns, int);
  vtkSetClampMacro(GridRows, int, 1, 1000);
  vtkGetMacro(GridRows, int);
  ///@}

  ///@{
  /**
   * Outer corners of the chart's patches in the image's coordinates (a third coordinate is ignored): at the first patch,
   * the end of the first row, the last patch, the start of the last row. All zero (default): the whole image.
   */
  vtkSetVector3Macro(Corner1, double);
  vtkGetVector3Macro(Corner1, double);
  vtkSetVector3Macro(Corner2, double);
  vtkGetVector3Macro(Corner2, double);
  vtkSetVector3Macro(Corner3, double);
  vtkGetVector3Macro(Corner3, double);
  vtkSetVector3Macro(Corner4, double);
  vtkGetVector3Macro(Corner4, double);
  ///@}

  ///@{
  /**
   * Part of a cell's width and height that is sampled, around its middle. Range 0.01 .. 1, default 0.5.
   */
  vtkSetClampMacro(PatchFraction, double, 0.01, 1.0);
  vtkGetMacro(PatchFraction, double);
  ///@}

  ///@{
  /**
   * Values from this level on are clipped. 0 (default): the largest value of a channel, where more than one pixel in a
   * thousand has it.
   */
  vtkSetMacro(SaturationLevel, double);
  vtkGetMacro(SaturationLevel, double);
  ///@}

protected:
  vtkChartFinder();
  ~vtkChartFinder() override = default;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int FillOutputPortInformation(int port, vtkInformation* info) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkChartFinder(const vtkChartFinder&) = delete;
  void operator=(const vtkChartFinder&) = delete;

  int Placement = AUTOMATIC;
  int GridColumns = 6;
  int GridRows = 4;
  double Corner1[3] = { 0.0, 0.0, 0.0 };
  double Corner2[3] = { 0.0, 0.0, 0.0 };
  double Corner3[3] = { 0.0, 0.0, 0.0 };
  double Corner4[3] = { 0.0, 0.0, 0.0 };
  double PatchFraction = 0.5;
  double SaturationLevel = 0.0;
};

#endif
