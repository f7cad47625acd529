// Displacement and magnification of each channel's image.
#pragma once

#include "Kernels/Camera/Imaging/ImageWindow.h"

#include <Eigen/Core>

namespace msi
{

// Moves the image of channel k by (right_k, down_k) pixels and magnifies it by 1 + magnification_k about the
// middle of the image.
//
// Interpolation: cubic convolution, R. G. Keys, IEEE Trans. ASSP 29 (1981) 1153,
//   doi:10.1109/TASSP.1981.1163711 (a = -1/2): exact for quadratics, the identity for whole pixels.
// Edges: the image's edge repeats; near a cut edge of a buffer the result is provisional (see reach()).
// Errors: std::invalid_argument for arrays of different length.
class ChannelRegistration
{
public:
  ChannelRegistration(Eigen::ArrayXd right, Eigen::ArrayXd down, Eigen::ArrayXd magnification,
    const ImageExtent& extent);

  // Pixels around a window that its result depends on.
  int reach() const noexcept { return Reach; }

  // In place; scratch is resized to the buffer.
  void operator()(PixelBuffer& buffer, PixelBuffer& scratch) const;

private:
  Eigen::ArrayXd Right;
  Eigen::ArrayXd Down;
  Eigen::ArrayXd Magnification;
  ImageExtent Extent;
  int Reach;
};

} // namespace msi
