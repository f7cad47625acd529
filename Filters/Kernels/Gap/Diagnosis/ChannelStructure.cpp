#include "Kernels/Gap/Diagnosis/ChannelStructure.h"

#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr int Directions = 4; // of a cubic
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

} // namespace msi
