#include "Kernels/Gap/Diagnosis/GapRegression.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Numerics/LeastSquares.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double Ridge = 1e-4; // of the square of a column
constexpr std::size_t Channel = 1;
constexpr std::size_t ChannelAndLevel = 3; // their bits

using Coefficients = std::vector<Eigen::VectorXd>; // of each channel

Eigen::MatrixXd ridged(Eigen::MatrixXd matrix)
{
  matrix.diagonal() *= 1.0 + Ridge;
  matrix.diagonal().array() += 1e-12;
  return matrix;
}

std::vector<int> without(std::vector<int> some, const std::vector<int>& others)
{
  some.erase(
    std::remove_if(some.begin(), some.end(),
      [&others](int one) { return std::find(others.begin(), others.end(), one) != others.end(); }),
    some.end());
  return some;
}

// The coefficients of a channel meet only each other and the common ones: they are eliminated channel by channel.
Coefficients regress(
  const ChannelNormals& normal, const std::vector<int>& common, const std::vector<int>& own)
{
  const Eigen::Index gap = normal.front().cols() - 1;
  const Eigen::Index C = common.size();
  std::vector<int> others = common;
  others.push_back(static_cast<int>(gap));
  Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(C + 1, C + 1);
  for (const Eigen::MatrixXd& N : normal)
  {
    reduced += N(others, others);
  }
  reduced.topLeftCorner(C, C) = ridged(reduced.topLeftCorner(C, C));
  // The channel's coefficients that go with the common ones, and those of the gap.
  std::vector<Eigen::MatrixXd> byOthers;
  for (const Eigen::MatrixXd& N : normal)
  {
    const Eigen::MatrixXd across = N(own, others);
    byOthers.emplace_back(ridged(N(own, own)).ldlt().solve(across));
    reduced -= across.transpose() * byOthers.back();
  }
  const Eigen::VectorXd shared = reduced.topLeftCorner(C, C).ldlt().solve(reduced.col(C).head(C));
  Coefficients coefficients;
  for (const Eigen::MatrixXd& mine : byOthers)
  {
    coefficients.emplace_back(Eigen::VectorXd::Zero(gap));
    coefficients.back()(own) = mine.col(C) - mine.leftCols(C) * shared;
    coefficients.back()(common) = shared;
  }
  return coefficients;
}

// The same with gains whose mean over the channels is taken off.
Coefficients regressWithoutCommonGain(
  ChannelNormals normal, const std::vector<int>& common, const std::vector<int>& own, int gain)
{
  const Coefficients free = regress(normal, common, own);
  double mean = 0.0;
  for (const Eigen::VectorXd& one : free)
  {
    mean += one[gain] / static_cast<double>(free.size());
  }
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    const Eigen::VectorXd along = normal[k].col(gain);
    normal[k].rightCols(1) -= (free[k][gain] - mean) * along;
  }
  Coefficients coefficients = regress(normal, common, without(own, { gain }));
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    coefficients[k][gain] = free[k][gain] - mean;
  }
  return coefficients;
}

// Columns of the axes whose bits are set.
struct Columns
{
  std::vector<int> common, own;
};

Columns columnsOf(const std::vector<AxisBasis>& axes, std::size_t subset)
{
  Columns columns;
  for (std::size_t a = 0; a < axes.size(); ++a)
  {
    if ((subset >> a & 1U) != 0)
    {
      columns.common.insert(columns.common.end(), axes[a].common.begin(), axes[a].common.end());
      columns.own.insert(columns.own.end(), axes[a].own.begin(), axes[a].own.end());
    }
  }
  // What every channel has of its own needs no common one.
  columns.common = without(std::move(columns.common), columns.own);
  return columns;
}

// Takes from the columns of cells what those of channel and level can do in the training data of a channel.
void leaveContrasts(const std::vector<AxisBasis>& axes, std::vector<AxisSplit>& splits)
{
  const Columns base = columnsOf(axes, ChannelAndLevel);
  std::vector<int> others = base.own;
  others.insert(others.end(), base.common.begin(), base.common.end());
  std::vector<int> cells;
  for (const AxisBasis& axis : axes)
  {
    cells.insert(cells.end(), axis.cells.begin(), axis.cells.end());
  }
  for (AxisSplit& split : splits)
  {
    for (std::size_t k = 0; k < split.training.size(); ++k)
    {
      const Eigen::MatrixXd& N = split.training[k];
      Eigen::MatrixXd mix = Eigen::MatrixXd::Identity(N.rows(), N.cols());
      mix(others, cells) = -ridged(N(others, others)).ldlt().solve(N(others, cells).eval());
      split.training[k] = mix.transpose() * split.training[k] * mix;
      split.test[k] = mix.transpose() * split.test[k] * mix;
    }
  }
}

