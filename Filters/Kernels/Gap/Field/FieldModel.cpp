#include "Kernels/Gap/Field/FieldModel.h"

#include "Kernels/Numerics/Angle.h"

#include <cmath>

namespace msi
{

namespace
{
constexpr double NeutralRadius = 8.0;
constexpr double NeutralLevel = 8.0;
}

double neutralValue(ImageParameter parameter) noexcept
{
  switch (parameter)
  {
    case ImageParameter::Gain:
    case ImageParameter::Exponent:
      return 1.0;
    case ImageParameter::TailRadius:
      return NeutralRadius;
    case ImageParameter::ClipLevel:
      return NeutralLevel;
    default:
      return 0.0;
  }
}

FieldModel::FieldModel(Eigen::Index channels)
  : Values(fieldParameterCount())
{
  for (std::size_t p = 0; p < Values.size(); ++p)
  {
    Values[p].setConstant(channels, neutralValue(static_cast<ImageParameter>(p)));
  }
}

bool FieldModel::isNeutral(ImageParameter parameter) const
{
  return ((*this)[parameter] == neutralValue(parameter)).all();
}

bool FieldModel::hasVignetting() const
{
  return !isNeutral(ImageParameter::Falloff) || !isNeutral(ImageParameter::Fourth) ||
    !isNeutral(ImageParameter::Sixth);
}

double FieldModel::gradient(double x, double y) const noexcept
{
  const double right = at(ImageParameter::GradientRight, 0);
  const double down = at(ImageParameter::GradientDown, 0);
  const double bend = at(ImageParameter::GradientBend, 0);
  const double plane = right * x + down * y;
  const double square = right * right + down * down;
  return 1.0 + plane + (bend != 0.0 && square > 0.0 ? bend * plane * plane / square : 0.0);
}

double FieldModel::vignetting(double x, double y) const noexcept
{
  const double right = x - at(ImageParameter::CenterX, 0);
  const double down = y - at(ImageParameter::CenterY, 0);
  const double square = right * right + down * down;
  return std::fmax(1.0 -
      square *
        (at(ImageParameter::Falloff, 0) +
          square * (at(ImageParameter::Fourth, 0) + square * at(ImageParameter::Sixth, 0))),
    0.0);
}

FieldLines::FieldLines(
  const FieldModel& model, bool ofRows, Eigen::Index channel, int fold, int first, int count)
  : sine(Eigen::ArrayXd::Zero(count))
  , cosine(sine)
  , gain(sine)
  , offset(sine)
{
  using P = ImageParameter;
  const double period = ofRows ? model.rowPeriod : model.columnPeriod;
  const FieldProfile* profile = (ofRows ? model.rows : model.columns).get();
  if (period > 0.0)
  {
    const Eigen::ArrayXd angle =
      TwoPi / period * Eigen::ArrayXd::LinSpaced(count, first, first + count - 1);
    sine = angle.sin();
    cosine = angle.cos();
  }
  if (profile != nullptr)
  {
    gain = profile->gainFor(fold).col(channel).segment(first, count);
    offset = profile->offsetFor(fold).col(channel).segment(first, count);
  }
  const auto at = [&](P ofRow, P ofColumn) { return model.at(ofRows ? ofRow : ofColumn, channel); };
  factor = at(P::RowSine, P::ColumnSine) * sine + at(P::RowCosine, P::ColumnCosine) * cosine +
    at(P::RowGain, P::ColumnGain) * gain;
  added = at(P::RowOffset, P::ColumnOffset) * offset;
}

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
