// Convolution along rows and columns of an image that comes row by row.
#pragma once

#include "Kernels/Camera/Imaging/RowRing.h"
#include "Kernels/Camera/Imaging/SeparableFilter.h"

#include <cstddef>
#include <vector>

namespace msi
{

// convolve() with one row after the other: the same bytes, and memory for the rows that the kernel spans alone.
class RowConvolution
{
public:
  // For an image of this many pixels; forgets the rows of the image before, keeps their memory.
  void begin(const SymmetricKernel& kernel, int width, int height);

  // The next row from the top, all channels of a pixel together. Calls emit(const float*) for every row that is
  // complete by it, from the top; after the last one all have come out.
  template <typename Emit>
  void push(const float* row, const Emit& emit)
  {
    take(row);
    while (hasNext())
    {
      emit(next());
    }
  }

private:
  void take(const float* row);
  void alongRow(const float* self, float* out, std::size_t pixels);
  bool hasNext() const noexcept
  {
    return Given < Height && (Taken == Height || Given + Radius < Taken);
  }
  const float* next();

  std::vector<float> Weights; // tap by tap, each repeated over a tile of pixels
  std::size_t Period = 0;
  std::size_t Taps = 0;
  int Stride = 1;
  int Radius = 0;
  std::size_t Channels = 0;
  std::size_t Count = 0; // values of a row
  int Height = 0;
  int Taken = 0; // rows
  int Given = 0;
  RowRing Ring; // rows convolved along x
  std::vector<float> Padded, Out;
  std::vector<const float*> Before, After;
};

} // namespace msi
