#include "Kernels/Gap/Diagnosis/LearnedPrior.h"

#include <Eigen/Cholesky>
#include <Eigen/Eigenvalues>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr int Directions = 4;           // of a cubic
constexpr double LeastDeviation = 1e-6; // of the typical size
}

double chanceOfFraction(double fraction, int directions, int channels)
{
  if (channels <= directions || !(fraction > 0.0))
  {
    return 1.0;
  }
  // With fraction = sin^2 the density is sin^(directions - 1) cos^(channels - directions - 1); midpoint rule.
  constexpr int Steps = 2000;
  const double quarter = std::asin(1.0);
  const double from = std::asin(std::sqrt(std::min(fraction, 1.0)));
  const auto integral = [&](double low)
  {
    double sum = 0.0;
    const double step = (quarter - low) / Steps;
    for (int i = 0; i < Steps; ++i)
    {
      const double angle = low + (i + 0.5) * step;
      sum += std::pow(std::sin(angle), directions - 1) *
        std::pow(std::cos(angle), channels - directions - 1);
    }
    return sum * step;
  };
  return integral(from) / integral(0.0);
}

double commonFraction(const Eigen::VectorXd& deviations)
{
  const Eigen::Index channels = deviations.size();
  const double energy = deviations.squaredNorm();
  if (channels <= Directions || !(energy > 0.0))
  {
    return 0.0;
  }
  Eigen::MatrixXd basis(channels, Directions);
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(channels, -1.0, 1.0);
  basis << Eigen::VectorXd::Ones(channels), x.matrix(), x.square().matrix(), x.cube().matrix();
  const Eigen::HouseholderQR<Eigen::MatrixXd> qr(basis);
  const Eigen::MatrixXd q = qr.householderQ() * Eigen::MatrixXd::Identity(channels, Directions);
  return std::min((q.transpose() * deviations).squaredNorm() / energy, 1.0);
}

double chanceOfCubic(const Eigen::VectorXd& deviations)
{
  return chanceOfFraction(
    commonFraction(deviations), Directions, static_cast<int>(deviations.size()));
}

LearnedPrior::LearnedPrior(const std::vector<FreeNumber>& numbers)
{
  const auto count = static_cast<Eigen::Index>(numbers.size());
  covariance = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index first = 0; first < count;)
  {
    const FreeNumber& number = numbers[static_cast<std::size_t>(first)];
    Eigen::Index size = 1;
    while (
      first + size < count && numbers[static_cast<std::size_t>(first + size)].group == number.group)
    {
      ++size;
    }
    auto block = covariance.block(first, first, size, size);
    const double variance = number.spread * number.spread;
    if (!number.perChannel)
    {
      block.diagonal().setConstant(variance);
    }
    else
    {
      Eigen::ArrayXd deviation(size);
      for (Eigen::Index p = 0; p < size; ++p)
      {
        deviation[p] = numbers[static_cast<std::size_t>(first + p)].deviation;
      }
      if (number.ownMean)
      {
        deviation -= deviation.mean();
        block.setConstant(variance);
      }
      const double learned =
        std::fmin(deviation.square().mean() + std::pow(LeastDeviation * number.scale, 2), variance);
      block.diagonal().array() += learned;
      surprise += 0.5 * deviation.square().sum() / learned;
      chanceOfCurve = std::fmin(chanceOfCurve, chanceOfCubic(deviation.matrix()));
    }
    first += size;
  }
}

Eigen::VectorXd LearnedPrior::informationOf(const Eigen::MatrixXd& information) const
{
  if (covariance.size() == 0)
  {
    return {};
  }
  const Eigen::MatrixXd root = covariance.llt().matrixL();
  return Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd>(
    root.transpose() * information * root, Eigen::EigenvaluesOnly)
    .eigenvalues()
    .cwiseMax(0.0);
}

} // namespace msi
