#include "Kernels/Estimation/Transfer/TransferExpert.h"

#include "Kernels/Estimation/SampleDraw.h"
#include "Kernels/Estimation/Transfer/TransferObjective.h"
#include "Kernels/Numerics/Lbfgs.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
using Kernel = TransferKernel;

constexpr Eigen::Index LearningSamples = 300;
constexpr Eigen::Index LearningTuningSamples = 150;
constexpr Eigen::Index LargestPointCount = 256;
constexpr double UnexplainedShareOfNoise = 0.01;
// Refits tell a ratio of errors alone: a decrease ten times as large as that of the fit changes it by less than 1 %.
constexpr Eigen::Index RefitFolds = 8;
constexpr double RefitDecrease = 1e-5;

// Up to 'count' columns, each the farthest from those before it, starting at the one nearest to the
// mean; all columns in order where there are no more.
std::vector<Eigen::Index> spreadColumns(const Eigen::MatrixXd& columns, Eigen::Index count)
{
  std::vector<Eigen::Index> chosen;
  if (columns.cols() <= count)
  {
    for (Eigen::Index i = 0; i < columns.cols(); ++i)
    {
      chosen.push_back(i);
    }
    return chosen;
  }
  const Eigen::VectorXd mean = columns.rowwise().mean();
  Eigen::Index next = 0;
  (columns.colwise() - mean).colwise().squaredNorm().minCoeff(&next);
  Eigen::RowVectorXd distance =
    Eigen::RowVectorXd::Constant(columns.cols(), std::numeric_limits<double>::infinity());
  while (static_cast<Eigen::Index>(chosen.size()) < count)
  {
    chosen.push_back(next);
    distance = distance.cwiseMin((columns.colwise() - columns.col(next)).colwise().squaredNorm());
    distance.maxCoeff(&next);
  }
  std::sort(chosen.begin(), chosen.end());
  return chosen;
}

// K ~ factor factor'; the rows of the pivots form a lower triangle.
struct PivotedFactor
{
  Eigen::MatrixXd factor; // n x m
  std::vector<Eigen::Index> pivots;
  Eigen::VectorXd unexplained; // n, of the diagonal
};

PivotedFactor pivotedCholesky(
  const TransferKernel& kernel, const Eigen::MatrixXd& x, Eigen::Index chart, double tolerance)
{
  const Eigen::Index samples = x.cols();
  PivotedFactor result;
  result.factor.resize(samples, std::min(samples, LargestPointCount));
  result.unexplained.resize(samples);
  for (Eigen::Index i = 0; i < samples; ++i)
  {
    const Eigen::Index ofChart = i < chart ? 1 : 0;
    result.unexplained[i] = covariance(kernel, x.col(i), ofChart, x.col(i), ofChart)(0, 0);
  }
  Eigen::Index rank = 0;
  for (; rank < result.factor.cols(); ++rank)
  {
    Eigen::Index pivot = 0;
    const double largest = result.unexplained.maxCoeff(&pivot);
    if (largest <= tolerance && rank > 0) // one point at least: no product has an empty side
    {
      break;
    }
    const Eigen::MatrixXd column =
      covariance(kernel, x, chart, x.col(pivot), pivot < chart ? 1 : 0);
    auto next = result.factor.col(rank);
    next = column - result.factor.leftCols(rank) * result.factor.row(pivot).head(rank).transpose();
    next /= std::sqrt(largest);
    next[pivot] = std::sqrt(largest);
    for (const Eigen::Index earlier : result.pivots)
    {
      next[earlier] = 0.0;
    }
    result.unexplained = (result.unexplained - next.cwiseAbs2()).cwiseMax(0.0);
    result.unexplained[pivot] = 0.0;
    result.pivots.push_back(pivot);
  }
  result.factor.conservativeResize(Eigen::NoChange, rank);
  return result;
}

Eigen::MatrixXd inSpace(TransferSpace space, const Eigen::MatrixXd& values)
{
  return values.unaryExpr([space](double value) { return toSpace(space, value); });
}

// k(target, point) = constant + linear x.p/K + smooth exp(...): the weights depend on the point's set.
Eigen::MatrixXd pointWeights(
  const TransferKernel& kernel, const std::vector<Eigen::Index>& pivots, Eigen::Index chart)
{
  Eigen::MatrixXd weights(3, static_cast<Eigen::Index>(pivots.size()));
  for (Eigen::Index j = 0; j < weights.cols(); ++j)
  {
    weights.col(j) << kernel[Kernel::Constant], kernel[Kernel::Linear], kernel[Kernel::Smooth];
    if (pivots[static_cast<std::size_t>(j)] >= chart)
    {
      weights.col(j) += Eigen::Vector3d(
        kernel[Kernel::TargetConstant], kernel[Kernel::TargetLinear], kernel[Kernel::TargetSmooth]);
    }
  }
  return weights;
}

// One row a sample.
Eigen::MatrixXd centeredOutputs(
  TransferSpace space, const Eigen::MatrixXd& reflectances, const Eigen::VectorXd& center)
{
  return (inSpace(space, reflectances).colwise() - center).transpose();
}

struct Learned
{
  TransferKernel kernel;
  TransferFeatures features;
  LbfgsResult found;
};

