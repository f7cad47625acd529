#include "Kernels/Estimation/Transfer/TransferObjective.h"

#include "Kernels/Numerics/LowerTriangle.h"
#include "Kernels/Numerics/ThinSvd.h"

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
    Y = Eigen::MatrixXd::Zero(1, Chart + Tuning);
    return;
  }
  const double scale = std::sqrt(static_cast<double>(Chart + Tuning) / total);
  Y = (scale * svd.singular.head(kept)).asDiagonal() * svd.left.leftCols(kept).transpose();
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

auto TransferObjective::squaredDistancesBelow(Eigen::Index j) const
{
  const Eigen::Index below = Chart + Tuning - j;
  return (Norms.tail(below) + Norms[j] - 2.0 * Products.col(j).tail(below).array()).max(0.0);
}

void TransferObjective::computeCovariance(const TransferKernel& kernel)
{
  const Eigen::Index samples = Chart + Tuning;
  const double perChannel = 1.0 / static_cast<double>(Channels);
  const double length = kernel[Kernel::Length];
  Norms = X.colwise().squaredNorm().transpose() * perChannel;
  Products.setZero(samples, samples);
  const Eigen::MatrixXd rows = X.transpose();
  addOuterProduct(Products, perChannel * rows, rows);
  Smooth.resize(samples, samples);
  Matrix.resize(samples, samples);
  for (Eigen::Index j = 0; j < samples; ++j)
  {
    const bool ofTarget = j >= Chart; // and so is every row below
    const double constant =
      kernel[Kernel::Constant] + (ofTarget ? kernel[Kernel::TargetConstant] : 0.0);
    const double linear = kernel[Kernel::Linear] + (ofTarget ? kernel[Kernel::TargetLinear] : 0.0);
    const double smooth = kernel[Kernel::Smooth] + (ofTarget ? kernel[Kernel::TargetSmooth] : 0.0);
    auto similar = Smooth.col(j).tail(samples - j).array();
    similar = (squaredDistancesBelow(j) * (-0.5 / (length * length))).exp();
    Matrix.col(j).tail(samples - j).array() =
      constant + linear * Products.col(j).tail(samples - j).array() + smooth * similar;
    Matrix(j, j) += kernel[ofTarget ? Kernel::TargetNoise : Kernel::ChartNoise] + Jitter;
  }
}

double TransferObjective::likelihood()
{
  const Eigen::Index samples = Chart + Tuning;
  Eigen::VectorXd diagonal(samples);
  Work.resize(samples, samples);
  if (!invertFactor(Matrix, diagonal, Work))
  {
    return std::numeric_limits<double>::infinity();
  }
  const Eigen::VectorXd logDiagonal = diagonal.array().log();

  // The chart's own factor is the leading block.
  Eigen::MatrixXd white = Eigen::MatrixXd::Zero(Y.rows(), samples);
  addTimesTransposedLower(white, Y, Matrix);
  const double chartFit = white.leftCols(Chart).squaredNorm();
  const double tuningFit = white.rightCols(Tuning).squaredNorm();
  const double count = static_cast<double>(Tuning) + ChartShare * static_cast<double>(Chart);
  // Outputs that are all 0, where every sample has the same reflectance, fit any kernel.
  const double fit = std::max(tuningFit + ChartShare * chartFit, LeastFit * count);
  const double logDeterminant =
    logDiagonal.tail(Tuning).sum() + ChartShare * logDiagonal.head(Chart).sum();
  const double scale = 0.5 * EffectiveOutputs * count / fit;
  Eigen::MatrixXd whole = Eigen::MatrixXd::Zero(Y.rows(), samples);
  addTimesLower(whole, white, Matrix);
  Eigen::MatrixXd ofChart = Eigen::MatrixXd::Zero(Y.rows(), Chart);
  addTimesLower(ofChart, white.leftCols(Chart), Matrix.topLeftCorner(Chart, Chart));

  // Rows of the inverse factor weighted by their share turn K^-1 and the chart's K_A^-1 into one
  // product: sum over rows i of share_i l_i l_i'.
  const double weight = std::sqrt(0.5 * EffectiveOutputs);
  Matrix.topRows(Chart) *= weight * std::sqrt(ChartShare);
  Matrix.bottomRows(Tuning) *= weight;
  Sensitivity.setZero(samples, samples);
  addSquare(Sensitivity, Matrix, Work);
  addOuterProduct(Sensitivity, -scale * whole.transpose(), whole.transpose());
  addOuterProduct(Sensitivity.topLeftCorner(Chart, Chart),
    scale * (1.0 - ChartShare) * ofChart.transpose(), ofChart.transpose());
  return EffectiveOutputs * (0.5 * count * std::log(fit) + logDeterminant);
}

