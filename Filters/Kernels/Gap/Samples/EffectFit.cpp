#include "Kernels/Gap/Samples/EffectFit.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Samples/GapNoise.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace msi
{

namespace
{
constexpr int InnerFolds = 5;
constexpr double Remaining = 10.0; // times the last gain: what further iterations may gain at most

using Flat = Eigen::Map<const Eigen::ArrayXd>;

Flat flat(const Eigen::MatrixXd& matrix)
{
  return { matrix.data(), matrix.size() };
}

// sqrt of the Huber weights for whitened residuals; 1 where there is no weight.
Eigen::ArrayXd huber(const Eigen::ArrayXd& whitened, const Eigen::ArrayXd& weight)
{
  std::vector<double> size;
  size.reserve(static_cast<std::size_t>(whitened.size()));
  for (Eigen::Index i = 0; i < whitened.size(); ++i)
  {
    if (weight[i] > 0.0)
    {
      size.push_back(whitened[i]);
    }
  }
  if (size.empty())
  {
    return Eigen::ArrayXd::Ones(whitened.size());
  }
  const double cut = Decision::OutlierDeviations * std::fmax(robustDeviation(std::move(size)), 1.0);
  return (whitened.abs() > cut).select((cut / whitened.abs().cwiseMax(1e-300)).sqrt(), 1.0);
}

Eigen::MatrixXd inverseOf(const Eigen::MatrixXd& symmetric)
{
  return symmetric.ldlt().solve(Eigen::MatrixXd::Identity(symmetric.rows(), symmetric.cols()));
}

double huberCost(const Eigen::ArrayXd& whitened, const Eigen::ArrayXd& root)
{
  return (whitened * root).square().sum();
}
}

Eigen::MatrixXd normalMatrix(const Eigen::MatrixXd& jacobian,
  const Eigen::Ref<const Eigen::ArrayXXd>& weight, const std::vector<FreeParameter>& free,
  Eigen::Index reach, const SampleList& samples)
{
  Eigen::MatrixXd normal = Eigen::MatrixXd::Zero(jacobian.cols(), jacobian.cols());
  for (Eigen::Index k = 0; k < weight.rows(); ++k)
  {
    SampleList rows;
    for (const Eigen::Index i : samples)
    {
      rows.push_back(k + weight.rows() * i);
    }
    std::vector<Eigen::Index> active;
    for (std::size_t p = 0; p < free.size(); ++p)
    {
      if (free[p].channel < 0 || std::abs(free[p].channel - k) <= reach)
      {
        active.push_back(static_cast<Eigen::Index>(p));
      }
    }
    const Eigen::VectorXd root = weight.row(k)(samples).sqrt();
    const Eigen::MatrixXd columns = root.asDiagonal() * jacobian(rows, active);
    normal(active, active) += columns.transpose() * columns;
  }
  return normal;
}

std::vector<FreeNumber> EffectFit::numbers() const
{
  std::vector<FreeNumber> numbers;
  for (const FreeParameter& parameter : free)
  {
    const bool perChannel = parameter.channel >= 0;
    const auto hasCommonForm = [this, &parameter]
    {
      const auto& plain = set.choices[parameter.effect].effect->forms.front().parameters;
      return std::none_of(
        plain.begin(), plain.end(), [](const EffectParameter& one) { return one.perChannel; });
    };
    const auto at = static_cast<Eigen::Index>(numbers.size());
    numbers.push_back({ parameter.group, perChannel, perChannel && hasCommonForm(),
      set.value(parameter) - parameter.neutral, parameter.scale,
      at < variance.size() ? variance[at] : 0.0 });
  }
  return numbers;
}

EffectFitter::EffectFitter(const GapData& data, SampleList training, std::uint64_t seed)
  : Data(data)
  , Training(std::move(training))
  , Weight(Eigen::MatrixXd::Zero(data.channels(), data.samples()))
{
  Weight(Eigen::all, Training) = data.weight(Eigen::all, Training);
  const int folds = std::min(InnerFolds, static_cast<int>(Training.size()));
  Fold.resize(folds >= 2 ? static_cast<std::size_t>(folds) : 0);
  const std::vector<int> fold = foldsOf(data, Training, std::max(folds, 2), seed);
  for (std::size_t t = 0; t < Training.size() && !Fold.empty(); ++t)
  {
    const int number = fold[static_cast<std::size_t>(Training[t])];
    Fold[static_cast<std::size_t>(number)].push_back(Training[t]);
  }
  Elements = static_cast<double>((Weight.array() > 0.0).count());
  NoiseEnergy = (Weight.array() * Data.variance.array()).sum();
}

EffectFit EffectFitter::nominal() const
{
  EffectFit fit;
  fit.predicted = Data.simulated;
  fit.jacobian.resize(Data.observed.size(), 0);
  fit.information.resize(0, 0);
  fit.prior.resize(0, 0);
  crossValidate(fit);
  return fit;
}

EffectFit EffectFitter::fit(EffectSet start, const FitEffort& effort) const
{
  if (start.size() == 0)
  {
    return nominal();
  }
  EffectFit fit;
  fit.set = std::move(start);
  fit.free = fit.set.freeParameters(Data.camera);
  const auto count = static_cast<Eigen::Index>(fit.free.size());
  Eigen::ArrayXd lower(count), upper(count), neutral(count);
  fit.prior = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index p = 0; p < count; ++p)
  {
    const FreeParameter& parameter = fit.free[static_cast<std::size_t>(p)];
    fit.prior(p, p) = parameter.precision();
    lower[p] = parameter.lower;
    upper[p] = parameter.upper;
    neutral[p] = parameter.neutral;
  }
  // Beside others numbers of single channels keep to what they do not have in common.
  const bool learns = fit.set.size() > 1 &&
    std::any_of(fit.free.begin(), fit.free.end(),
      [](const FreeParameter& parameter) { return parameter.channel >= 0; });
  const Eigen::ArrayXd rootWeight = flat(Weight).sqrt();
  const auto whiten = [&](const Eigen::MatrixXd& predicted) -> Eigen::ArrayXd
  { return (rootWeight > 0.0).select(rootWeight * (flat(Data.observed) - flat(predicted)), 0.0); };
  std::optional<StagedResponse> here = stagedResponse(Data.camera, Data.scene, fit.set);
  if (!here)
  {
    fit.predicted = noResponse(Data.camera, Data.scene);
    fit.jacobian = Eigen::MatrixXd::Zero(Data.observed.size(), count);
    fit.information = fit.prior;
    crossValidate(fit);
    return fit;
  }
  Eigen::ArrayXd residual = whiten(here->response());
  double damping = 1e-9;
  const auto penalty = [&](const Eigen::VectorXd& values)
  {
    const Eigen::VectorXd off = values - neutral.matrix();
    return off.dot(fit.prior * off);
  };
  bool fresh = false;
  for (fit.iterations = 0; fit.iterations < effort.iterations; ++fit.iterations)
  {
    fit.jacobian = jacobian(*here, fit.set, fit.free);
    fresh = true;
    const Eigen::ArrayXd root = huber(residual, rootWeight);
    const Eigen::VectorXd values = valuesOf(fit.set, fit.free);
    const Eigen::ArrayXd rootTrust = rootWeight * root;
    const Eigen::Map<const Eigen::ArrayXXd> trust(
      rootTrust.data(), Data.channels(), Data.samples());
    Eigen::MatrixXd normal =
      normalMatrix(fit.jacobian, trust.square(), fit.free, fit.set.reach(), Training);
    Eigen::VectorXd gradient =
      fit.jacobian.transpose() * (rootWeight * residual * root.square()).matrix();
    if (learns)
    {
      fit.variance = inverseOf(normal + fit.prior).diagonal();
      fit.prior = fitPrecision(fit.numbers());
    }
    normal += fit.prior;
    gradient -= fit.prior * (values.array() - neutral).matrix();
    // A parameter at its bound that wants further out stays.
    for (Eigen::Index p = 0; p < count; ++p)
    {
      if ((values[p] >= upper[p] && gradient[p] > 0.0) ||
        (values[p] <= lower[p] && gradient[p] < 0.0))
      {
        normal.row(p).setZero();
        normal.col(p).setZero();
        normal(p, p) = 1.0;
        gradient[p] = 0.0;
      }
    }
    const double before = huberCost(residual, root) + penalty(values);
    bool better = false;
    double after = before;
    for (int attempt = 0; attempt < 6 && !better; ++attempt)
    {
      Eigen::MatrixXd damped = normal;
      damped.diagonal() *= 1.0 + damping;
      const Eigen::VectorXd step = damped.ldlt().solve(gradient);
      const Eigen::VectorXd trial =
        (values + step).array().cwiseMax(lower).cwiseMin(upper).matrix();
      EffectSet moved = fit.set;
      setValues(moved, fit.free, trial);
      std::optional<StagedResponse> there = stagedResponse(*here, moved);
      if (there)
      {
        Eigen::ArrayXd trialResidual = whiten(there->response());
        after = huberCost(trialResidual, root) + penalty(trial);
        better = after < before;
        if (better)
        {
          fit.set = std::move(moved);
          here = std::move(there);
          residual = std::move(trialResidual);
          fresh = false;
        }
      }
      damping = better ? std::fmax(damping * 0.1, 1e-9) : std::fmax(damping * 30.0, 1e-3);
    }
    if (!better || before - after < effort.converged * before ||
      after - Remaining * (before - after) > effort.unwanted)
    {
      break;
    }
  }
  if (!fresh)
  {
    fit.jacobian = jacobian(*here, fit.set, fit.free);
  }
  fit.predicted = here->response();
  fit.information = normalMatrix(fit.jacobian, Weight.array(), fit.free, fit.set.reach(), Training);
  fit.information += fit.prior;
  fit.variance = inverseOf(fit.information).diagonal();
  crossValidate(fit);
  return fit;
}

