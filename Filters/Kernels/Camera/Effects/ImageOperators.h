// What an effect does to an image, by the place where it acts. Internal to the simulator of images.
#pragma once

#include "Kernels/Camera/Effects/BoundEffect.h"
#include "Kernels/Camera/Imaging/ImageWindow.h"

#include <Eigen/Core>

#include <memory>

namespace msi
{

class ScatterTail;
struct SymmetricKernel;

// Changes a run of pixels from (x, y) to the right, K x P, in place. A pixel's bytes depend on the pixel alone.
class PixelOperator
{
public:
  virtual ~PixelOperator() = default;
  virtual void apply(Eigen::Map<Eigen::MatrixXf> run, int x, int y) const noexcept = 0;
};

template <typename Operator>
std::unique_ptr<PixelOperator> makePixelOperator(const BoundEffect& effect)
{
  return std::make_unique<Operator>(effect);
}

// `step` is what the diagnosis of image pairs does, and how the channels are moved. Of the others at most one is set: then they are
// blurred, scattered, get light from elsewhere in the image, and change pixel by pixel.
struct ImageFactories
{
  SymmetricKernel (*makeBlur)(const BoundEffect&) = nullptr;
  ScatterTail (*makeTail)(const BoundEffect&) = nullptr;
  LightFrom lightFrom = nullptr; // times the first parameter of the form
  std::unique_ptr<PixelOperator> (*makePixels)(const BoundEffect&) = nullptr;
  const ImageStep* step = nullptr; // lives as long as the program
};

} // namespace msi
