#include "Kernels/Gap/Samples/NextCapture.h"

#include "Kernels/Camera/StagedResponse.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/SetSearch.h"
#include "Kernels/Gap/Samples/GapNoise.h"
#include "Kernels/Numerics/CounterRandom.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <memory>
#include <optional>

namespace msi
{

namespace
{
constexpr std::uint32_t DrawStream = 77;
constexpr int Draws = 256; // of each explanation: 64 leave 1 recommendation of 25 to chance
constexpr Eigen::Index MostElements = 2000; // of a chart that is simulated again
constexpr int Side = 3;                   // of a raster of whites: few, since they are one spectrum
constexpr double LeastProbability = 0.02; // of an explanation that is looked at

// An explanation made ready to predict.
struct Predictor
{
  EffectFit fit;
  SparseMatrix precision; // of its numbers and, behind them, of means of their prior
  std::shared_ptr<const SparseFactor> factor;
  double rest = 0.0; // variance of an element that the explanation leaves beyond noise

  Predictor(const SampleObservation& data, const ObservedFit& explanation)
    : fit(data.linearised(explanation))
    , precision(fit.linear.prior().after(fit.linear.information() / std::fmax(fit.dispersion, 1.0)))
    , factor(std::make_shared<SparseFactor>(precision))
  {
    const Eigen::Array3d energies = data.energies(fit).colwise().sum();
    rest = (std::fmax(energies[1] - energies[2], 0.0) + Decision::FormPart * energies[0]) /
      std::fmax(data.elements(), 1.0);
  }
};

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
        picked.push_back(all[i]);
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
  const Eigen::Index count = data.usable.size();
  const Eigen::Index kept =
    std::min(count, std::max<Eigen::Index>(MostElements / data.channels(), 12));
  for (Eigen::Index i = 0; i < kept; ++i)
  {
    which.push_back(data.usable[i * count / kept]);
  }
  return which;
}

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

// What an explanation expects of a capture; K x S.
struct Expectation
{
  Eigen::MatrixXd mean, variance;
  std::vector<Eigen::Triplet<double>>
    derivatives; // of each element, column by column, by the numbers of the explanation

  // Of samples from the first on, by one number, times a factor.
  void addDerivative(Eigen::Index number, const Derivative& derivative, double factor)
  {
    for (Eigen::Index j = 0; j < derivative.changes.cols(); ++j)
    {
      for (Eigen::Index k = 0; k < derivative.changes.rows(); ++k)
      {
        derivatives.emplace_back(
          j * mean.rows() + derivative.first + k, number, factor * derivative.changes(k, j));
      }
    }
  }

