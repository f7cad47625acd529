// Where the image of a channel shows the scene.
#pragma once

#include "Kernels/Camera/Imaging/ImageWindow.h"
#include "Kernels/Numerics/Angle.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>

namespace msi
{

// The scene is distorted, then turned and magnified about the middle of the image, then moved. Zero: nothing changes.
struct ImageDisplacement
{
  double right = 0.0, down = 0.0; // pixels
  double magnification = 0.0;     // relative growth
  double rotation = 0.0;          // degrees, right towards down
  // Relative growth: radial times the square of the distance from the middle, the others times the place to the right and down,
  // all of them 1 at the end of the longer side.
  double radial = 0.0, keystoneRight = 0.0, keystoneDown = 0.0;
  double aspect = 0.0; // relative growth to the right, and as much less down
  double shear = 0.0;  // to the right by how far it is down, and down by how far it is to the right

  bool alongAxes() const noexcept { return rotation == 0.0 && !distorts(); }
  bool distorts() const noexcept
  {
    return radial != 0.0 || keystoneRight != 0.0 || keystoneDown != 0.0 || aspect != 0.0 ||
      shear != 0.0;
  }
};

// The place of the scene that a pixel shows; both from the middle of the image, in pixels.
class ShownPlace
{
public:
  ShownPlace(const ImageDisplacement& displacement, const ImageExtent& extent) noexcept
    : By(displacement)
    , Half(0.5 * std::max(1, std::max(extent.width, extent.height) - 1))
    , Corner(0.5 * std::hypot(extent.width, extent.height))
    , Cosine(std::cos(By.rotation * Degree) / (1.0 + By.magnification))
    , Sine(std::sin(By.rotation * Degree) / (1.0 + By.magnification))
  {
  }

  Eigen::Vector2d operator()(const Eigen::Vector2d& pixel) const noexcept
  {
    const double offX = pixel.x() - By.right;
    const double offY = pixel.y() - By.down;
    const Eigen::Vector2d place(Cosine * offX + Sine * offY, Cosine * offY - Sine * offX);
    const double x = place.x() / Half;
    const double y = place.y() / Half;
    const double growth = By.radial * (x * x + y * y) + By.keystoneRight * x + By.keystoneDown * y;
    return place - growth * place -
      Eigen::Vector2d(
        By.aspect * place.x() + By.shear * place.y(), By.shear * place.x() - By.aspect * place.y());
  }

  // How far it lies from the pixel at most, in pixels along an axis.
  double farthest() const noexcept
  {
    const double moved =
      (std::max(std::fabs(By.right), std::fabs(By.down)) +
        std::fabs(By.magnification) * (Half + 0.5) +
        std::fabs(By.rotation * Degree) * (Corner + std::hypot(By.right, By.down))) /
      (1.0 + By.magnification);
    const double corner = Corner + moved;
    const double ends = corner / Half;
    return moved +
      corner *
      (std::fabs(By.radial) * ends * ends +
        (std::fabs(By.keystoneRight) + std::fabs(By.keystoneDown)) * ends + std::fabs(By.aspect) +
        std::fabs(By.shear));
  }

private:
  ImageDisplacement By;
  double Half, Corner;
  double Cosine, Sine;
};

} // namespace msi
