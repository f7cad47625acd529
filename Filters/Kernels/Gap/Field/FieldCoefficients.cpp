#include "Kernels/Gap/Field/FieldFit.h"

namespace msi
{

Eigen::VectorXd FieldFitter::coefficients(
  ImageParameter parameter, Eigen::Index channel, const FieldShape& shape) const
{
  using P = ImageParameter;
  const FieldModel& model = Statistics.model;
  Eigen::VectorXd column = Eigen::VectorXd::Zero(FieldColumn::residual());
  const auto one = [&column](FieldColumn::Index at, double weight = 1.0) { column[at] = weight; };
  switch (parameter)
  {
    case P::Gain:
      one(FieldColumn::Gain, 1.0 / model.at(P::Gain, channel));
      break;
    case P::Dark:
      one(FieldColumn::One);
      break;
    case P::Glare:
      one(FieldColumn::Mean);
      break;
    case P::ConservingGlare:
    {
      const double kept = 1.0 - model.at(P::ConservingGlare, channel);
      one(FieldColumn::Gain, -1.0 / kept);
      one(FieldColumn::Mean,
        1.0 + (model.at(P::Glare, channel) + model.at(P::ConservingGlare, channel)) / kept);
      break;
    }
    case P::GradientRight:
      one(FieldColumn::GradientRight);
      break;
    case P::GradientDown:
      one(FieldColumn::GradientDown);
      break;
    case P::GradientBend:
    {
      if (!hasDirection(shape))
      {
        one(FieldColumn::GradientBend);
        break;
      }
      // (a x + b y)^2 out of x^2 + y^2, x^2 - y^2 and x y, a^2 + b^2 = 1
      const double a = shape.gradientRight;
      const double b = shape.gradientDown;
      const double x = model.at(P::CenterX, 0);
      const double y = model.at(P::CenterY, 0);
      one(FieldColumn::RadiusSquared, 0.5);
      one(FieldColumn::GradientRight, x);
      one(FieldColumn::GradientDown, y);
      one(FieldColumn::Gain, -0.5 * (x * x + y * y));
      one(FieldColumn::Saddle, 0.5 * (a * a - b * b));
      one(FieldColumn::Diagonal, 2.0 * a * b);
      break;
    }
    case P::Falloff:
    {
      // About another center than the model's: the same polynomial.
      const double right = shape.centerX - model.at(P::CenterX, 0);
      const double down = shape.centerY - model.at(P::CenterY, 0);
      one(FieldColumn::RadiusSquared, -1.0);
      one(FieldColumn::GradientRight, 2.0 * right);
      one(FieldColumn::GradientDown, 2.0 * down);
      one(FieldColumn::Gain,
        -(right * (shape.centerX + model.at(P::CenterX, 0)) +
          down * (shape.centerY + model.at(P::CenterY, 0))));
      break;
    }
    case P::Fourth:
      one(FieldColumn::RadiusFourth, -1.0);
      break;
    case P::Sixth:
      one(FieldColumn::RadiusSixth, -1.0);
      break;
    case P::CenterX:
      one(FieldColumn::CenterX);
      break;
    case P::CenterY:
      one(FieldColumn::CenterY);
      break;
    case P::Square:
      one(FieldColumn::Square);
      break;
    case P::Exponent:
      one(FieldColumn::Exponent);
      break;
    case P::Compression:
      one(FieldColumn::Square, -1.0);
      break;
    case P::Clip:
      one(FieldColumn::Clip);
      break;
    case P::ClipLevel:
      one(FieldColumn::ClipLevel);
      break;
    case P::Retained:
      one(FieldColumn::Before);
      break;
    case P::FromPrevious:
      one(FieldColumn::FromPrevious);
      break;
    case P::FromNext:
      one(FieldColumn::FromNext);
      break;
    case P::Right:
      one(FieldColumn::Right);
      break;
    case P::Down:
      one(FieldColumn::Down);
      break;
    case P::Magnification:
      one(FieldColumn::Magnification);
      break;
    case P::Rotation:
      one(FieldColumn::Rotation);
      break;
    case P::BlurVariance:
      one(FieldColumn::BlurVariance);
      break;
    case P::TailFraction:
      column.segment(FieldColumn::Tail, TailPasses) = tailWeights(shape.radius).matrix();
      break;
    case P::TailRadius:
      column.segment(FieldColumn::Tail, TailPasses) =
        model.at(P::TailFraction, channel) * tailSlope(shape.radius).matrix();
      break;
    case P::RowSine:
      one(FieldColumn::RowSine);
      break;
    case P::RowCosine:
      one(FieldColumn::RowCosine);
      break;
    case P::ColumnSine:
      one(FieldColumn::ColumnSine);
      break;
    case P::ColumnCosine:
      one(FieldColumn::ColumnCosine);
      break;
    case P::RowGain:
      one(FieldColumn::RowGain);
      break;
    case P::RowOffset:
      one(FieldColumn::RowOffset);
      break;
    case P::ColumnGain:
      one(FieldColumn::ColumnGain);
      break;
    case P::ColumnOffset:
      one(FieldColumn::ColumnOffset);
      break;
    default:
      if (parameter >= P::Light)
      {
        column[FieldColumn::Lights + static_cast<int>(parameter) - static_cast<int>(P::Light)] =
          1.0;
        break;
      }
      column[FieldColumn::Tail + 1 + static_cast<int>(parameter) -
        static_cast<int>(P::SurroundFirst)] = 1.0;
      break;
  }
  return column;
}

} // namespace msi