void EffectFitter::crossValidate(EffectFit& fit) const
{
  const Eigen::Index channels = Data.channels();
  const Eigen::Index samples = Data.samples();
  fit.heldOut = (Weight.array() > 0.0).select(Data.observed - fit.predicted, 0.0);
  const Eigen::Index count = fit.jacobian.cols();
  if (count > 0 && !Fold.empty())
  {
    std::vector<Eigen::MatrixXd> normal;
    std::vector<Eigen::VectorXd> gradient;
    for (const SampleList& members : Fold)
    {
      normal.push_back(
        normalMatrix(fit.jacobian, Weight.array(), fit.free, fit.set.reach(), members));
      Eigen::VectorXd sum = Eigen::VectorXd::Zero(count);
      for (const Eigen::Index j : members)
      {
        sum += fit.jacobian.middleRows(j * channels, channels).transpose() *
          (Weight.col(j).array() * fit.heldOut.col(j).array()).matrix();
      }
      gradient.push_back(std::move(sum));
    }
    for (std::size_t f = 0; f < Fold.size(); ++f)
    {
      Eigen::VectorXd step = (fit.information - normal[f]).ldlt().solve(gradient[f]);
      for (Eigen::Index p = 0; p < count; ++p)
      {
        // The estimate without the fold is minus this step away, and keeps to the bounds.
        const FreeParameter& parameter = fit.free[static_cast<std::size_t>(p)];
        const double value = fit.set.value(parameter);
        step[p] = std::fmin(std::fmax(step[p], value - parameter.upper), value - parameter.lower);
      }
      for (const Eigen::Index j : Fold[f])
      {
        fit.heldOut.col(j) += fit.jacobian.middleRows(j * channels, channels) * step;
      }
    }
    fit.heldOut = (Weight.array() > 0.0).select(fit.heldOut, 0.0);
  }
  fit.energy = (Weight.array() * fit.heldOut.array().square()).sum();
  // Between the channels of one sample errors go together; the sum over a sample then scatters more.
  double together = 0.0;
  for (Eigen::Index j = 0; j < samples; ++j)
  {
    const double sum = (Weight.col(j).array().sqrt() * fit.heldOut.col(j).array()).sum();
    together += sum * sum;
  }
  const double mean = fit.energy / std::fmax(Elements, 1.0);
  const double effect = fit.energy > 0.0 ? together / fit.energy : 1.0;
  fit.dispersion = mean * std::fmin(std::fmax(effect, 1.0), static_cast<double>(channels));
}

