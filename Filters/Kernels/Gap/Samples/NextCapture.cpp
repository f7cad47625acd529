#include "Kernels/Gap/Samples/NextCapture.h"

#include "Kernels/Camera/StagedResponse.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Samples/GapNoise.h"
#include "Kernels/Numerics/CounterRandom.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <optional>

namespace msi
{

namespace
{
constexpr std::uint32_t DrawStream = 77;
constexpr int Draws = 64;                   // of each explanation
constexpr Eigen::Index MostElements = 2000; // of a chart that is simulated again
constexpr int Side = 3;                   // of a raster of whites: few, since they are one spectrum
constexpr double LeastProbability = 0.02; // of an explanation that is looked at

// An explanation made ready to predict.
struct Predictor
{
  EffectFit fit;
  Eigen::MatrixXd root; // of the covariance of the free parameters
  double rest = 0.0;    // variance of an element that the explanation leaves beyond noise
};

Predictor predictorOf(const SampleObservation& data, const ObservedFit& explanation)
{
  Predictor predictor{ data.linearised(explanation), {}, 0.0 };
  const EffectFit& fit = predictor.fit;
  const Eigen::MatrixXd posterior =
    fit.linear.information() / std::fmax(fit.dispersion, 1.0) + fit.linear.precision();
  const Eigen::LDLT<Eigen::MatrixXd> decomposed(
    posterior.ldlt().solve(Eigen::MatrixXd::Identity(posterior.rows(), posterior.cols())));
  predictor.root = decomposed.transpositionsP().transpose() *
    Eigen::MatrixXd(decomposed.matrixL()) *
    decomposed.vectorD().cwiseMax(0.0).cwiseSqrt().asDiagonal();
  const GroupEnergies energies = data.energies(fit);
  predictor.rest = (std::fmax(sumOf(energies.after) - sumOf(energies.noise), 0.0) +
                     Decision::FormPart * sumOf(energies.before)) /
    std::fmax(data.elements(), 1.0);
  return predictor;
}

SceneSamples selected(const SceneSamples& samples, const SampleList& which)
{
  SceneSamples some;
  some.reflectance = samples.reflectance(Eigen::all, which);
  const auto names = [&which](const std::vector<std::string>& all)
  {
    std::vector<std::string> picked;
    for (const Eigen::Index i : which)
    {
      if (!all.empty())
      {
        picked.push_back(all[static_cast<std::size_t>(i)]);
      }
    }
    return picked;
  };
  const auto numbers = [&which](const Eigen::VectorXd& all)
  { return all.size() > 0 ? Eigen::VectorXd(all(which)) : all; };
  some.medium = names(samples.medium);
  some.scene = names(samples.scene);
  some.x = numbers(samples.x);
  some.y = numbers(samples.y);
  some.order = numbers(samples.order);
  return some;
}

// Samples of the chart, spread over it.
SampleList chartOf(const GapData& data)
{
  SampleList which;
  const auto count = static_cast<Eigen::Index>(data.usable.size());
  const Eigen::Index kept =
    std::min(count, std::max<Eigen::Index>(MostElements / data.channels(), 12));
  for (Eigen::Index i = 0; i < kept; ++i)
  {
    which.push_back(data.usable[static_cast<std::size_t>(i * count / kept)]);
  }
  return which;
}

// Normal distribution with covariance diag(variance) + factor factor'.
class LowRankNormal
{
public:
  LowRankNormal(Eigen::VectorXd mean, Eigen::VectorXd variance, Eigen::MatrixXd factor)
    : Mean(std::move(mean))
    , Variance(std::move(variance))
    , Precision(Variance.cwiseInverse())
    , Factor(std::move(factor))
    , Scaled(Precision.asDiagonal() * Factor)
    , Inner(Eigen::MatrixXd::Identity(Factor.cols(), Factor.cols()) + Factor.transpose() * Scaled)
  {
    LogDeterminant =
      Variance.array().log().sum() + 2.0 * Inner.matrixLLT().diagonal().array().log().sum();
  }

  double logDensity(const Eigen::VectorXd& y) const
  {
    const Eigen::VectorXd off = y - Mean;
    const Eigen::VectorXd inner = Scaled.transpose() * off;
    const double square = off.cwiseAbs2().dot(Precision) - inner.dot(Inner.solve(inner));
    return -0.5 * (square + LogDeterminant);
  }