// What coefficients leave of the test data.
double leftOf(const ChannelNormals& test, const Coefficients& coefficients)
{
  double left = 0.0;
  for (std::size_t k = 0; k < test.size(); ++k)
  {
    left += energyLeft(test[k], coefficients[k]);
  }
  return left;
}

Eigen::VectorXd ridge(const Eigen::MatrixXd& products, const Eigen::VectorXd& scale, double penalty)
{
  const Eigen::Index count = scale.size();
  Eigen::MatrixXd normal = products.topLeftCorner(count, count);
  normal.diagonal() += penalty * scale + Eigen::VectorXd::Constant(count, 1e-12);
  return normal.ldlt().solve(products.col(count).head(count));
}
}

PredictedEnergies predictedEnergies(
  std::vector<AxisBasis> axes, std::vector<AxisSplit> splits, int gain)
{
  const auto splitsOf = [&](std::size_t subset) -> const std::vector<AxisSplit>&
  {
    for (std::size_t a = 0; a < axes.size(); ++a)
    {
      if ((subset >> a & 1U) != 0 && !axes[a].behind.empty())
      {
        return axes[a].behind;
      }
    }
    return splits;
  };
  const auto coefficients = [&](const AxisSplit& split, std::size_t subset)
  {
    const Columns columns = columnsOf(axes, subset);
    return (subset & ChannelAndLevel) == Channel
      ? regressWithoutCommonGain(split.training, columns.common, columns.own, gain)
      : regress(split.training, columns.common, columns.own);
  };
  PredictedEnergies energies;
  const auto predicted = [&](std::size_t subset)
  {
    double left = 0.0;
    for (const AxisSplit& split : splitsOf(subset))
    {
      left += leftOf(split.test, coefficients(split, subset));
    }
    return energies.before - left;
  };
  for (const AxisSplit& split : splits)
  {
    for (const Eigen::MatrixXd& N : split.test)
    {
      energies.before += N(N.rows() - 1, N.cols() - 1);
    }
  }
  const std::size_t subsets = std::size_t(1) << axes.size();
  double left = 0.0;
  for (const AxisSplit& split : splitsOf(subsets - 1))
  {
    energies.coefficients.push_back(coefficients(split, subsets - 1));
    left += leftOf(split.test, energies.coefficients.back());
  }
  energies.all = energies.before - left;
  if (predicted(ChannelAndLevel) >= (1.0 - Decision::SmallPart) * energies.all)
  {
    leaveContrasts(axes, splits);
    for (AxisBasis& axis : axes)
    {
      leaveContrasts(axes, axis.behind);
    }
  }
  std::vector<double> value(subsets, 0.0);
  for (std::size_t subset = 1; subset < subsets; ++subset)
  {
    value[subset] = predicted(subset);
  }
  energies.axis = shapleyValues(value, axes.size());
  return energies;
}

CameraEffect remainderEffect(
  const Eigen::MatrixXd& coefficients, const std::vector<std::string>& channels)
{
  const EffectDefinition& definition = effectWith(EffectTrait::Remainder);
  CameraEffect effect = neutralEffect(definition.name, channels);
  for (Eigen::Index n = 0; n < coefficients.cols(); ++n)
  {
    const EffectParameter& parameter = definition.forms.front().parameters[n];
    for (Eigen::Index k = 0; k < coefficients.rows(); ++k)
    {
      effect.parameters[n * coefficients.rows() + k] =
        std::clamp(coefficients(k, n), parameter.lower, parameter.upper);
    }
  }
  return effect;
}

CameraEffect regularPart(
  const std::vector<ChannelNormals>& products, const std::vector<std::string>& channels)
{
  const Eigen::Index K = channels.size();
  const Eigen::Index count = products.front().front().cols() - 1;
  Eigen::MatrixXd best = Eigen::MatrixXd::Zero(K, count);
  double least = 0.0; // with nothing
  for (double penalty = 1e-4; penalty < 200.0; penalty *= std::sqrt(10.0))
  {
    Eigen::MatrixXd coefficients(K, count);
    double left = 0.0;
    for (Eigen::Index k = 0; k < K; ++k)
    {
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(count + 1, count + 1);
      for (const ChannelNormals& fold : products)
      {
        all += fold[k];
      }
      const Eigen::VectorXd scale = all.diagonal().head(count);
      for (const ChannelNormals& fold : products)
      {
        left += energyLeft(fold[k], ridge(all - fold[k], scale, penalty)) - fold[k](count, count);
      }
      coefficients.row(k) = ridge(all, scale, penalty).transpose();
    }
    if (left < least)
    {
      least = left;
      best = std::move(coefficients);
    }
  }
  return remainderEffect(best, channels);
}

} // namespace msi
