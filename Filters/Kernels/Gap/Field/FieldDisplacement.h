// How far misregistration moves a channel's image from place to place.
#pragma once

#include "Kernels/Gap/Field/FieldModel.h"
#include "Kernels/Gap/Field/FieldPair.h"

namespace msi
{

// Out of the source at middle + R(-rotation) (position - middle - displacement) / (1 + magnification), as
// ChannelRegistration.
class FieldDisplacement
{
public:
  struct Place
  {
    double right;
    double down;
  };

  FieldDisplacement(const FieldPair& pair, const FieldModel& model, Eigen::Index channel);

  // Not the same everywhere.
  bool varies() const noexcept { return Varies; }
  Place at(double x, double y) const noexcept;
  Place atMiddle(const ImageWindow& window) const noexcept
  {
    return at(window.x + 0.5 * (window.width - 1), window.y + 0.5 * (window.height - 1));
  }
  // At (x, y) beyond that in the middle of the window.
  Place beyondMiddle(const ImageWindow& window, double x, double y) const noexcept;

private:
  const FieldPair* Pair;
  Place Moved;
  double Cosine; // over 1 + magnification
  double Sine;
  bool Varies;
};

} // namespace msi
