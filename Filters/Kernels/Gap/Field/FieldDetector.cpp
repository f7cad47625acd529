#include "Kernels/Gap/Field/FieldDetector.h"

#include <cmath>

namespace msi
{

namespace
{
constexpr double LeastSignal = 1e-3; // below, a power has no useful slope
}

FieldDetector::FieldDetector(const FieldModel& model, Eigen::Index channel)
  : Square(model.at(ImageParameter::Square, channel))
  , Exponent(model.at(ImageParameter::Exponent, channel))
  , Compression(model.at(ImageParameter::Compression, channel))
  , Dark(model.at(ImageParameter::Dark, channel))
  , Clip(model.at(ImageParameter::Clip, channel))
  , Level(model.at(ImageParameter::ClipLevel, channel))
{
}

DetectorAnswer FieldDetector::operator()(double signal) const noexcept
{
  double power = signal;
  double slope = 1.0;
  double byExponent = 0.0;
  if (signal > 0.0)
  {
    const double logarithm = std::log(signal);
    power = Exponent == 1.0 ? signal : std::exp(Exponent * logarithm);
    slope = Exponent == 1.0 ? 1.0 : Exponent * power / std::fmax(signal, LeastSignal);
    byExponent = power * logarithm;
  }
  const double divisor = 1.0 + Compression * power;
  const double bent = power / divisor;
  const double bySquare = bent * bent;
  const double outer = (1.0 + 2.0 * Square * bent) / (divisor * divisor);
  const double linear = bent + Square * bySquare + Dark;
  // (u + level - sqrt((u - level)^2 + softness^2)) / 2
  const double beyond = linear - Level;
  const double root = std::sqrt(beyond * beyond + ClipSoftness * ClipSoftness);
  const double lost = 0.5 * (beyond + root); // of u
  const double kept = 1.0 - 0.5 * Clip * (1.0 + beyond / root);
  return { linear - Clip * lost, kept * outer * slope, kept * bySquare, kept * outer * byExponent,
    kept, -lost, 0.5 * Clip * (1.0 + beyond / root) };
}

} // namespace msi
