#include "Kernels/Gap/Samples/EffectFit.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/SetSearch.h"
#include "Kernels/Gap/Samples/GapNoise.h"

#include <algorithm>
#include <cmath>
#include <cstdlib>

namespace msi
{

namespace
{
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
  size.reserve(whitened.size());
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

double huberCost(const Eigen::ArrayXd& whitened, const Eigen::ArrayXd& root)
{
  return (whitened * root).square().sum();
}
}

std::vector<NormalEquations> normalEquations(const std::vector<Derivative>& derivatives,
  const Eigen::Ref<const Eigen::ArrayXXd>& root, const Eigen::Ref<const Eigen::ArrayXXd>& residual,
  const std::vector<SampleList>& folds)
{
  SampleList samples;
  for (const SampleList& fold : folds)
  {
    samples.insert(samples.end(), fold.begin(), fold.end());
  }
  std::vector<std::vector<Eigen::Index>> acting(root.rows());
  for (std::size_t p = 0; p < derivatives.size(); ++p)
  {
    const Eigen::Index end = derivatives[p].first + derivatives[p].changes.rows();
    for (Eigen::Index k = derivatives[p].first; k < end; ++k)
    {
      acting[k].push_back(p);
    }
  }
  std::vector<NormalEquationsSum> sums(folds.size(), NormalEquationsSum(derivatives.size()));
  for (Eigen::Index k = 0; k < root.rows(); ++k)
  {
    const std::vector<Eigen::Index>& parameters = acting[k];
    const Eigen::Index count = parameters.size();
    Eigen::ArrayXXd columns(samples.size(), count + 1);
    columns.col(count) = residual.row(k)(samples);
    const Eigen::ArrayXd weight = root.row(k)(samples);
    for (Eigen::Index c = 0; c < count; ++c)
    {
      const Derivative& one = derivatives[parameters[c]];
      columns.col(c) = weight * one.changes.row(k - one.first)(samples).transpose().array();
    }
    Eigen::Index first = 0;
    for (std::size_t f = 0; f < folds.size(); ++f)
    {
      const Eigen::Index members = folds[f].size();
      const auto rows = columns.middleRows(first, members).matrix();
      const Eigen::MatrixXd products = rows.transpose().lazyProduct(rows);
      sums[f].add(
        parameters, products.topLeftCorner(count, count), products.col(count).head(count));
      first += members;
    }
  }
  std::vector<NormalEquations> equations;
  equations.reserve(sums.size());
  for (const NormalEquationsSum& sum : sums)
  {
    equations.push_back(sum.sum());
  }
  return equations;
}

EffectFitter::EffectFitter(const GapData& data, SampleList training, std::uint64_t seed)
  : Data(data)
  , Training(std::move(training))
  , Weight(Eigen::MatrixXd::Zero(data.channels(), data.samples()))
  , Fold(foldsOf(data, Training, InnerFolds, seed))
{
  Weight(Eigen::all, Training) = data.weight(Eigen::all, Training);
  Elements = static_cast<double>((Weight.array() > 0.0).count());
  NoiseEnergy = (Weight.array() * Data.variance.array()).sum();
}

Eigen::ArrayXd EffectFitter::whitened(const Eigen::MatrixXd& predicted) const
{
  const auto weight = flat(Weight);
  return (weight > 0.0).select(weight.sqrt() * (flat(Data.observed) - flat(predicted)), 0.0);
}

void EffectFitter::linearise(
  EffectFit& fit, const StagedResponse& here, const Eigen::ArrayXd& residual) const
{
  fit.root = huber(residual, flat(Weight));
  fit.free = fit.set.freeParameters(Data.camera);
  fit.derivatives = derivatives(here, fit.set, fit.free);
  solve(fit, residual);
}

void EffectFitter::solve(EffectFit& fit, const Eigen::ArrayXd& residual) const
{
  const Eigen::ArrayXXd trust =
    Weight.array().sqrt() * fit.root.reshaped(Data.channels(), Data.samples());
  const Eigen::ArrayXXd left = (residual * fit.root).reshaped(Data.channels(), Data.samples());
  // What is left beyond noise counts as in the criterion.
  const double numbers =
    independentNumbers(Decision::DiscrepancyNumbers, Training.size(), Data.channels());
  const double dispersion = std::fmax((huberCost(residual, fit.root) - NoiseEnergy) / numbers, 1.0);
  fit.linear = LinearFit({ fit.free.begin(), fit.free.end() },
    normalEquations(fit.derivatives, trust, left, Fold), fit.set.size() > 1, dispersion);
}

EffectFit EffectFitter::fit(EffectSet start, const FitEffort& effort) const
{
  EffectFit fit;
  fit.set = std::move(start);
  std::optional<StagedResponse> here = stagedResponse(Data.camera, Data.scene, fit.set);
  if (fit.set.size() == 0 || !here)
  {
    // Without light as bad as can be.
    fit.predicted = fit.set.size() == 0 ? Data.simulated
                                        : Eigen::MatrixXd::Constant(Data.channels(), Data.samples(),
                                            std::numeric_limits<double>::quiet_NaN());
    fit.root = huber(whitened(fit.predicted), flat(Weight));
    crossValidate(fit);
    return fit;
  }
  Eigen::ArrayXd residual = whitened(here->response());
  double damping = 1e-9;
  bool done = false;
  for (int iteration = 0;; ++iteration)
  {
    linearise(fit, *here, residual);
    if (done || iteration == effort.iterations)
    {
      break;
    }
    const double before =
      huberCost(residual, fit.root) + fit.linear.penalty(Eigen::VectorXd::Zero(fit.free.size()));
    bool better = false;
    double after = before;
    for (int attempt = 0; attempt < 6 && !better; ++attempt)
    {
      const Eigen::VectorXd step = fit.linear.step(damping);
      EffectSet moved = changed(fit.set, fit.free, step);
      std::optional<StagedResponse> there = stagedResponse(*here, moved);
      if (there)
      {
        Eigen::ArrayXd trialResidual = whitened(there->response());
        after = huberCost(trialResidual, fit.root) + fit.linear.penalty(step);
        better = after < before;
        if (better)
        {
          fit.set = std::move(moved);
          here = std::move(there);
          residual = std::move(trialResidual);
        }
      }
      damping = better ? std::fmax(damping * 0.1, 1e-9) : std::fmax(damping * 30.0, 1e-3);
    }
    if (!better)
    {
      break;
    }
    done = before - after < effort.converged * before ||
      after - Remaining * (before - after) > effort.unwanted;
  }
  fit.predicted = here->response();
  fit.linear.settle();
  crossValidate(fit);
  return fit;
}

std::optional<EffectFit> EffectFitter::oneStep(
  const EffectFit& present, const StagedResponse& response, EffectSet start) const
{
  const std::optional<StagedResponse> here = stagedResponse(response, start);
  if (!here)
  {
    return std::nullopt;
  }
  EffectFit fit;
  fit.set = std::move(start);
  fit.predicted = here->response();
  fit.free = fit.set.freeParameters(Data.camera);
  const auto added = std::find_if(fit.free.begin(), fit.free.end(),
    [&](const FreeParameter& parameter) { return parameter.effect >= present.set.size(); });
  fit.derivatives.assign(
    present.derivatives.begin(), present.derivatives.begin() + (added - fit.free.begin()));
  for (Derivative& one : derivatives(*here, fit.set, { added, fit.free.end() }))
  {
    fit.derivatives.push_back(std::move(one));
  }
  fit.root = present.root;
  solve(fit, whitened(fit.predicted));
  crossValidate(fit);
  return fit;
}

void EffectFitter::crossValidate(EffectFit& fit) const
{
  const Eigen::Index channels = Data.channels();
  const Eigen::Index samples = Data.samples();
  fit.heldOut = (Weight.array() > 0.0).select(Data.observed - fit.predicted, 0.0);
  const std::vector<Eigen::VectorXd> without = fit.linear.stepsWithout();
  for (std::size_t f = 0; f < without.size(); ++f)
  {
    for (std::size_t p = 0; p < fit.derivatives.size(); ++p)
    {
      const Derivative& derivative = fit.derivatives[p];
      for (const Eigen::Index j : Fold[f])
      {
        fit.heldOut.col(j).segment(derivative.first, derivative.changes.rows()) -=
          without[f][p] * derivative.changes.col(j);
      }
    }
  }
  fit.heldOut = (Weight.array() > 0.0).select(fit.heldOut, 0.0);
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
  const Eigen::MatrixXd pull = Weight.cwiseProduct(fit.heldOut);
  Eigen::MatrixXd scores(fit.free.size(), Training.size());
  for (std::size_t p = 0; p < fit.derivatives.size(); ++p)
  {
    const Derivative& derivative = fit.derivatives[p];
    scores.row(p) = derivative.changes.cwiseProduct(derivative.of(pull)).colwise().sum()(Training);
  }
  return fit.linear.covariance(scores);
}

Eigen::MatrixXd leftOfHeldOut(const GapData& data, const EffectFit& fit, const SampleList& training)
{
  Eigen::MatrixXd left = measuredOnly(data, data.observed - fit.predicted);
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
      const auto there = stagedResponse(data.camera, data.scene, moved);
      if (!there)
      {
        continue;
      }
      const Eigen::MatrixXd other = measuredOnly(data, data.observed - there->response());
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
