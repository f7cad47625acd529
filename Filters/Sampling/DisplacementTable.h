// The displacements of an image's channels as a table: one row per channel.
//
//   channel | x | y | magnification | rotation | x error | y error | magnification error | rotation error | agreement
#ifndef DisplacementTable_h
#define DisplacementTable_h

#include "SpectralAxis.h"

#include "Kernels/Camera/Imaging/ChannelDisplacement.h"

#include <array>
#include <vector>

class vtkTable;

namespace msi
{

// x and y in the length unit of the image, whose pixels have that spacing; errors are standard errors.
void writeDisplacements(const std::vector<ChannelDisplacement>& displacements,
  const SpectralAxis& channels, const std::array<double, 2>& spacing, vtkTable* table);

// Only the first five columns are needed. Throws std::invalid_argument where one is missing, where a value is not
// finite or out of range, or where the rows are not the channels of the image.
std::vector<ChannelDisplacement> readDisplacements(
  vtkTable* table, const SpectralAxis& channels, const std::array<double, 2>& spacing);

} // namespace msi

#endif
