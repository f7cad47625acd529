#include "Kernels/Gap/Field/FieldModel.h"

#include "Kernels/Camera/Angle.h"

#include <cmath>

namespace msi
{

namespace
{
constexpr double NeutralRadius = 8.0;
constexpr double NeutralLevel = 8.0;
}

double neutralValue(FieldParameter parameter) noexcept
{
  switch (parameter)
  {
    case FieldParameter::Gain:
    case FieldParameter::Exponent:
      return 1.0;
    case FieldParameter::TailRadius:
      return NeutralRadius;
    case FieldParameter::ClipLevel:
      return NeutralLevel;
    default:
      return 0.0;
  }
}

FieldModel::FieldModel(Eigen::Index channels)
{
  for (std::size_t p = 0; p < FieldParameters; ++p)
  {
    Values[p].setConstant(channels, neutralValue(static_cast<FieldParameter>(p)));
  }
}

bool FieldModel::isNeutral(FieldParameter parameter) const
{
  return ((*this)[parameter] == neutralValue(parameter)).all();
}

bool FieldModel::hasVignetting() const
{
  return !isNeutral(FieldParameter::Falloff) || !isNeutral(FieldParameter::Fourth) ||
    !isNeutral(FieldParameter::Sixth);
}

double FieldModel::gradient(double x, double y) const noexcept
{
  const double right = at(FieldParameter::GradientRight, 0);
  const double down = at(FieldParameter::GradientDown, 0);
  const double bend = at(FieldParameter::GradientBend, 0);
  const double plane = right * x + down * y;
  const double square = right * right + down * down;
  return 1.0 + plane + (bend != 0.0 && square > 0.0 ? bend * plane * plane / square : 0.0);
}

double FieldModel::vignetting(double x, double y) const noexcept
{
  const double right = x - at(FieldParameter::CenterX, 0);
  const double down = y - at(FieldParameter::CenterY, 0);
  const double square = right * right + down * down;
  return std::fmax(1.0 -
      square *
        (at(FieldParameter::Falloff, 0) +
          square * (at(FieldParameter::Fourth, 0) + square * at(FieldParameter::Sixth, 0))),
    0.0);
}

double FieldModel::bandFactor(Eigen::Index channel, int x, int y) const noexcept
{
  double factor = 1.0;
  if (rows)
  {
    factor += at(FieldParameter::RowGain, channel) * rows->gain.back()(y, channel);
  }
  if (columns)
  {
    factor += at(FieldParameter::ColumnGain, channel) * columns->gain.back()(x, channel);
  }
  if (rowPeriod > 0.0)
  {
    const double angle = TwoPi * y / rowPeriod;
    factor += at(FieldParameter::RowSine, channel) * std::sin(angle) +
      at(FieldParameter::RowCosine, channel) * std::cos(angle);
  }
  if (columnPeriod > 0.0)
  {
    const double angle = TwoPi * x / columnPeriod;
    factor += at(FieldParameter::ColumnSine, channel) * std::sin(angle) +
      at(FieldParameter::ColumnCosine, channel) * std::cos(angle);
  }
  return factor;
}

double FieldModel::bandOffset(Eigen::Index channel, int x, int y) const noexcept
{
  double sum = 0.0;
  if (rows)
  {
    sum += at(FieldParameter::RowOffset, channel) * rows->offset.back()(y, channel);
  }
  if (columns)
  {
    sum += at(FieldParameter::ColumnOffset, channel) * columns->offset.back()(x, channel);
  }
  return sum;
}

} // namespace msi
