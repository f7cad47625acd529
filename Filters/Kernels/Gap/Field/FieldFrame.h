// The frame of zeros that registration leaves around an image.
#pragma once

#include "Kernels/Gap/Field/FieldPair.h"

#include <vector>

namespace msi
{

// A pair with NaN where one image has a frame: pixels that are 0 in all channels, from the border on, where the other image is not as
// dark. Made of any pair where one without a frame is asked for. Holds copies of images with a frame, and the pointers to the others.
class FramelessPair
{
public:
  FramelessPair(const FieldPair& pair);
  FramelessPair(const FramelessPair&) = delete;
  FramelessPair& operator=(const FramelessPair&) = delete;

  const FieldPair& pair() const noexcept { return Pair; }
  double part() const noexcept { return Part; } // of the pixels; 0: there is none

private:
  FieldPair Pair;
  std::vector<float> Real, Simulated;
  double Part = 0.0;
};

} // namespace msi