  Eigen::VectorXd draw(const CounterRandom& random, std::uint64_t number) const
  {
    std::vector<float> normals(static_cast<std::size_t>(Mean.size() + Factor.cols()));
    random.normals(number * normals.size(), normals.data(), normals.size());
    const Eigen::VectorXd z =
      Eigen::Map<Eigen::VectorXf>(normals.data(), static_cast<Eigen::Index>(normals.size()))
        .cast<double>();
    return Mean + Variance.cwiseSqrt().cwiseProduct(z.head(Mean.size())) +
      Factor * z.tail(Factor.cols());
  }

private:
  Eigen::VectorXd Mean, Variance, Precision;
  Eigen::MatrixXd Factor, Scaled;
  Eigen::LLT<Eigen::MatrixXd> Inner;
  double LogDeterminant = 0.0;
};

// The effects that this capture can show, those known left out.
EffectSet shownBy(const CaptureCandidate& candidate, const SampleScene& scene, const EffectSet& all,
  std::vector<std::size_t>& kept)
{
  EffectSet shown = all;
  kept.clear();
  for (std::size_t e = all.size(); e-- > 0;)
  {
    const EffectChoice& choice = all.choices[e];
    if (!canShow(scene, *choice.effect, choice.medium) ||
      (candidate.known && candidate.known(*choice.effect)))
    {
      shown.remove(e);
    }
    else
    {
      kept.insert(kept.begin(), e);
    }
  }
  return shown;
}

// The column of a parameter among all of the explanation; none: it has no variance.
std::optional<Eigen::Index> columnOf(
  const Predictor& predictor, const FreeParameter& parameter, std::size_t effect)
{
  const std::vector<FreeParameter>& all = predictor.fit.free;
  const auto same = std::find_if(all.begin(), all.end(),
    [&](const FreeParameter& other)
    {
      return other.effect == effect && other.index == parameter.index &&
        other.channel == parameter.channel;
    });
  return same == all.end() ? std::nullopt : std::make_optional(same - all.begin());
}

// The spectra of a capture that the chart did not have.
struct NewSpectra
{
  // How much worse than the chart's own the response to each of them is known, by a camera that is known from that chart: ratio of
  // their leverages. The chart tells nothing that is smaller than the noise of its reflectances.
  Eigen::RowVectorXd leverage;
  double distinct = 0.0;
};

NewSpectra newSpectra(const GapData& data, const CaptureCandidate& candidate)
{
  const Eigen::MatrixXd& all = candidate.samples.reflectance;
  const Eigen::MatrixXd spectra =
    all.rightCols(all.cols() - static_cast<Eigen::Index>(candidate.again.size()));
  if (spectra.cols() == 0)
  {
    return {};
  }
  const Eigen::MatrixXd chart = data.scene.reflectance()(Eigen::all, data.usable);
  Eigen::MatrixXd moments = chart * chart.transpose();
  moments.diagonal().array() +=
    LargestReflectanceNoise * LargestReflectanceNoise * static_cast<double>(chart.cols());
  const Eigen::LLT<Eigen::MatrixXd> known(moments);
  const auto leverageOf = [&known](const Eigen::MatrixXd& some) -> Eigen::RowVectorXd
  { return known.matrixL().solve(some).colwise().squaredNorm(); };
  std::vector<Eigen::VectorXd> distinct;
  for (const auto& spectrum : spectra.colwise())
  {
    if (std::find(distinct.begin(), distinct.end(), spectrum) == distinct.end())
    {
      distinct.emplace_back(spectrum);
    }
  }
  return { leverageOf(spectra) / leverageOf(chart).mean(), static_cast<double>(distinct.size()) };
}

// What an explanation expects of the elements of a capture.
struct Expectation
{
  Eigen::VectorXd mean, variance;
  Eigen::MatrixXd derivative; // by the free parameters of the explanation

