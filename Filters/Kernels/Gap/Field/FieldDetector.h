// The detector's curve: nonlinearity, dark offset, saturation.
#pragma once

#include "Kernels/Gap/Field/FieldModel.h"

#include <Eigen/Core>

namespace msi
{

// What the detector answers to a signal, and the derivatives of the answer.
struct DetectorAnswer
{
  double value;
  double bySignal;
  double bySquare; // of the quadratic, and minus that by the compression
  double byExponent;
  double byOffset;
  double byClip;
  double byClipLevel;
};

class FieldDetector
{
public:
  FieldDetector(const FieldModel& model, Eigen::Index channel);

  DetectorAnswer operator()(double signal) const noexcept;

private:
  double Square, Exponent, Compression, Dark, Clip, Level;
};

// A rounded min(u, level): that of the effect saturation, whose softness is held.
inline constexpr double ClipSoftness = 0.01;

} // namespace msi
