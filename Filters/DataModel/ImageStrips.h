// Images that an algorithm computes in strips of rows, because each pixel depends on pixels around it.
#ifndef ImageStrips_h
#define ImageStrips_h

#include "ImagePieces.h"
#include "ThreadedParts.h"

#include "Kernels/Camera/Imaging/ImageWindow.h"

#include <algorithm>

namespace msi
{

inline ImageWindow windowOf(const Extent& extent, const Extent& whole)
{
  return { extent[0] - whole[0], extent[2] - whole[2], extent[1] - extent[0] + 1,
    extent[3] - extent[2] + 1 };
}

// Calls work(first row, rows) for strips that cover [0, rows), as forParts() does.
template <typename Work>
void forStrips(vtkAlgorithm* algorithm, int rows, int stripRows, double progress, const Work& work)
{
  forParts(
    algorithm, (rows + stripRows - 1) / stripRows,
    [&](vtkIdType strip)
    {
      const int row = static_cast<int>(strip) * stripRows;
      work(row, std::min(stripRows, rows - row));
    },
    progress);
}

} // namespace msi

#endif
