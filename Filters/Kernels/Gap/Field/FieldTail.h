// The passes of the broad tail one by one.
#pragma once

#include "Kernels/Camera/Imaging/ImageWindow.h"
#include "Kernels/Gap/Field/FieldModel.h"

namespace msi
{

// Pixels around a window that TailPasses passes depend on.
inline constexpr int TailReach = 2 * ((1 << TailPasses) - 1);

// The fraction and radius of the effect's own form that come nearest to free weights of the passes.
struct TailForm
{
  double fraction;
  double radius;
};
TailForm tailForm(const FieldModel& model);

// Adds to `signal` what free weights of the passes bring: sum of weight (surround - signal).
class FieldTail
{
public:
  explicit FieldTail(const FieldModel& model);

  bool isNeutral() const noexcept { return Neutral; }
  int reach() const noexcept { return Neutral ? 0 : TailReach; }
  void operator()(PixelBuffer& signal, PixelBuffer& wide) const;

private:
  FieldModel Model;
  bool Neutral = true;
};

} // namespace msi
