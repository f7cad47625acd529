#include "Kernels/Gap/SimToRealGap.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/FoundCauses.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Gap/Samples/AxisShares.h"
#include "Kernels/Gap/Samples/GapData.h"
#include "Kernels/Gap/Samples/GapEvidence.h"
#include "Kernels/Gap/Samples/GapNoise.h"
#include "Kernels/Gap/Samples/GapNotes.h"
#include "Kernels/Gap/Samples/NextCapture.h"
#include "Kernels/Gap/Samples/OrderBreaks.h"
#include "Kernels/Gap/Samples/SampleObservation.h"
#include "Kernels/Gap/Shrink.h"
#include "Kernels/Gap/UnmodelledPart.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace msi
{

namespace
{
constexpr int MostChangePoints = 6;

// Over jobs that may run on several threads.
class Progress
{
public:
  Progress(const GapOptions& options, double steps)
    : Options(options)
    , Steps(steps)
  {
  }
  // So many steps are done. Returns whether to stop.
  bool operator()(const char* what, double steps = 0.0)
  {
    bool stop = false;
    const auto tell = [&]
    {
      Done += steps;
      Stopped =
        Stopped || (Options.progress && !Options.progress(std::fmin(Done / Steps, 1.0), what));
      stop = Stopped;
    };
    Options.exclusive ? Options.exclusive(tell) : tell();
    return stop;
  }
  bool stopped() const noexcept { return Stopped; } // while no other thread runs a job

private:
  const GapOptions& Options;
  bool Stopped = false;
  double Done = 0.0;
  double Steps;
};

// Adds the regular part of what is left of samples held out. predicted: of each fold, and last by all samples.
void addRest(GapReport& report, const GapData& data, const std::vector<Eigen::MatrixXd>& predicted,
  const GapOptions& options, Eigen::MatrixXd& after)
{
  Eigen::MatrixXd left = after;
  for (int fold = 0; fold < data.folds; ++fold)
  {
    const SampleList heldOut = samplesOf(data, fold, true);
    const Eigen::MatrixXd& here = predicted[static_cast<std::size_t>(fold)];
    const CameraEffect rest = regularPart(data, here, samplesOf(data, fold, false), options.seed);
    left(Eigen::all, heldOut) -= (withRegularPart(data, rest, here) - here)(Eigen::all, heldOut);
  }
  left = measuredOnly(data, left);
  const GapFigures figures = figuresOf(
    energiesOf(data, data.usable, after, left), static_cast<double>(data.elements), options.seed);
  if (!(figures.shrinkInterval[0] > 0.0))
  {
    return;
  }
  report.unexplained.rmsWithRest = figures.rmsAfter;
  if (options.addRest)
  {
    after = left;
    report.correction.push_back(regularPart(data, predicted.back(), data.usable, options.seed));
  }
}

// Errors of the sums over wavelength depend on spectra, and so does what lamp, filters, reflectance and neighbouring channels do
// to the response. What a linear fit leaves of a curve is in every fitted camera.
bool actsOnSpectra(const EffectChoice& choice)
{
  return choice.effect->stage == EffectStage::Reflectance ||
    choice.effect->stage == EffectStage::Responsivity ||
    choice.effect->has(EffectTrait::CouplesChannels) || choice.form->has(FormTrait::BesideLine);
}

// Whether the others alone take most of the gap's energy.
bool mostlyBesideSpectra(
  const SampleObservation& observation, const ObservedFit& best, const Eigen::MatrixXd& before)
{
  const std::vector<EffectChoice>& choices = static_cast<const SampleFit&>(best).effects.choices;
  std::size_t others = 0;
  for (std::size_t p = 0; p < choices.size(); ++p)
  {
    others |= actsOnSpectra(choices[p]) ? 0 : std::size_t(1) << p;
  }
  const GapData& data = observation.fitter().data();
  const EffectFit fit = observation.whole(*observation.reduced(best, others));
  const Eigen::MatrixXd after = measuredOnly(data, data.observed - fit.predicted);
  return after.squaredNorm() < 0.5 * before.squaredNorm();
}
}

void GapOptions::forAll(int count, const std::function<void(int)>& body) const
{
  if (parallelFor)
  {
    parallelFor(count, body);
    return;
  }
  for (int i = 0; i < count; ++i)
  {
    body(i);
  }
}

std::optional<GapReport> diagnoseGap(const GapCapture& capture, const GapOptions& options)
{
  requireKnown(options.without);
  GapData data = prepareGapData(capture, options);
  NoiseFinding noise = findNoise(data, capture.noise);
  const Eigen::MatrixXd before = measuredOnly(data, data.observed - data.simulated);
  data.variance =
    noise.unknown ? unknownVariance(data, before) : readingVariance(data, noise.reading);
  const Eigen::MatrixXd integration = integrationVariance(data, capture.wavelengths);
  data.variance += integration;
  if (options.reflectanceNoise)
  {
    data.variance.colwise() +=
      *options.reflectanceNoise * *options.reflectanceNoise * reflectanceErrorGain(data.camera);
  }
  setWeights(data);

  GapReport report;
  Progress progress(options, data.folds + 4.0);
  const std::vector<EffectChoice> choices = choicesFor(data.scene, options.without);
  const SampleObservation observation(data, data.usable, choices, options.seed);
  FoundSets found;
  Eigen::MatrixXd after = before;
  std::vector<Eigen::MatrixXd> predicted(static_cast<std::size_t>(data.folds) + 1);
  const std::function<bool()> stop = [&progress] { return progress("searching for effects"); };
  const auto job = [&](int number)
  {
    if (stop())
    {
      return;
    }
    SetSearchLimits limits;
    limits.maximumEffects = options.maximumCauses;
    if (number == 0)
    {
      found = searchSets(observation, limits, stop);
      progress("effects found", 2.0);
      return;
    }
    const SampleList training = samplesOf(data, number - 1, false);
    const SampleList heldOut = samplesOf(data, number - 1, true);
    const SampleObservation fold(
      data, training, choices, options.seed + static_cast<std::uint64_t>(number));
    limits.beamWidth = 1;
    limits.optionsFitted = 5;
    limits.exchange = false;
    const FoundSets result = searchSets(fold, limits, stop);
    const EffectFit whole = fold.whole(*result.best);
    predicted[static_cast<std::size_t>(number - 1)] = whole.predicted;
    const Eigen::MatrixXd left = leftOfHeldOut(data, whole, training);
    after(Eigen::all, heldOut) = left(Eigen::all, heldOut);
    progress("checked on samples left out", 1.0);
  };
  options.forAll(data.folds + 1, job);
  if (progress.stopped())
  {
    return std::nullopt;
  }

  if (noise.unknown)
  {
    data.variance = data.variance.cwiseMin(unknownVariance(data, after) + integration);
  }
  const AxisShares rest = shareOverAxes(data, after);
  const double unpredicted = std::fmin(after.squaredNorm(), rest.heldOutResidual.squaredNorm());
  const double doubted = limitIntegration(data, integration, unpredicted);
  if (capture.noise && noise.degrees == 0.0)
  {
    const Eigen::MatrixXd modelled = readingVariance(data, noise.reading);
    noise.excess = excessScatter(data, after, modelled, data.variance - modelled);
    noise.unrepeated = noise.excess > 1.0;
    noise.reading.read *= noise.excess;
    noise.reading.shot *= noise.excess;
    data.variance += readingVariance(data, noise.reading) - modelled;
  }
  double reflectanceNoise = options.reflectanceNoise.value_or(0.0);
  if (!options.reflectanceNoise && !noise.unknown)
  {
    reflectanceNoise = reflectanceScatter(data, after, unpredicted);
    data.variance.colwise() +=
      reflectanceNoise * reflectanceNoise * reflectanceErrorGain(data.camera);
  }
  report.gap = figuresOf(
    energiesOf(data, data.usable, before, after), static_cast<double>(data.elements), options.seed);
  const AxisShares where = shareOverAxes(data, before);
  report.where = where.axes;
  report.changePoints =
    OrderBreaks::significant(observation.fitter(), data.simulated, MostChangePoints);
  progress("axes shared", 1.0);

  const bool causes = !found.best->set.empty();
  const EffectFit best = observation.whole(*found.best);
  const double alone = shrinkOf(observation.energies(best)); // all samples took part in the choice
  const ExcessNoise excess = excessNoise(data, noise, capture.noise, options.without);
  const double ofNoise = partOf(excess, report.gap);
  Evidence evidence;
  bool scatterAlone = false;
  if (causes)
  {
    evidence.noticed = report.gap.shrink > 0.0 ? noticed(data, before, after, integration) : 0.0;
  }
  if (causes && report.gap.shrink > 0.0 &&
    (evidence.noticed > 1.0 || mostlyBesideSpectra(observation, *found.best, before)))
  {
    evidence.credited = report.gap.shrink;
    evidence.rest = rest.axes;
  }
  else if (causes && alone >= Decision::ExplainedShrink &&
    inFewSamples(data, best.predicted - data.simulated))
  {
    report.unconfirmed = true;
    evidence.credited = Decision::Unconfirmed * alone;
    evidence.rest = where.axes;
  }
  else
  {
    // What the axes predict; or what nothing predicts, but that neither noise nor sums over wavelength make.
    evidence.gap = (predictable(data, before, where) &&
                     where.predictable > negligibleEnergy(data, after, integration)) ||
      report.gap.rmsBefore >
        Decision::BeyondNoise * std::hypot(report.gap.noiseFloor, std::sqrt(doubted));
    scatterAlone = !evidence.gap && excess.energy > 0.0 && excess.belief == 0.0;
    evidence.gap = evidence.gap || scatterAlone;
  }
  evidence.explained =
    (1.0 - ofNoise) * (evidence.credited > 0.0 ? report.gap.shrink : 0.0) + ofNoise * excess.belief;
  predicted.back() = best.predicted;
  if (evidence.credited > 0.0)
  {
    const EffectSet& effects = static_cast<const SampleFit&>(*found.best).effects;
    report.correction = effects.simulated();
    report.whiteAfterEffects = effects.whiteAfterEffects();
  }
  else
  {
    after = before;
    std::fill(predicted.begin(), predicted.end(), data.simulated);
  }
  const std::vector<Explanation> explanations =
    conclude(report, observation, found, evidence, options.seed);
  if (report.verdict != GapVerdict::NoGap)
  {
    addRest(report, data, predicted, options, after);
    report.nextCaptures =
      nextCaptures(observation, explanations, inQuestion(report.causes), options.seed);
  }
  if (scatterAlone)
  {
    report.unexplained.where = whereOf(noise);
  }
  addExcessNoise(report, data, noise, excess);
  report.notes = notesOn(data, capture, noise, reflectanceNoise, report);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  report.gapBefore = data.measured().select(before, nan);
  report.gapAfter = data.measured().select(after, nan);
  progress("done", 10.0);
  return report;
}

} // namespace msi
