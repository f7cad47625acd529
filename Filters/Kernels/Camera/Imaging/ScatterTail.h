// The broad tail of a point spread.
#pragma once

#include "Kernels/Camera/Imaging/ImageWindow.h"

#include <vector>

namespace msi
{

// A point spread T of sum one that falls from a few pixels to several radii.
//
// A sum of ever wider kernels: the B3 spline (1, 4, 6, 4, 1) / 16 applied with holes of 1, 2, 4, ... pixels
// ("a trous": M. Holschneider et al., in Wavelets, Springer 1989, doi:10.1007/978-3-642-97177-8_28). After n
// passes the variance along an axis is (4^n - 1) / 3. The kernel of pass n has the weight
// 2^-n exp(-deviation_n / (2 radius)), scaled to sum one.
// Range:  radius from 1 to 64 pixels (std::invalid_argument).
// Cost:   about 10 multiplications a value and pass, whatever its width.
class ScatterTail
{
public:
  explicit ScatterTail(double radius);

  // Pixels around a window that its result depends on.
  int reach() const noexcept;
  const std::vector<float>& weights() const noexcept { return Weights; }

  // tail = T buffer. Edges as in convolve(). `buffer` is used up.
  void operator()(PixelBuffer& buffer, PixelBuffer& tail) const;

private:
  std::vector<float> Weights; // of pass 1, 2, ...
};

} // namespace msi
