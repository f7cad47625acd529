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

double FieldModel::bandFactor(Eigen::Index channel, int x, int y) const noexcept
{
  double factor = 1.0;
  if (rows)
  {
    factor += at(ImageParameter::RowGain, channel) * rows->gain.back()(y, channel);
  }
  if (columns)
  {
    factor += at(ImageParameter::ColumnGain, channel) * columns->gain.back()(x, channel);
  }
  if (rowPeriod > 0.0)
  {
    const double angle = TwoPi * y / rowPeriod;
    factor += at(ImageParameter::RowSine, channel) * std::sin(angle) +
      at(ImageParameter::RowCosine, channel) * std::cos(angle);
  }
  if (columnPeriod > 0.0)
  {
    const double angle = TwoPi * x / columnPeriod;
    factor += at(ImageParameter::ColumnSine, channel) * std::sin(angle) +
      at(ImageParameter::ColumnCosine, channel) * std::cos(angle);
  }
  return factor;
}

double FieldModel::bandOffset(Eigen::Index channel, int x, int y) const noexcept
{
  double sum = 0.0;
  if (rows)
  {
    sum += at(ImageParameter::RowOffset, channel) * rows->offset.back()(y, channel);
  }
  if (columns)
  {
    sum += at(ImageParameter::ColumnOffset, channel) * columns->offset.back()(x, channel);
  }
  return sum;
}

} // namespace msi