TransferObjective::Sums TransferObjective::sumsOver(Eigen::Index first, Eigen::Index end) const
{
  Sums sums;
  for (Eigen::Index j = first; j < end; ++j)
  {
    const Eigen::Index below = Chart + Tuning - j;
    const auto pull = Sensitivity.col(j).tail(below).array();
    const auto similar = Smooth.col(j).tail(below).array();
    const auto products = Products.col(j).tail(below).array();
    const double diagonal = Sensitivity(j, j); // counts once, what is below twice
    sums.noise += diagonal;
    sums.constant += 2.0 * pull.sum() - diagonal;
    sums.linear += 2.0 * (pull * products).sum() - diagonal * Products(j, j);
    sums.smooth += 2.0 * (pull * similar).sum() - diagonal * Smooth(j, j);
    sums.length += 2.0 * (pull * similar * squaredDistancesBelow(j)).sum();
  }
  return sums;
}

double TransferObjective::operator()(const Eigen::VectorXd& at, Eigen::VectorXd& gradient)
{
  const TransferKernel kernel = kernelAt(at);
  const TransferFeatures features = featuresAt(at);
  X.rightCols(Tuning) = features.ofTarget(TuningResponses);
  computeCovariance(kernel);
  double value = likelihood();
  if (!std::isfinite(value))
  {
    return value;
  }
  const Sums chart = sumsOver(0, Chart);
  const Sums target = sumsOver(Chart, Chart + Tuning);
  const double inverseSquare = 1.0 / (kernel[Kernel::Length] * kernel[Kernel::Length]);
  const double targetLinear = kernel[Kernel::Linear] + kernel[Kernel::TargetLinear];
  const double targetSmooth = kernel[Kernel::Smooth] + kernel[Kernel::TargetSmooth];
  gradient.resize(at.size());
  gradient[Kernel::Constant] = kernel[Kernel::Constant] * (chart.constant + target.constant);
  gradient[Kernel::Linear] = kernel[Kernel::Linear] * (chart.linear + target.linear);
  gradient[Kernel::Smooth] = kernel[Kernel::Smooth] * (chart.smooth + target.smooth);
  gradient[Kernel::Length] =
    inverseSquare * (kernel[Kernel::Smooth] * chart.length + targetSmooth * target.length);
  gradient[Kernel::TargetConstant] = kernel[Kernel::TargetConstant] * target.constant;
  gradient[Kernel::TargetLinear] = kernel[Kernel::TargetLinear] * target.linear;
  gradient[Kernel::TargetSmooth] = kernel[Kernel::TargetSmooth] * target.smooth;
  gradient[Kernel::ChartNoise] = kernel[Kernel::ChartNoise] * chart.noise;
  gradient[Kernel::TargetNoise] = kernel[Kernel::TargetNoise] * target.noise;

  // Through the target's features: d/dx of x.x'/K and of the smooth part, twice for symmetry. One row a
  // tuning sample.
  const double perChannel = 2.0 / static_cast<double>(Channels);
  Eigen::MatrixXd pulls(Tuning, Chart + Tuning);
  pulls << Sensitivity.bottomLeftCorner(Tuning, Chart),
    Eigen::MatrixXd(Sensitivity.bottomRightCorner(Tuning, Tuning).selfadjointView<Eigen::Lower>());
  Eigen::MatrixXd smooths(Tuning, Chart + Tuning);
  smooths << Smooth.bottomLeftCorner(Tuning, Chart),
    Eigen::MatrixXd(Smooth.bottomRightCorner(Tuning, Tuning).selfadjointView<Eigen::Lower>());
  Eigen::VectorXd linear(Chart + Tuning);
  linear << Eigen::VectorXd::Constant(Chart, perChannel * kernel[Kernel::Linear]),
    Eigen::VectorXd::Constant(Tuning, perChannel * targetLinear);
  Eigen::VectorXd smooth(Chart + Tuning);
  smooth << Eigen::VectorXd::Constant(Chart, perChannel * inverseSquare * kernel[Kernel::Smooth]),
    Eigen::VectorXd::Constant(Tuning, perChannel * inverseSquare * targetSmooth);
  const Eigen::MatrixXd smoothPulls = pulls.cwiseProduct(smooths) * smooth.asDiagonal();
  Eigen::MatrixXd byFeatures = X * (pulls * linear.asDiagonal() + smoothPulls).transpose();
  byFeatures -= X.rightCols(Tuning) * smoothPulls.rowwise().sum().asDiagonal();
  chainThroughFeatures(features, byFeatures, gradient);

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
