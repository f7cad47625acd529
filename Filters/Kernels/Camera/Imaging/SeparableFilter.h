// Convolution along rows and columns with a kernel for every channel.
#pragma once

#include "Kernels/Camera/Imaging/ImageWindow.h"

#include <Eigen/Core>

namespace msi
{

// A symmetric kernel for every channel: weight 0 at the pixel, weight i at the pixels i * stride away.
// weights: channels x (reach + 1).
struct SymmetricKernel
{
  Eigen::ArrayXXf weights;
  int stride = 1;

  int radius() const noexcept { return (static_cast<int>(weights.cols()) - 1) * stride; }
};

inline constexpr double GaussianCut = 4.0; // standard deviations

// Gaussians of these standard deviations in pixels, cut at GaussianCut of them and scaled to sum one. A deviation
// of zero gives the identity.
SymmetricKernel gaussianKernel(const Eigen::ArrayXd& deviations);

// Convolves the buffer with the kernel along x, then along y. Outside the buffer its edge repeats: so within
// radius() of a cut edge the result is provisional, elsewhere a pixel's bytes do not depend on the window.
// A value that is not finite spreads over the kernel's reach.
// Cost: 2 (reach + 1) multiplications and 4 reach additions a value; memory for the rows that the kernel spans.
void convolve(const SymmetricKernel& kernel, PixelBuffer& buffer);

} // namespace msi
