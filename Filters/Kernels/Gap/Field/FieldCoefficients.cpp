#include "Kernels/Gap/Field/FieldFit.h"

namespace msi
{

Eigen::VectorXd FieldFitter::coefficients(
  FieldParameter parameter, Eigen::Index channel, double radius) const
{
  using P = FieldParameter;
  const FieldModel& model = Statistics.model;
  Eigen::VectorXd column = Eigen::VectorXd::Zero(FieldColumn::Residual);
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
    case P::Falloff:
      one(FieldColumn::RadiusSquared, -1.0);
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
    case P::Right:
      one(FieldColumn::Right);
      break;
    case P::Down:
      one(FieldColumn::Down);
      break;
    case P::Magnification:
      one(FieldColumn::Magnification);
      break;
    case P::BlurVariance:
      one(FieldColumn::BlurVariance);
      break;
    case P::TailFraction:
      column.segment(FieldColumn::Tail, TailPasses) = tailWeights(radius).matrix();
      break;
    case P::TailRadius:
      column.segment(FieldColumn::Tail, TailPasses) =
        model.at(P::TailFraction, channel) * tailSlope(radius).matrix();
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
    case P::Count:
      break;
    default:
      column[FieldColumn::Tail + 1 + static_cast<int>(parameter) -
        static_cast<int>(P::SurroundFirst)] = 1.0;
      break;
  }
  return column;
}

} // namespace msi
