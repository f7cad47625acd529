#include "Kernels/Difference/SpectralRms.h"

#include <cmath>

namespace msi
{

namespace
{
template <typename Scalar>
using Block = Eigen::Ref<const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>>;

// The sum over the bands of term(measured, estimated), for one sample, in double. Four sums run side
// by side and meet in one order, so that the alignment of the sample makes no difference.
template <typename Scalar, typename Term>
double sumOverBands(
  const Scalar* measured, const Scalar* estimated, Eigen::Index bands, Term term) noexcept
{
  constexpr Eigen::Index Together = 4;
  using Group = Eigen::Array<double, Together, 1>;
  using Values = Eigen::Map<const Eigen::Array<Scalar, Together, 1>>;
  Group sums = Group::Zero();
  Eigen::Index k = 0;
  for (; k + Together <= bands; k += Together)
  {
    const Group s = Values(measured + k).template cast<double>();
    const Group e = Values(estimated + k).template cast<double>();
    sums += term(s, e);
  }
  double total = (sums(0) + sums(1)) + (sums(2) + sums(3));
  for (; k < bands; ++k)
  {
    using One = Eigen::Array<double, 1, 1>;
    total += term(One(static_cast<double>(measured[k])), One(static_cast<double>(estimated[k])))(0);
  }
  return total;
}

template <typename Scalar>
void rms(const Block<Scalar>& measured, const Block<Scalar>& estimated,
  Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>& difference) noexcept
{
  const auto squared = [](const auto& s, const auto& e) { return (s - e).square().eval(); };
  const double bands = static_cast<double>(measured.rows());
  for (Eigen::Index i = 0; i < difference.size(); ++i)
  {
    const double sum =
      sumOverBands(measured.col(i).data(), estimated.col(i).data(), measured.rows(), squared);
    difference(i) = static_cast<Scalar>(std::sqrt(sum / bands));
  }
}
}

void spectralRms(const Eigen::Ref<const Eigen::MatrixXd>& measured,
  const Eigen::Ref<const Eigen::MatrixXd>& estimated,
  Eigen::Ref<Eigen::VectorXd> difference) noexcept
{
  rms<double>(measured, estimated, difference);
}

void spectralRms(const Eigen::Ref<const Eigen::MatrixXf>& measured,
  const Eigen::Ref<const Eigen::MatrixXf>& estimated,
  Eigen::Ref<Eigen::VectorXf> difference) noexcept
{
  rms<float>(measured, estimated, difference);
}

void spectralMeanAbsoluteError(const Eigen::Ref<const Eigen::MatrixXd>& measured,
  const Eigen::Ref<const Eigen::MatrixXd>& estimated,
  Eigen::Ref<Eigen::VectorXd> difference) noexcept
{
  const auto absolute = [](const auto& s, const auto& e) { return (s - e).abs().eval(); };
  const double bands = static_cast<double>(measured.rows());
  for (Eigen::Index i = 0; i < difference.size(); ++i)
  {
    difference(i) =
      sumOverBands(measured.col(i).data(), estimated.col(i).data(), measured.rows(), absolute) /
      bands;
  }
}

void goodnessOfFit(const Eigen::Ref<const Eigen::MatrixXd>& measured,
  const Eigen::Ref<const Eigen::MatrixXd>& estimated,
  Eigen::Ref<Eigen::VectorXd> coefficient) noexcept
{
  const auto product = [](const auto& s, const auto& e) { return (s * e).eval(); };
  const Eigen::Index bands = measured.rows();
  for (Eigen::Index i = 0; i < coefficient.size(); ++i)
  {
    const double* s = measured.col(i).data();
    const double* e = estimated.col(i).data();
    const double lengths =
      std::sqrt(sumOverBands(s, s, bands, product)) * std::sqrt(sumOverBands(e, e, bands, product));
    coefficient(i) = std::abs(sumOverBands(s, e, bands, product)) / lengths;
  }
}

// Kahan's formula: 2 atan2(|u - v|, |u + v|) of the unit vectors.
void spectralAngle(const Eigen::Ref<const Eigen::MatrixXd>& measured,
  const Eigen::Ref<const Eigen::MatrixXd>& estimated, Eigen::Ref<Eigen::VectorXd> angle) noexcept
{
  const auto product = [](const auto& s, const auto& e) { return (s * e).eval(); };
  const Eigen::Index bands = measured.rows();
  for (Eigen::Index i = 0; i < angle.size(); ++i)
  {
    const double* s = measured.col(i).data();
    const double* e = estimated.col(i).data();
    const double perS = 1.0 / std::sqrt(sumOverBands(s, s, bands, product));
    const double perE = 1.0 / std::sqrt(sumOverBands(e, e, bands, product));
    const auto apart = [perS, perE](const auto& a, const auto& b)
    { return (a * perS - b * perE).square().eval(); };
    const auto together = [perS, perE](const auto& a, const auto& b)
    { return (a * perS + b * perE).square().eval(); };
    angle(i) = 2.0 *
      std::atan2(std::sqrt(sumOverBands(s, e, bands, apart)),
        std::sqrt(sumOverBands(s, e, bands, together)));
  }
}

} // namespace msi
