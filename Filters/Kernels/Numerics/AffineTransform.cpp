#include "Kernels/Numerics/AffineTransform.h"

#include "Kernels/Numerics/AffineKernel.h"
#include "Kernels/Spectra/Reject.h"

#include <cmath>
#include <utility>

namespace msi
{

namespace
{
template <typename T>
Eigen::Index strideOf(Eigen::Index outputs)
{
  constexpr Eigen::Index unit = AffineStrideUnit<T>;
  return (outputs + unit - 1) / unit * unit;
}

// Products with what is left out here would be denormal numbers, on which some processors take a hundred times longer.
Eigen::MatrixXd withoutTiny(const Eigen::MatrixXd& coefficients)
{
  const Eigen::ArrayXd least =
    AffineTransform::TinyCoefficient * coefficients.cwiseAbs().rowwise().maxCoeff().array();
  return (coefficients.array().abs() < least.replicate(1, coefficients.cols()))
    .select(0.0, coefficients);
}

template <typename T>
std::vector<T> packed(const Eigen::MatrixXd& coefficients)
{
  const Eigen::Index outputs = coefficients.rows();
  const Eigen::Index inputs = coefficients.cols() - 1;
  const Eigen::Index stride = strideOf<T>(outputs);
  std::vector<T> values(static_cast<std::size_t>(stride * (inputs + 1)), T(0));
  Eigen::Map<Eigen::Matrix<T, Eigen::Dynamic, Eigen::Dynamic>> view(
    values.data(), stride, inputs + 1);
  view.topRows(outputs) << coefficients.col(inputs).template cast<T>(),
    coefficients.leftCols(inputs).template cast<T>();
  return values;
}

template <typename T>
AffineCoefficients<T> viewOf(const std::vector<T>& values, const AffineTransform& transform)
{
  return { values.data(), transform.inputs(), transform.outputs(),
    strideOf<T>(transform.outputs()) };
}
}

AffineTransform::AffineTransform(Eigen::MatrixXd coefficients)
  : Coefficients(std::move(coefficients))
{
  if (Coefficients.rows() < 1 || Coefficients.cols() < 2)
  {
    reject("an affine transform has ", Coefficients.rows(), " rows and ", Coefficients.cols(),
      " columns; expected at least one row (outputs) and two columns (inputs and constant)");
  }
  for (Eigen::Index column = 0; column < Coefficients.cols(); ++column)
  {
    for (Eigen::Index row = 0; row < Coefficients.rows(); ++row)
    {
      if (!std::isfinite(Coefficients(row, column)))
      {
        reject("coefficient in row ", row + 1, ", column ", column + 1,
          " of an affine transform is ", Coefficients(row, column), "; expected a finite number");
      }
    }
  }
  PackedDouble = packed<double>(Coefficients);
  PackedFloat = packed<float>(withoutTiny(Coefficients));
}

AffineTransform AffineTransform::identity(Eigen::Index size)
{
  return AffineTransform(Eigen::MatrixXd::Identity(size, size + 1));
}

void AffineTransform::apply(const double* in, double* out, Eigen::Index pixels) const noexcept
{
  runAffine(viewOf(PackedDouble, *this), in, out, pixels);
}

void AffineTransform::apply(const float* in, float* out, Eigen::Index pixels) const noexcept
{
  runAffine(viewOf(PackedFloat, *this), in, out, pixels);
}

Eigen::MatrixXd AffineTransform::operator()(const Eigen::MatrixXd& in) const
{
  if (in.rows() != inputs())
  {
    reject("the block has ", in.rows(), " values a pixel but the transform takes ", inputs(),
      "; expected the same number");
  }
  Eigen::MatrixXd out(outputs(), in.cols());
  apply(in.data(), out.data(), in.cols());
  return out;
}

AffineTransform AffineTransform::compose(
  const AffineTransform& after, const AffineTransform& before)
{
  if (after.inputs() != before.outputs())
  {
    reject("the second transform takes ", after.inputs(), " values but the first gives ",
      before.outputs(), "; expected the same number");
  }
  Eigen::MatrixXd coefficients = after.linear() * before.coefficients();
  coefficients.rightCols<1>() += after.constant();
  return AffineTransform(std::move(coefficients));
}

} // namespace msi
