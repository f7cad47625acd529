#include "Kernels/Estimation/TransferObjective.h"

#include "Kernels/Estimation/ThinSvd.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>

namespace msi
{

namespace
{
constexpr double LeastFit = 1e-12; // of outputs whose mean square is 1
using Kernel = TransferKernel;

// Weak prior of the log hyperparameters, for outputs and features of unit variance.
constexpr double PriorDeviation = 2.0;

// Reflectances have about this many independent dimensions, however many bands are sampled.
constexpr double EffectiveOutputs = 4.0;
constexpr double GainDeviation = 0.1;    // of the log gain
constexpr double OffsetDeviation = 0.05; // of the root mean square response
constexpr double Jitter = 1e-10;

// Prior covariance of gains and of offsets, as a Cholesky factor: half common to all channels, half
// smooth over them, a little of each channel's own.
Eigen::MatrixXd channelPriorFactor(Eigen::Index channels)
{
  Eigen::MatrixXd prior(channels, channels);
  for (Eigen::Index i = 0; i < channels; ++i)
  {
    for (Eigen::Index j = 0; j < channels; ++j)
    {
      const double apart = 4.0 * static_cast<double>(i - j) / static_cast<double>(channels);
      prior(i, j) = 0.5 + 0.5 * std::exp(-0.5 * apart * apart) + (i == j ? 0.05 : 0.0);
    }
  }
  return prior.llt().matrixL();
}
}

TransferObjective::TransferObjective(const TransferFeatures& start,
  const Eigen::MatrixXd& chartResponses, const Eigen::MatrixXd& tuningResponses,
  const Eigen::MatrixXd& outputs)
  : Features(start)
  , TuningResponses(tuningResponses)
  , Chart(chartResponses.cols())
  , Tuning(tuningResponses.cols())
  , Channels(chartResponses.rows())
  , ChartShare(std::min(1.0, static_cast<double>(Tuning) / static_cast<double>(Chart)))
  , Center(startingKernel().logarithms)
  , Factor(channelPriorFactor(Channels))
  , X(Channels, Chart + Tuning)
{
  X.leftCols(Chart) = Features.ofChart(chartResponses);
  // The likelihood sees the outputs through their Gram matrix alone: leading components suffice.
  const ThinSvd svd = thinSvd(outputs);
  const double total = svd.singular.squaredNorm();
  Eigen::Index kept = 0;
  double energy = 0.0;
  while (kept < svd.singular.size() && energy < (1.0 - 1e-5) * total)
  {
    energy += std::pow(svd.singular[kept++], 2);
  }
  if (kept == 0) // every sample has the same reflectance: there is nothing to learn but that
  {
    Y = Eigen::MatrixXd::Zero(Chart + Tuning, 1);
    return;
  }
  Y = svd.left.leftCols(kept) *
    (svd.singular.head(kept) * std::sqrt(static_cast<double>(Chart + Tuning) / total)).asDiagonal();
}

Eigen::VectorXd TransferObjective::start() const
{
  Eigen::VectorXd at = Eigen::VectorXd::Zero(Kernel::Count + 2 * Channels);
  at.head<Kernel::Count>() = Center;
  return at;
}

TransferKernel TransferObjective::kernelAt(const Eigen::VectorXd& at) const
{
  return { at.head<Kernel::Count>() };
}

TransferFeatures TransferObjective::featuresAt(const Eigen::VectorXd& at) const
{
  TransferFeatures features = Features;
  features.logGain = GainDeviation * (Factor * at.segment(Kernel::Count, Channels));
  features.offset = OffsetDeviation * (Factor * at.tail(Channels));
  return features;
}

double TransferObjective::likelihood(
  const Eigen::MatrixXd& covarianceMatrix, Eigen::MatrixXd& sensitivity) const
{
  const Eigen::Index samples = Chart + Tuning;
  const Eigen::LLT<Eigen::MatrixXd> cholesky(covarianceMatrix);
  if (cholesky.info() != Eigen::Success)
  {
    return std::numeric_limits<double>::infinity();
  }
  const Eigen::MatrixXd inverseFactor =
    cholesky.matrixL().solve(Eigen::MatrixXd::Identity(samples, samples));
  const Eigen::VectorXd logDiagonal = cholesky.matrixLLT().diagonal().array().log();

  // The chart's own factor is the leading block.
  const Eigen::MatrixXd white = inverseFactor.triangularView<Eigen::Lower>() * Y;
  const double chartFit = white.topRows(Chart).squaredNorm();
  const double tuningFit = white.bottomRows(Tuning).squaredNorm();
  const double count = static_cast<double>(Tuning) + ChartShare * static_cast<double>(Chart);
  // Outputs that are all 0, where every sample has the same reflectance, fit any kernel.
  const double fit = std::max(tuningFit + ChartShare * chartFit, LeastFit * count);
  const double logDeterminant =
    logDiagonal.tail(Tuning).sum() + ChartShare * logDiagonal.head(Chart).sum();

  // Rows of the inverse factor weighted by their share turn K^-1 and the chart's K_A^-1 into one
  // product: sum over rows i of share_i l_i l_i'.
  Eigen::VectorXd share(samples);
  share << Eigen::VectorXd::Constant(Chart, std::sqrt(ChartShare)), Eigen::VectorXd::Ones(Tuning);
  const Eigen::MatrixXd weighted = share.asDiagonal() * inverseFactor;
  sensitivity = Eigen::MatrixXd::Zero(samples, samples);
  sensitivity.selfadjointView<Eigen::Lower>().rankUpdate(
    weighted.transpose(), 0.5 * EffectiveOutputs);
  const Eigen::MatrixXd whole = inverseFactor.transpose() * white;
  const Eigen::MatrixXd chartOnly =
    inverseFactor.topLeftCorner(Chart, Chart).transpose() * white.topRows(Chart);
  const double scale = 0.5 * EffectiveOutputs * count / fit;
  sensitivity.selfadjointView<Eigen::Lower>().rankUpdate(whole, -scale);
  sensitivity.topLeftCorner(Chart, Chart)
    .selfadjointView<Eigen::Lower>()
    .rankUpdate(chartOnly, scale * (1.0 - ChartShare));
  sensitivity = Eigen::MatrixXd(sensitivity.selfadjointView<Eigen::Lower>());
  return EffectiveOutputs * (0.5 * count * std::log(fit) + logDeterminant);
}

double TransferObjective::operator()(const Eigen::VectorXd& at, Eigen::VectorXd& gradient)
{
  const TransferKernel kernel = kernelAt(at);
  const TransferFeatures features = featuresAt(at);
  X.rightCols(Tuning) = features.ofTarget(TuningResponses);

  const double length = kernel[Kernel::Length];
  const Eigen::MatrixXd products = scaledProducts(X, X);
  const Eigen::MatrixXd exponents = scaledDistances(X, X, products) * (1.0 / (length * length));
  const Eigen::MatrixXd smooth = (-0.5 * exponents.array()).exp();
  Eigen::MatrixXd linearWeight =
    Eigen::MatrixXd::Constant(X.cols(), X.cols(), kernel[Kernel::Linear]);
  Eigen::MatrixXd smoothWeight =
    Eigen::MatrixXd::Constant(X.cols(), X.cols(), kernel[Kernel::Smooth]);
  linearWeight.bottomRightCorner(Tuning, Tuning).array() += kernel[Kernel::TargetLinear];
  smoothWeight.bottomRightCorner(Tuning, Tuning).array() += kernel[Kernel::TargetSmooth];
  const Eigen::MatrixXd smoothPart = smoothWeight.cwiseProduct(smooth);
  Eigen::MatrixXd matrix =
    (linearWeight.cwiseProduct(products) + smoothPart).array() + kernel[Kernel::Constant];
  matrix.bottomRightCorner(Tuning, Tuning).array() += kernel[Kernel::TargetConstant];
  matrix.diagonal().head(Chart).array() += kernel[Kernel::ChartNoise] + Jitter;
  matrix.diagonal().tail(Tuning).array() += kernel[Kernel::TargetNoise] + Jitter;

  Eigen::MatrixXd sensitivity;
  double value = likelihood(matrix, sensitivity);
  if (!std::isfinite(value))
  {
    return value;
  }
  const auto ofTarget = [&](const Eigen::MatrixXd& m)
  { return m.bottomRightCorner(Tuning, Tuning); };
  gradient.resize(at.size());
  gradient[Kernel::Constant] = kernel[Kernel::Constant] * sensitivity.sum();
  gradient[Kernel::Linear] = kernel[Kernel::Linear] * sensitivity.cwiseProduct(products).sum();
  gradient[Kernel::Smooth] = kernel[Kernel::Smooth] * sensitivity.cwiseProduct(smooth).sum();
  gradient[Kernel::Length] = sensitivity.cwiseProduct(smoothPart).cwiseProduct(exponents).sum();
  gradient[Kernel::TargetConstant] = kernel[Kernel::TargetConstant] * ofTarget(sensitivity).sum();
  gradient[Kernel::TargetLinear] =
    kernel[Kernel::TargetLinear] * ofTarget(sensitivity).cwiseProduct(ofTarget(products)).sum();
  gradient[Kernel::TargetSmooth] =
    kernel[Kernel::TargetSmooth] * ofTarget(sensitivity).cwiseProduct(ofTarget(smooth)).sum();
  gradient[Kernel::ChartNoise] =
    kernel[Kernel::ChartNoise] * sensitivity.diagonal().head(Chart).sum();
  gradient[Kernel::TargetNoise] =
    kernel[Kernel::TargetNoise] * sensitivity.diagonal().tail(Tuning).sum();

  // Through the target's features: d/dx of x.x'/K and of the smooth part, twice for symmetry.
  const double perChannel = 2.0 / static_cast<double>(Channels);
  const Eigen::MatrixXd linearPull =
    perChannel * sensitivity.rightCols(Tuning).cwiseProduct(linearWeight.rightCols(Tuning));
  const Eigen::MatrixXd smoothPull = (perChannel / (length * length)) *
    sensitivity.rightCols(Tuning).cwiseProduct(smoothPart.rightCols(Tuning));
  Eigen::MatrixXd pull = X * (linearPull + smoothPull);
  pull -= X.rightCols(Tuning) * smoothPull.colwise().sum().asDiagonal();
  chainThroughFeatures(features, pull, gradient);

  const Eigen::VectorXd fromPrior = (at.head<Kernel::Count>() - Center) / PriorDeviation;
  value += 0.5 * fromPrior.squaredNorm() + 0.5 * at.tail(2 * Channels).squaredNorm();
  gradient.head<Kernel::Count>() += fromPrior / PriorDeviation;
  gradient.tail(2 * Channels) += at.tail(2 * Channels);
  return value;
}

void TransferObjective::chainThroughFeatures(const TransferFeatures& features,
  const Eigen::MatrixXd& byFeatures, Eigen::VectorXd& gradient) const
{
  const Eigen::ArrayXXd gained =
    (features.logGain.array().exp().matrix().asDiagonal() * TuningResponses).array() /
    features.responseScale;
  const Eigen::ArrayXXd corrected = gained.colwise() + features.offset.array();
  const Eigen::ArrayXXd slopes =
    corrected.unaryExpr([&](double z) { return slopeToSpace(features.space, z); }) / features.scale;
  const Eigen::ArrayXXd chained = byFeatures.array() * slopes;
  gradient.segment(Kernel::Count, Channels) =
    GainDeviation * (Factor.transpose() * (chained * gained).rowwise().sum().matrix());
  gradient.tail(Channels) =
    OffsetDeviation * (Factor.transpose() * chained.rowwise().sum().matrix());
}

} // namespace msi