  // Of samples from `first` on: counts as so many numbers, but as no more than in the criterion.
  void addSystematic(const Eigen::MatrixXd& added, Eigen::Index first, double numbers)
  {
    const double most = independentNumbers(Decision::BeliefNumbers, added.size(), added.rows());
    const double copies = static_cast<double>(added.size()) / std::fmin(numbers, most);
    variance.middleCols(first, added.cols()) += std::fmax(copies, 1.0) * added;
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
  Expectation expected{ here->response(), noise.replicate(1, scene.size()), {} };
  const std::vector<FreeParameter> free = shown.freeParameters(data.camera);
  const std::vector<Derivative> known = derivatives(*here, shown, free);
  for (std::size_t p = 0; p < predictor.fit.free.size(); ++p)
  {
    const FreeParameter& parameter = predictor.fit.free[p];
    const auto same = std::find_if(free.begin(), free.end(),
      [&](const FreeParameter& other)
      {
        const std::size_t effect =
          other.effect < shown.size() ? kept[other.effect] : predictor.fit.set.size();
        return parameter.effect == effect && parameter.index == other.index &&
          parameter.channel == other.channel;
      });
    if (same != free.end())
    {
      expected.addDerivative(p, known[same - free.begin()], 1.0);
    }
  }
  return expected;
}

// What was seen is seen again, changed by what the explanation changes.
void seeAgain(
  Expectation& expected, const GapData& data, const SampleList& again, const Predictor& predictor)
{
  const Eigen::Index known = again.size();
  auto mean = expected.mean.leftCols(known);
  mean -= predictor.fit.predicted(Eigen::all, again);
  const double error = Decision::FormPart * mean.squaredNorm() / static_cast<double>(mean.size());
  expected.addSystematic(Eigen::MatrixXd::Constant(mean.rows(), known, error), 0,
    std::numeric_limits<double>::infinity());
  mean += data.observed(Eigen::all, again);
  expected.variance.leftCols(known) += data.variance(Eigen::all, again);
  for (std::size_t p = 0; p < predictor.fit.derivatives.size(); ++p)
  {
    const Derivative& before = predictor.fit.derivatives[p];
    expected.addDerivative(p, { before.first, before.changes(Eigen::all, again) }, -1.0);
  }
}

// Errors of the response to spectra are one number a channel and spectrum.
void doubt(Expectation& expected, const NewSpectra& spectra, double rest)
{
  const Eigen::Index channels = expected.mean.rows();
  const Eigen::MatrixXd error = rest * spectra.leverage.replicate(channels, 1);
  expected.addSystematic(
    error, expected.mean.cols() - error.cols(), static_cast<double>(channels) * spectra.distinct);
}

// The normal distribution of a capture's elements: they scatter independently, and with the parameters of the explanation.
class Prediction
{
public:
  Prediction(Expectation expected, const Predictor& by)
    : Expected(std::move(expected))
    , By(by)
    , Jacobian(Expected.mean.size(), by.precision.cols())
  {
    Expected.variance = Decision::Temperature * (Expected.variance.array() + 1e-14);
    Jacobian.setFromTriplets(Expected.derivatives.begin(), Expected.derivatives.end());
    Jacobian *= std::sqrt(Decision::Temperature);
    const SparseMatrix weighted =
      Expected.variance.reshaped().cwiseInverse().asDiagonal() * Jacobian;
    Inner = std::make_unique<SparseFactor>(
      SparseMatrix(By.precision + SparseMatrix(Jacobian.transpose() * weighted)));
    LogDeterminant =
      Expected.variance.array().log().sum() + logDeterminant(*Inner) - logDeterminant(*By.factor);
  }

  double logDensity(const Eigen::MatrixXd& y) const
  {
    const Eigen::MatrixXd off = y - Expected.mean;
    const Eigen::MatrixXd pull = off.cwiseQuotient(Expected.variance);
    const Eigen::VectorXd inner = Jacobian.transpose() * pull.reshaped();
    const double square = off.cwiseProduct(pull).sum() - inner.dot(Inner->solve(inner));
    return -0.5 * (square + LogDeterminant);
  }

