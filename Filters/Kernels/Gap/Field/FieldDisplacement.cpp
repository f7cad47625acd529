#include "Kernels/Gap/Field/FieldDisplacement.h"

#include "Kernels/Camera/Angle.h"

#include <cmath>

namespace msi
{

FieldDisplacement::FieldDisplacement(
  const FieldPair& pair, const FieldModel& model, Eigen::Index channel)
  : Pair(&pair)
  , Moved{ model.at(ImageParameter::Right, channel), model.at(ImageParameter::Down, channel) }
{
  const double scale = 1.0 / (1.0 + model.at(ImageParameter::Magnification, channel));
  const double angle = Degree * model.at(ImageParameter::Rotation, channel);
  Cosine = scale * std::cos(angle);
  Sine = scale * std::sin(angle);
  Varies = Cosine != 1.0 || Sine != 0.0;
}

FieldDisplacement::Place FieldDisplacement::at(double x, double y) const noexcept
{
  if (!Varies)
  {
    return Moved;
  }
  const double right = Pair->offX(x) - Moved.right;
  const double down = Pair->offY(y) - Moved.down;
  return { Pair->offX(x) - Cosine * right - Sine * down,
    Pair->offY(y) - Cosine * down + Sine * right };
}

FieldDisplacement::Place FieldDisplacement::beyondMiddle(
  const ImageWindow& window, double x, double y) const noexcept
{
  const double right = x - (window.x + 0.5 * (window.width - 1));
  const double down = y - (window.y + 0.5 * (window.height - 1));
  return { right - Cosine * right - Sine * down, down - Cosine * down + Sine * right };
}

} // namespace msi
