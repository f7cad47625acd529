/**
 * @class   vtkSpectralProfile
 * @brief   The spectra of places in an image, as a table to plot
 *
 * Input 0 is a spectral image, input 1 (optional) a label image: one profile a label. Without it the profiles are
 * those of Points, one a point; without points there is one, of Region.
 *
 * Output: one row a wavelength. Column "wavelength" (nm; "channel", 1, 2, .., where it is not known), and for each
 * profile its mean, named "label 3", "point 1" or "region"; where a profile may have several pixels also
 * "label 3 deviation" (standard deviation of the sample), "label 3 -s" and "label 3 +s" (mean less and plus
 * deviation). Pixels with a value that is not finite are left out. The field data "Profile" and "Count" name the
 * profiles and their pixels.
 *
 * Only the rows asked for are read, in blocks; sums are exact: the same bytes for any number of ranks.
 */
#ifndef vtkSpectralProfile_h
#define vtkSpectralProfile_h

#include "MultispectralFiltersSamplingModule.h"
#include "vtkTableAlgorithm.h"

#include <array>
#include <memory>
#include <string>
#include <vector>

class MULTISPECTRALFILTERSSAMPLING_EXPORT vtkSpectralProfile : public vtkTableAlgorithm
{
public:
  static vtkSpectralProfile* New();
  vtkTypeMacro(vtkSpectralProfile, vtkTableAlgorithm);
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
   * Places in the image's coordinates; each takes the pixel next to it. None by default.
   */
  void AddPoint(double x, double y);
  void ClearPoints();
  ///@}

  ///@{
  /**
   * Which places count: POINTS_OR_REGION (0, default); HANDLE (1): the place Handle alone; or LINE (2): LineCount places, at
   * equal distances from LineStart to LineEnd, both included. A window lets Handle and the line be dragged. Of z nothing
   * depends.
   */
  enum PlaceMode
  {
    POINTS_OR_REGION = 0,
    HANDLE = 1,
    LINE = 2
  };
  vtkSetClampMacro(Place, int, POINTS_OR_REGION, LINE);
  vtkGetMacro(Place, int);
  vtkSetVector3Macro(Handle, double);
  vtkGetVector3Macro(Handle, double);
  vtkSetVector3Macro(LineStart, double);
  vtkGetVector3Macro(LineStart, double);
  vtkSetVector3Macro(LineEnd, double);
  vtkGetVector3Macro(LineEnd, double);
  vtkSetClampMacro(LineCount, int, 2, 1000);
  vtkGetMacro(LineCount, int);
  ///@}

  ///@{
  /**
   * First and last x, first and last y, in the image's coordinates. All zero (default): the whole image.
   */
  vtkSetVector4Macro(Region, double);
  vtkGetVector4Macro(Region, double);
  ///@}

protected:
  vtkSpectralProfile();
  ~vtkSpectralProfile() override;

  int FillInputPortInformation(int port, vtkInformation* info) override;
  int RequestInformation(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestUpdateExtent(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;
  int RequestData(
    vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs) override;

private:
  vtkSpectralProfile(const vtkSpectralProfile&) = delete;
  void operator=(const vtkSpectralProfile&) = delete;

  struct Sampling;

  std::vector<std::array<double, 2>> PlacesOfPoints() const;
  void FindPlaces(vtkInformation* image, bool labelled);
  void AddBlock(vtkInformationVector** inputs);
  void WriteTable(vtkInformation* outInfo, bool labelled);

  std::string SpectralArray;
  std::vector<std::array<double, 2>> Points;
  int Place = POINTS_OR_REGION;
  double Handle[3] = { 0.0, 0.0, 0.0 };
  double LineStart[3] = { 0.0, 0.0, 0.0 };
  double LineEnd[3] = { 0.0, 0.0, 0.0 };
  int LineCount = 5;
  double Region[4] = { 0.0, 0.0, 0.0, 0.0 };
  std::unique_ptr<Sampling> Current;
};

#endif