  Eigen::MatrixXd draw(const CounterRandom& random, std::uint64_t number) const
  {
    const Eigen::Index elements = Expected.mean.size();
    Eigen::VectorXf normals(elements + By.precision.rows());
    random.normals(number * normals.size(), normals.data(), normals.size());
    const Eigen::VectorXd z = normals.cast<double>();
    Eigen::MatrixXd y = Expected.mean +
      Expected.variance.cwiseSqrt().cwiseProduct(
        z.head(elements).reshaped(Expected.mean.rows(), Expected.mean.cols()));
    const Eigen::VectorXd scaled =
      z.tail(By.precision.rows()).cwiseQuotient(By.factor->vectorD().cwiseSqrt());
    const Eigen::VectorXd parameters =
      By.factor->permutationPinv() * Eigen::VectorXd(By.factor->matrixU().solve(scaled));
    y.reshaped() += Jacobian * parameters;
    return y;
  }

private:
  Expectation Expected;
  const Predictor& By;
  SparseMatrix Jacobian; // by the explanation's numbers and, behind them, means of their prior
  std::unique_ptr<SparseFactor> Inner; // of the precision of the numbers once the capture is known
  double LogDeterminant = 0.0;
};

std::optional<Prediction> prediction(const GapData& data, const CaptureCandidate& candidate,
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
    doubt(*expected, spectra, predictor.rest);
  }
  return Prediction(std::move(*expected), predictor);
}

// Logarithm of the weighted mean of densities.
double logMean(const Eigen::ArrayXd& logs, const Eigen::ArrayXd& weights)
{
  const double top =
    (weights > 0.0).select(logs, -std::numeric_limits<double>::infinity()).maxCoeff();
  return top + std::log((weights > 0.0).select(weights * (logs - top).exp(), 0.0).sum());
}

// group: of explanations that are one.
double expectedBits(const std::vector<Prediction>& predicted, const Eigen::ArrayXd& probability,
  const std::vector<std::set<std::string>>& group, const CounterRandom& random)
{
  double information = 0.0;
  for (std::size_t h = 0; h < predicted.size(); ++h)
  {
    Eigen::ArrayXd ofGroup = probability;
    for (std::size_t g = 0; g < predicted.size(); ++g)
    {
      ofGroup[g] *= group[g] == group[h] ? 1.0 : 0.0;
    }
    ofGroup /= ofGroup.sum();
    double mean = 0.0;
    for (std::uint64_t draw = 0; draw < Draws; ++draw)
    {
      const Eigen::MatrixXd y = predicted[h].draw(random, h * Draws + draw);
      Eigen::ArrayXd logs(probability.size());
      std::transform(predicted.begin(), predicted.end(), logs.begin(),
        [&y](const Prediction& one) { return one.logDensity(y); });
      mean += (logMean(logs, ofGroup) - logMean(logs, probability)) / Draws;
    }
    information += probability[h] * mean;
  }
  return std::fmax(information / std::log(2.0), 0.0);
}
}

SceneSamples joined(SceneSamples first, const SceneSamples& next)
{
  const std::size_t before = first.reflectance.cols();
  const Eigen::Index added = next.reflectance.cols();
  const std::size_t all = before + added;
  Eigen::MatrixXd reflectance(first.reflectance.rows(), all);
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
    samples.reflectance =
      Eigen::VectorXd::Ones(N) * Eigen::Map<const Eigen::RowVectorXd>(levels.data(), levels.size());
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
    narrow.reflectance.col(i) = (-0.5 * ((grid.vector().array() - center) / 5.0).square()).exp();
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
  std::vector<double> chances;
  std::vector<std::set<std::string>> group;
  std::vector<std::string> effects;
  for (const Explanation& one : explanations)
  {
    if (one.probability >= LeastProbability)
    {
      fits.push_back(one.fit);
      chances.push_back(one.probability);
      group.push_back(inBoth(one.effects, inQuestion));
      effects.insert(effects.end(), one.effects.begin(), one.effects.end());
    }
  }
  if (std::set<std::set<std::string>>(group.begin(), group.end()).size() < 2)
  {
    return {};
  }
  const Eigen::Map<const Eigen::ArrayXd> all(chances.data(), chances.size());
  const Eigen::ArrayXd probability = all / all.sum();
  std::vector<Predictor> predictors;
  predictors.reserve(fits.size());
  for (const FitPointer& fit : fits)
  {
    predictors.emplace_back(data, *fit);
  }
  const std::vector<std::string> separates = disputed(explanations, inQuestion);
  const GapData& gap = data.fitter().data();
  const CounterRandom random(seed, DrawStream);
  std::vector<GapNextCapture> captures;
  for (const CaptureCandidate& candidate : captureCandidates(gap, effects))
  {
    const SampleScene scene(gap.camera.wavelengths(), candidate.samples);
    const NewSpectra spectra = newSpectra(gap, candidate);
    std::vector<Prediction> predicted;
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