// From 'start', or from the prior's center where that is empty.
Learned learn(TransferSpace space, const SampleSet& calibration, const SampleSet& tuning,
  const Eigen::VectorXd& center, const Eigen::VectorXd& start, const LbfgsOptions& options)
{
  const TransferFeatures features = featuresOf(space, calibration.response);
  const auto tuningColumns =
    spreadColumns(features.ofChart(tuning.response), LearningTuningSamples);
  const auto chartColumns = spreadColumns(features.ofChart(calibration.response),
    LearningSamples - static_cast<Eigen::Index>(tuningColumns.size()));
  const SampleSet chart = calibration.subset(chartColumns);
  const SampleSet target = tuning.subset(tuningColumns);
  TransferObjective objective(features, chart.response, target.response,
    centeredOutputs(space, joined(chart, target).reflectance, center));
  LbfgsResult found = minimizeLbfgs([&](const Eigen::VectorXd& at, Eigen::VectorXd& gradient)
    { return objective(at, gradient); },
    start.size() > 0 ? start : objective.start(), options);
  return { objective.kernelAt(found.at), objective.featuresAt(found.at), std::move(found) };
}
}

TransferExpertFit transferPosterior(const TransferKernel& kernel, const TransferFeatures& features,
  const SampleSet& calibration, const SampleSet& tuning, const Eigen::VectorXd& center)
{
  const Eigen::Index chart = calibration.size();
  const Eigen::Index samples = chart + tuning.size();
  const Eigen::MatrixXd outputs =
    centeredOutputs(features.space, joined(calibration, tuning).reflectance, center);
  Eigen::MatrixXd x(calibration.channels(), samples);
  x << features.ofChart(calibration.response), features.ofTarget(tuning.response);
  Eigen::VectorXd noise(samples);
  noise << Eigen::VectorXd::Constant(chart, kernel[Kernel::ChartNoise]),
    Eigen::VectorXd::Constant(tuning.size(), kernel[Kernel::TargetNoise]);
  const PivotedFactor pivoted =
    pivotedCholesky(kernel, x, chart, UnexplainedShareOfNoise * noise.minCoeff());
  noise += pivoted.unexplained;

  // With F the factor and N the noise: B = I + F' N^-1 F; the posterior is F B^-1 F' N^-1 Y.
  const Eigen::MatrixXd& factor = pivoted.factor;
  const Eigen::Index points = factor.cols();
  const Eigen::MatrixXd precise = noise.cwiseInverse().asDiagonal() * factor;
  const Eigen::LLT<Eigen::MatrixXd> b(
    Eigen::MatrixXd::Identity(points, points) + factor.transpose() * precise);
  const Eigen::MatrixXd white = b.solve(precise.transpose() * outputs);
  const Eigen::MatrixXd triangle = factor(pivoted.pivots, Eigen::all);
  const auto lower = triangle.triangularView<Eigen::Lower>();

  TransferExpertFit fit;
  TransferExpert& expert = fit.expert;
  expert.features = features;
  expert.points = x(Eigen::all, pivoted.pivots);
  expert.weights = pointWeights(kernel, pivoted.pivots, chart);
  expert.length = kernel[Kernel::Length];
  expert.priorConstant = kernel[Kernel::Constant] + kernel[Kernel::TargetConstant] +
    kernel[Kernel::Smooth] + kernel[Kernel::TargetSmooth] + kernel[Kernel::TargetNoise];
  expert.priorLinear = kernel[Kernel::Linear] + kernel[Kernel::TargetLinear];
  expert.coefficients = lower.transpose().solve(white);
  expert.center = center;
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(points, points);
  const Eigen::MatrixXd inverse = lower.solve(identity);
  const Eigen::MatrixXd left = inverse.transpose() * (identity - b.solve(identity));
  expert.reduction = left * inverse;
  expert.reduction = 0.5 * (expert.reduction + expert.reduction.transpose()).eval();

  const Eigen::VectorXd leverage =
    (precise.array() * b.solve(factor.transpose()).transpose().array()).rowwise().sum();
  const Eigen::VectorXd remaining = (1.0 - leverage.array()).max(1e-9);
  const Eigen::MatrixXd residual =
    remaining.cwiseInverse().asDiagonal() * (outputs - factor * white);
  const TransferSpace space = features.space;
  fit.leftOutEstimate = (((outputs - residual).transpose()).colwise() + center)
                          .unaryExpr([space](double value) { return fromSpace(space, value); });
  fit.leftOutVariance = noise.cwiseQuotient(remaining);
  return fit;
}

TransferExpertFit fitTransferExpert(
  TransferSpace space, const SampleSet& calibration, const SampleSet& tuning, bool refits)
{
  const Eigen::VectorXd center =
    inSpace(space, joined(calibration, tuning).reflectance).rowwise().mean();
  const Learned learned = learn(space, calibration, tuning, center, {}, {});
  TransferExpertFit fit =
    transferPosterior(learned.kernel, learned.features, calibration, tuning, center);
  fit.iterations = learned.found.iterations;
  fit.converged = learned.found.converged;

  const Eigen::Index count = tuning.size();
  fit.refittedEstimate = fit.leftOutEstimate.rightCols(count);
  LbfgsOptions refitOptions;
  refitOptions.relativeDecrease = RefitDecrease;
  for (const auto& left : leftOutFolds(refits ? count : 0, RefitFolds))
  {
    const Learned without = learn(space, calibration, tuning.subset(remainingSamples(count, left)),
      center, learned.found.at, refitOptions);
    const Eigen::MatrixXd estimate =
      transferPosterior(without.kernel, without.features, calibration, tuning, center)
        .leftOutEstimate.rightCols(count);
    fit.refittedEstimate(Eigen::all, left) = estimate(Eigen::all, left);
  }
  return fit;
}

} // namespace msi
