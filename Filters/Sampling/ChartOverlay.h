// What Chart Finder draws: labels and outlines of patches.
#ifndef ChartOverlay_h
#define ChartOverlay_h

#include "Kernels/Sampling/PatchGrid.h"

#include <array>
#include <vector>

class vtkAlgorithm;
class vtkImageData;
class vtkUnsignedCharArray;

namespace msi
{

using OutlineColor = std::array<unsigned char, 3>;

// Adds "Label" (unsigned short, the active scalars) and "Overlay" (3 bytes) for the pixels of the image.
// picture: colors of the same pixels. colors: of each patch's outline.
// Throws std::runtime_error where 'self' was stopped.
void drawChart(vtkAlgorithm* self, const PatchGrid& grid, const std::vector<OutlineColor>& colors,
  vtkUnsignedCharArray* picture, double lineWidth, vtkImageData* image);

} // namespace msi

#endif