  // Of elements from `first` on: counts as no more than so many numbers. So does what is systematic in the criterion,
  // but for its least number per channel.
  void addSystematic(const Eigen::VectorXd& added, Eigen::Index first, double numbers)
  {
    const double copies =
      static_cast<double>(added.size()) / std::fmin(numbers, Decision::BeliefNumbers);
    variance.segment(first, added.size()) += std::fmax(copies, 1.0) * added;
  }
};

// By the simulator alone. Empty where the camera would see nothing.
std::optional<Expectation> simulated(const GapData& data, const CaptureCandidate& candidate,
  const SampleScene& scene, const Predictor& predictor)
{
  std::vector<std::size_t> kept;
  const EffectSet shown = shownBy(candidate, scene, predictor.fit.set, kept);
  const std::optional<StagedResponse> here = stagedResponse(data.camera, scene, shown);
  if (!here || !here->response().allFinite())
  {
    return std::nullopt;
  }
  const Eigen::VectorXd noise = data.variance.rowwise().mean();
  Expectation expected{ here->response().reshaped(), noise.replicate(scene.size(), 1),
    Eigen::MatrixXd::Zero(
      here->response().size(), static_cast<Eigen::Index>(predictor.fit.free.size())) };
  const std::vector<FreeParameter> free = shown.freeParameters(data.camera);
  const Eigen::MatrixXd columns = jacobian(*here, shown, free);
  for (std::size_t p = 0; p < free.size(); ++p)
  {
    const std::size_t effect =
      free[p].effect < shown.size() ? kept[free[p].effect] : predictor.fit.set.size();
    if (const auto column = columnOf(predictor, free[p], effect))
    {
      expected.derivative.col(*column) = columns.col(static_cast<Eigen::Index>(p));
    }
  }
  return expected;
}

// What was seen is seen again, changed by what the explanation changes.
void seeAgain(
  Expectation& expected, const GapData& data, const SampleList& again, const Predictor& predictor)
{
  const auto known = static_cast<Eigen::Index>(again.size()) * data.channels();
  auto mean = expected.mean.head(known);
  mean -= predictor.fit.predicted(Eigen::all, again).reshaped();
  const double error = Decision::FormPart * mean.squaredNorm() / static_cast<double>(known);
  expected.addSystematic(Eigen::VectorXd::Constant(known, error), 0, Decision::BeliefNumbers);
  mean += data.observed(Eigen::all, again).reshaped();
  expected.variance.head(known) += data.variance(Eigen::all, again).reshaped();
  Eigen::Index row = 0;
  for (const Eigen::Index j : again)
  {
    expected.derivative.middleRows(row, data.channels()) -=
      predictor.fit.jacobian.middleRows(j * data.channels(), data.channels());
    row += data.channels();
  }
}

// Errors of the response to spectra are one number a channel and spectrum.
void doubt(Expectation& expected, const NewSpectra& spectra, Eigen::Index channels, double rest)
{
  const Eigen::MatrixXd error = rest * spectra.leverage.replicate(channels, 1);
  expected.addSystematic(error.reshaped(), expected.mean.size() - error.size(),
    static_cast<double>(channels) * spectra.distinct);
}

std::optional<LowRankNormal> prediction(const GapData& data, const CaptureCandidate& candidate,
  const SampleScene& scene, const NewSpectra& spectra, const Predictor& predictor)
{
  std::optional<Expectation> expected = simulated(data, candidate, scene, predictor);
  if (!expected)
  {
    return std::nullopt;
  }
  if (!candidate.again.empty())
  {
    seeAgain(*expected, data, candidate.again, predictor);
  }
  if (spectra.leverage.size() > 0)
  {
    doubt(*expected, spectra, data.channels(), predictor.rest);
  }
  return LowRankNormal(std::move(expected->mean),
    Decision::Temperature * (expected->variance.array() + 1e-14),
    std::sqrt(Decision::Temperature) * expected->derivative * predictor.root);
}

double logSumExp(const std::vector<double>& logs)
{
  const double top = *std::max_element(logs.begin(), logs.end());
  double sum = 0.0;
  for (const double one : logs)
  {
    sum += std::exp(one - top);
  }
  return top + std::log(sum);
}

// group: of explanations that are one.
double expectedBits(const std::vector<LowRankNormal>& predicted,
  const std::vector<double>& probability, const std::vector<std::set<std::string>>& group,
  const CounterRandom& random)
{
  double information = 0.0;
  for (std::size_t h = 0; h < predicted.size(); ++h)
  {
    double mean = 0.0;
    for (std::uint64_t draw = 0; draw < Draws; ++draw)
    {
      const Eigen::VectorXd y = predicted[h].draw(random, h * Draws + draw);
      std::vector<double> joint, ofGroup;
      double groupProbability = 0.0;
      for (std::size_t g = 0; g < predicted.size(); ++g)
      {
        joint.push_back(std::log(probability[g]) + predicted[g].logDensity(y));
        if (group[g] == group[h])
        {
          ofGroup.push_back(joint.back());
          groupProbability += probability[g];
        }
      }
      mean += (logSumExp(ofGroup) - std::log(groupProbability) - logSumExp(joint)) / Draws;
    }
    information += probability[h] * mean;
  }
  return std::fmax(information / std::log(2.0), 0.0);
}
}

SceneSamples joined(SceneSamples first, const SceneSamples& next)
{
  const auto before = static_cast<std::size_t>(first.reflectance.cols());
  const Eigen::Index added = next.reflectance.cols();
  const std::size_t all = before + static_cast<std::size_t>(added);
  Eigen::MatrixXd reflectance(first.reflectance.rows(), static_cast<Eigen::Index>(all));
  reflectance << first.reflectance, next.reflectance;
  first.reflectance = std::move(reflectance);
  first.medium.resize(before);
  first.medium.insert(first.medium.end(), next.medium.begin(), next.medium.end());
  first.medium.resize(all);
  first.scene.resize(before);
  first.scene.resize(all, "next capture");
  const auto add = [added](Eigen::VectorXd& to, const Eigen::VectorXd& more)
  {
    if (to.size() > 0)
    {
      const double unknown = std::numeric_limits<double>::quiet_NaN();
      Eigen::VectorXd both(to.size() + added);
      both << to, (more.size() > 0 ? more : Eigen::VectorXd::Constant(added, unknown));
      to = std::move(both);
    }
  };
  add(first.x, next.x);
  add(first.y, next.y);
  add(first.order, next.order);
  fillInUnknown(first);
  return first;
}

std::vector<CaptureCandidate> captureCandidates(
  const GapData& data, const std::vector<std::string>& effects)
{
  const WavelengthGrid& grid = data.camera.wavelengths();
  const Eigen::Index N = grid.size();
  const auto flat = [N](const std::vector<double>& levels)
  {
    SceneSamples samples;
    samples.reflectance = Eigen::VectorXd::Ones(N) *
      Eigen::Map<const Eigen::RowVectorXd>(levels.data(), static_cast<Eigen::Index>(levels.size()));
    return samples;
  };
  std::vector<CaptureCandidate> candidates;
  candidates.push_back({ Captures::LensCap, flat({ 0.0 }) });
  const SceneSamples white = flat({ 0.9, 0.9 });
  candidates.push_back({ Captures::RepeatedWhite, white });
  candidates.push_back(
    { Captures::ExposureSeries, flat({ 0.95, 0.7, 0.5, 0.35, 0.2, 0.1, 0.05 }) });
  candidates.push_back({ Captures::BlackTrap, flat({ 0.0, 0.03, 0.03, 0.03 }) });

  SceneSamples narrow;
  const Eigen::Index bands = std::min<Eigen::Index>(N, 40);
  narrow.reflectance.resize(N, bands);
  for (Eigen::Index i = 0; i < bands; ++i)
  {
    const double center = grid[i * (N - 1) / std::max<Eigen::Index>(bands - 1, 1)];
    for (Eigen::Index n = 0; n < N; ++n)
    {
      narrow.reflectance(n, i) = std::exp(-0.5 * std::pow((grid[n] - center) / 5.0, 2));
    }
  }
  candidates.push_back({ Captures::NarrowBands, narrow });

  const SampleList again = chartOf(data);
  const SceneSamples chart = selected(data.scene.samples(), again);
  if (data.scene.hasPositions())
  {
    SceneSamples even = flat(std::vector<double>(Side * Side, 0.9));
    const auto across = [](const Eigen::VectorXd& v) -> Eigen::VectorXd
    { return Eigen::VectorXd::LinSpaced(Side, v.minCoeff(), v.maxCoeff()); };
    even.x = across(chart.x).replicate(Side, 1);
    even.y = across(chart.y).transpose().replicate(Side, 1).reshaped();
    candidates.push_back({ Captures::FlatField, even });
    SceneSamples turned = chart;
    turned.x = (chart.x.minCoeff() + chart.x.maxCoeff()) - chart.x.array();
    turned.y = (chart.y.minCoeff() + chart.y.maxCoeff()) - chart.y.array();
    candidates.push_back({ Captures::TurnedChart, turned, again });
    SceneSamples board = even;
    for (Eigen::Index i = 0; i < board.reflectance.cols(); i += 2)
    {
      board.reflectance.col(i).setConstant(0.03);
    }
    candidates.push_back({ Captures::BlackAndWhite, board });
  }
  if (data.scene.hasOrder())
  {
    SceneSamples interleaved = flat(std::vector<double>(Side * Side, 0.9));
    interleaved.order =
      Eigen::VectorXd::LinSpaced(Side * Side, chart.order.minCoeff(), chart.order.maxCoeff());
    candidates.push_back({ Captures::InterleavedWhite, interleaved });
  }

  // The tile on which the lamp is measured is also seen by the camera.
  candidates.push_back({ Captures::LampSpectrum, joined(chart, white), again,
    [](const EffectDefinition& effect) { return effect.has(EffectTrait::SpectralGain); } });
  candidates.push_back({ Captures::Monochromator, chart, again, [](const EffectDefinition& effect) {
                          return effect.stage == EffectStage::Responsivity &&
                            !effect.has(EffectTrait::SpectralGain);
                        } });
  for (const EffectDefinition& effect : effectLibrary())
  {
    const bool named = std::find(effects.begin(), effects.end(), effect.name) != effects.end();
    if (named && effect.stage == EffectStage::Reflectance)
    {
      candidates.push_back({ effect.separatingCapture, chart, again,
        [&effect](const EffectDefinition& other) { return &other == &effect; } });
    }
  }
  return candidates;
}

std::vector<GapNextCapture> nextCaptures(const SampleObservation& data,
  const std::vector<Explanation>& explanations, const std::set<std::string>& inQuestion,
  std::uint64_t seed)
{
  std::vector<FitPointer> fits;
  std::vector<double> probability;
  std::vector<std::set<std::string>> group;
  std::vector<std::string> effects;
  for (const Explanation& one : explanations)
  {
    if (one.probability >= LeastProbability)
    {
      fits.push_back(one.fit);
      probability.push_back(one.probability);
      group.push_back(inBoth(one.effects, inQuestion));
      effects.insert(effects.end(), one.effects.begin(), one.effects.end());
    }
  }
  if (std::set<std::set<std::string>>(group.begin(), group.end()).size() < 2)
  {
    return {};
  }
  const double all = sumOf(probability);
  for (double& one : probability)
  {
    one /= all;
  }
  std::vector<Predictor> predictors;
  predictors.reserve(fits.size());
  for (const FitPointer& fit : fits)
  {
    predictors.push_back(predictorOf(data, *fit));
  }
  const std::vector<std::string> separates = disputed(explanations, inQuestion);
  const GapData& gap = data.fitter().data();
  const CounterRandom random(seed, DrawStream);
  std::vector<GapNextCapture> captures;
  for (const CaptureCandidate& candidate : captureCandidates(gap, effects))
  {
    const SampleScene scene(gap.camera.wavelengths(), candidate.samples);
    const NewSpectra spectra = newSpectra(gap, candidate);
    std::vector<LowRankNormal> predicted;
    for (const Predictor& predictor : predictors)
    {
      if (auto one = prediction(gap, candidate, scene, spectra, predictor))
      {
        predicted.push_back(std::move(*one));
      }
    }
    const double bits = predicted.size() == predictors.size()
      ? expectedBits(predicted, probability, group, random)
      : 0.0;
    if (bits >= LeastBits)
    {
      captures.push_back({ candidate.kind.name, separates, bits, candidate.kind.minutes });
    }
  }
  sortByWorth(captures);
  return captures;
}

} // namespace msi
