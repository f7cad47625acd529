#include "Kernels/Gap/Samples/ResidualScatter.h"

#include "Kernels/Gap/Samples/GapNoise.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <vector>

namespace msi
{

namespace
{
constexpr double LeastFactor = 1.25;
constexpr double LargestFactor = 20.0;
constexpr double FarMoreLikely = 10.0; // natural logarithm of the likelihood ratio
constexpr double LeastScatter = 1e-5;
constexpr std::size_t FewestDifferences = 8;
constexpr double MedianOfSquares = 0.4549; // of a standard normal
constexpr double Together = 0.15;          // correlation of neighbouring channels

// Where a function with one hill between ln(low) and ln(high) is highest: golden section.
template <typename Function>
double highest(double low, double high, const Function& function)
{
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = std::log(low);
  double b = std::log(high);
  for (int step = 0; step < 30; ++step)
  {
    const double left = b - golden * (b - a);
    const double right = a + golden * (b - a);
    const bool rises = function(std::exp(left)) < function(std::exp(right));
    (rises ? a : b) = rises ? left : right;
  }
  return std::exp(0.5 * (a + b));
}

// Normal residuals whose covariance, sample by sample, is diagonal plus `common`.
double logLikelihood(const GapData& data, const Eigen::MatrixXd& residual,
  const Eigen::ArrayXXd& variance, const Eigen::MatrixXd& common)
{
  double sum = 0.0;
  for (Eigen::Index j = 0; j < data.samples(); ++j)
  {
    if (data.usable[static_cast<std::size_t>(j)] == 0)
    {
      continue;
    }
    const auto measured = data.count.col(j).array() > 0.0;
    Eigen::MatrixXd covariance = common;
    covariance.diagonal().array() += variance.col(j);
    for (Eigen::Index k = 0; k < data.channels(); ++k)
    {
      if (!measured[k])
      {
        covariance.row(k).setZero();
        covariance.col(k).setZero();
        covariance(k, k) = 1.0;
      }
    }
    const Eigen::LLT<Eigen::MatrixXd> root(covariance);
    const Eigen::VectorXd e = measured.select(residual.col(j), 0.0);
    sum -=
      root.matrixL().toDenseMatrix().diagonal().array().log().sum() + 0.5 * e.dot(root.solve(e));
  }
  return sum;
}
}

double reflectanceScatter(const GapData& data, const Eigen::MatrixXd& residual, double unpredicted)
{
  const auto measured = data.count.array() > 0.0;
  const Eigen::VectorXd gain = reflectanceErrorGain(data.camera);
  const double noise = measured.select(data.variance.array(), 0.0).sum();
  const double perUnit = measured.select(gain.replicate(1, data.samples()).array(), 0.0).sum();
  double variance = std::fmax(unpredicted - noise, 0.0) / perUnit;
  double excess = 0.0;
  double through = 0.0;
  for (Eigen::Index k = 1; k + 1 < data.channels(); ++k)
  {
    std::vector<double> square;
    double allowed = 0.0;
    for (Eigen::Index j = 0; j < data.samples(); ++j)
    {
      if (measured(k - 1, j) && measured(k, j) && measured(k + 1, j))
      {
        square.push_back(
          std::pow(residual(k - 1, j) - 2.0 * residual(k, j) + residual(k + 1, j), 2));
        allowed += data.variance(k - 1, j) + 4.0 * data.variance(k, j) + data.variance(k + 1, j);
      }
    }
    if (square.size() >= FewestDifferences)
    {
      const auto middle = square.begin() + static_cast<std::ptrdiff_t>(square.size() / 2);
      std::nth_element(square.begin(), middle, square.end());
      excess += *middle / MedianOfSquares - allowed / static_cast<double>(square.size());
      const auto& m = data.camera.responsivity();
      through += (m.row(k - 1) - 2.0 * m.row(k) + m.row(k + 1)).squaredNorm();
    }
  }
  if (through > 0.0)
  {
    variance = std::fmin(variance, std::fmax(excess, 0.0) / through);
  }
  return std::fmin(std::sqrt(variance), LargestReflectanceNoise);
}

double excessScatter(const GapData& data, const Eigen::MatrixXd& residual,
  const Eigen::MatrixXd& noise, const Eigen::MatrixXd& integration)
{
  const auto measured = data.count.array() > 0.0;
  const Eigen::MatrixXd& m = data.camera.responsivity();
  const Eigen::MatrixXd through = m * m.transpose();
  const auto noisy = [&](double factor) -> Eigen::ArrayXXd
  { return factor * factor * noise.array() + integration.array(); };
  const auto asNoise = [&](double factor)
  {
    const Eigen::ArrayXXd variance = noisy(factor);
    return -0.5 * measured.select(variance.log() + residual.array().square() / variance, 0.0).sum();
  };
  const auto asReflectance = [&](double scatter)
  { return logLikelihood(data, residual, noisy(1.0), scatter * scatter * through); };
  const double factor = highest(1.0, LargestFactor, asNoise);
  if (factor < LeastFactor ||
    asNoise(factor) <
      asReflectance(highest(LeastScatter, LargestReflectanceNoise, asReflectance)) + FarMoreLikely)
  {
    return 1.0;
  }
  const Eigen::ArrayXXd whitened = measured.select(residual.array() / noisy(factor).sqrt(), 0.0);
  const Eigen::Index pairs = data.channels() - 1;
  const double products = (whitened.topRows(pairs) * whitened.bottomRows(pairs)).sum();
  const double size = whitened.square().sum() / static_cast<double>(data.elements);
  const double correlation =
    products / (size * static_cast<double>(std::max<Eigen::Index>(pairs, 1) * data.samples()));
  return std::fabs(correlation) < Together ? factor : 1.0;
}

} // namespace msi