Eigen::MatrixXd EffectFitter::covariance(const EffectFit& fit) const
{
  const Eigen::Index channels = Data.channels();
  const Eigen::Index count = fit.jacobian.cols();
  Eigen::MatrixXd meat = Eigen::MatrixXd::Zero(count, count);
  for (const Eigen::Index j : Training)
  {
    const Eigen::VectorXd score = fit.jacobian.middleRows(j * channels, channels).transpose() *
      (Weight.col(j).array() * fit.heldOut.col(j).array()).matrix();
    meat += score * score.transpose();
  }
  const auto samples = static_cast<double>(Training.size());
  const Eigen::MatrixXd inverse = inverseOf(fit.information);
  return samples / std::fmax(samples - 1.0, 1.0) * inverse * meat * inverse;
}

namespace
{
Eigen::MatrixXd leftBy(const GapData& data, const Eigen::MatrixXd& predicted)
{
  return (data.count.array() > 0.0).select(data.observed - predicted, 0.0);
}
}

Eigen::MatrixXd leftOfHeldOut(const GapData& data, const EffectFit& fit, const SampleList& training)
{
  Eigen::MatrixXd left = leftBy(data, fit.predicted);
  const double none = std::numeric_limits<double>::infinity();
  for (std::size_t e = 0; e < fit.set.size(); ++e)
  {
    const auto step = fit.set.placeOf(e);
    if (!step)
    {
      continue;
    }
    const Eigen::VectorXd& time = data.scene.time();
    const double place = fit.set.effects[e].parameters[step->index];
    double before = -none;
    double behind = none;
    for (const Eigen::Index i : training)
    {
      before = time[i] <= place ? std::fmax(before, time[i]) : before;
      behind = time[i] > place ? std::fmin(behind, time[i]) : behind;
    }
    const double half = 0.5 * fit.set.effects[e].parameters[step->index + 1];
    for (const double end : { before - half, behind + half })
    {
      EffectSet moved = fit.set;
      moved.effects[e].parameters[step->index] = std::clamp(end, 0.0, 1.0);
      const Eigen::MatrixXd other = leftBy(data, respond(data.camera, data.scene, moved));
      for (Eigen::Index i = 0; i < data.samples(); ++i)
      {
        if (time[i] > before && time[i] < behind &&
          other.col(i).squaredNorm() < left.col(i).squaredNorm())
        {
          left.col(i) = other.col(i);
        }
      }
    }
  }
  return left;
}

} // namespace msi
