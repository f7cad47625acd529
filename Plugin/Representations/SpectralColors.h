// What the arrays of this plugin's images mean to a view, and their first color maps.
#ifndef SpectralColors_h
#define SpectralColors_h

#include <string>

class vtkPVArrayInformation;
class vtkPVDataInformation;
class vtkPVDataSetAttributesInformation;
class vtkSMProxy;

namespace msi
{

// Colors to be shown as they are: "sRGB", "Display P3", "Overlay" of 3 or 4 bytes a pixel.
bool isPicture(vtkPVArrayInformation* array);

// "dE00 D65", "dECMC A": a color difference and the illuminant.
bool isColorDifference(const std::string& arrayName);

// The array to show at first; null where there is none.
vtkPVArrayInformation* arrayToShow(vtkPVDataSetAttributesInformation* points);

// ParaView shows images as slices, which need two directions: a row of pixels is shown as a line, a single pixel as a point. Null
// for all other images.
const char* typeWithoutArea(vtkPVDataInformation* data);

// Gives a color map the look that its array asks for, unless it was changed already or the user has settings of his own.
// Color differences: perceptually uniform (viridis), fixed from 0 to 5 with equal steps of color at 0, 1, 2, 3 and 5;
// signed differences ("Difference", "Gap", "GapAfter"): diverging, and each time centered on zero; all else: viridis. NaN
// is gray. oneBand: of several components one is shown, not the magnitude over all of them, which is no physical
// quantity.
void styleColors(
  vtkSMProxy* colors, vtkPVArrayInformation* array, vtkPVDataInformation* data, bool oneBand);

} // namespace msi

#endif
