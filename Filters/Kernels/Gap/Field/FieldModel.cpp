#include "Kernels/Gap/Field/FieldModel.h"

#include <cmath>

namespace msi
{

namespace
{
constexpr double TwoPi = 6.283185307179586;
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

double FieldModel::fieldFactor(double x, double y) const noexcept
{
  return (1.0 + at(FieldParameter::GradientRight, 0) * x +
           at(FieldParameter::GradientDown, 0) * y) *
    (1.0 - at(FieldParameter::Falloff, 0) * (x * x + y * y));
}

double FieldModel::bandFactor(Eigen::Index channel, double x, double y) const noexcept
{
  double factor = 1.0;
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

} // namespace msi
