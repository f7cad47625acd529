// Images that an algorithm computes in strips of rows, because each pixel depends on pixels around it.
#ifndef ImageStrips_h
#define ImageStrips_h

#include "ImagePieces.h"

#include "vtkAlgorithm.h"
#include "vtkSMPTools.h"

#include "Kernels/Camera/Imaging/ImageWindow.h"

#include <algorithm>
#include <atomic>
#include <exception>
#include <stdexcept>

namespace msi
{

inline ImageWindow windowOf(const Extent& extent, const Extent& whole)
{
  return { extent[0] - whole[0], extent[2] - whole[2], extent[1] - extent[0] + 1,
    extent[3] - extent[2] + 1 };
}

// Calls work(first row, rows) for strips that cover [0, rows), in threads, with progress and the chance to abort.
// An exception of the work stops it and goes on to the caller.
template <typename Work>
void forStrips(vtkAlgorithm* algorithm, int rows, int stripRows, double progress, const Work& work)
{
  const int strips = (rows + stripRows - 1) / stripRows;
  const int round = std::max(1, 2 * vtkSMPTools::GetEstimatedNumberOfThreads());
  for (int first = 0; first < strips; first += round)
  {
    if (algorithm->GetAbortExecute())
    {
      throw std::runtime_error("stopped by the user");
    }
    std::atomic<bool> failed{ false };
    vtkSMPTools::For(first, std::min(strips, first + round), 1,
      [&](vtkIdType begin, vtkIdType end)
      {
        for (auto strip = static_cast<int>(begin); strip < end && !failed; ++strip)
        {
          try
          {
            const int row = strip * stripRows;
            work(row, std::min(stripRows, rows - row));
          }
          catch (const std::exception&)
          {
            failed = true;
          }
        }
      });
    if (failed)
    {
      throw std::runtime_error("the memory does not suffice for the image");
    }
    algorithm->UpdateProgress(
      progress + (1.0 - progress) * std::min(1.0, static_cast<double>(first + round) / strips));
  }
}

} // namespace msi

#endif
