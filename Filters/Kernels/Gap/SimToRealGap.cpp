#include "Kernels/Gap/SimToRealGap.h"

#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/FoundCauses.h"
#include "Kernels/Gap/Diagnosis/GapRegression.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Gap/Samples/GapData.h"
#include "Kernels/Gap/Samples/GapEvidence.h"
#include "Kernels/Gap/Samples/GapNoise.h"
#include "Kernels/Gap/Samples/GapNotes.h"
#include "Kernels/Gap/Samples/NextCapture.h"
#include "Kernels/Gap/Samples/OrderBreaks.h"
#include "Kernels/Gap/Samples/SampleObservation.h"
#include "Kernels/Gap/WithoutOddOnes.h"

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

// What an effect of the trait Remainder makes of responses, K x S.
Eigen::MatrixXd withRest(
  const GapData& data, const CameraEffect& rest, const Eigen::MatrixXd& predicted)
{
  const BoundEffect bound(rest, data.camera, -1);
  const SampleScene& scene = data.scene;
  Eigen::MatrixXd response = predicted;
  registered(bound.definition())
    .makeBlock(bound)
    ->apply(Block<double>(response),
      { nullptr, scene.fieldX().data(), scene.fieldY().data(), scene.time().data() });
  return response;
}

// The regular part of what is left of the training samples.
CameraEffect regularPartOf(const GapData& data, const Eigen::MatrixXd& predicted,
  const SampleList& training, std::uint64_t seed)
{
  const Eigen::Index count = effectWith(EffectTrait::Remainder).forms.front().parameters.size();
  // It is linear in its parameters: a column is what the parameter 1 adds.
  std::vector<Eigen::MatrixXd> columns;
  for (Eigen::Index n = 0; n < count; ++n)
  {
    Eigen::MatrixXd one = Eigen::MatrixXd::Zero(data.channels(), count);
    one.col(n).setOnes();
    columns.push_back(
      withRest(data, remainderEffect(one, data.camera.channels()), predicted) - predicted);
  }
  columns.push_back(data.observed - predicted);
  std::vector<ChannelNormals> products;
  for (const SampleList& fold : foldsOf(data, training, InnerFolds, seed))
  {
    products.emplace_back();
    for (Eigen::Index k = 0; k < data.channels(); ++k)
    {
      Eigen::MatrixXd rows(fold.size(), columns.size());
      for (std::size_t n = 0; n < columns.size(); ++n)
      {
        rows.col(n) = columns[n](k, fold).transpose();
      }
      products.back().emplace_back(rows.transpose() * data.weight(k, fold).asDiagonal() * rows);
    }
  }
  return regularPart(products, data.camera.channels());
}

// Adds the regular part of what is left of samples held out. predicted: of each fold, and last by all samples.
void addRest(GapReport& report, const GapData& data, const std::vector<Eigen::MatrixXd>& predicted,
  const GapOptions& options, Eigen::MatrixXd& after)
{
  Eigen::MatrixXd left = after;
  for (std::size_t f = 0; f < data.folds.size(); ++f)
  {
    const Eigen::MatrixXd& here = predicted[f];
    const CameraEffect rest = regularPartOf(data, here, samplesOutside(data, f), options.seed);
    left(Eigen::all, data.folds[f]) -=
      (withRest(data, rest, here) - here)(Eigen::all, data.folds[f]);
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
    report.correction.push_back(regularPartOf(data, predicted.back(), data.usable, options.seed));
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

// Its steps in their order.
class TableDiagnosis
{
public:
  TableDiagnosis(const GapCapture& capture, const GapOptions& options, IndexList leftOut = {})
    : Capture(capture)
    , Options(options)
    , Data(prepareGapData(capture, options, std::move(leftOut)))
    , Noise(findNoise(Data, capture.noise))
    , Integration(integrationVariance(Data, capture.wavelengths))
    , Before(measuredOnly(Data, Data.observed - Data.simulated))
    , After(Before)
    , Predicted(Data.folds.size() + 1)
    , Steps(options, Data.folds.size() + 4.0)
  {
  }

  // unlessOdd: where samples are odd goes no further than to find them.
  std::optional<GapReport> run(bool unlessOdd, bool mixedUp)
  {
    expectNoise();
    Choices = choicesFor(Data.scene, Options.without);
    Observed.emplace(Data, Data.usable, Choices, Options.seed);
    const int first = unlessOdd ? 1 : 0;
    Options.forAll(
      static_cast<int>(Predicted.size()) - first, [&](int job) { search(first + job); });
    Odd = Steps.stopped() ? IndexList() : oddElements(Data, Before, After);
    if (unlessOdd && Odd.empty())
    {
      search(0);
    }
    if (Steps.stopped() || (unlessOdd && !Odd.empty()))
    {
      return std::nullopt;
    }
    learnNoise();
    Report.gap = figuresOf(energiesOf(Data, Data.usable, Before, After),
      static_cast<double>(Data.elements), Options.seed);
    Where = shareOverAxes(Data, Before);
    Report.where = Where.axes;
    Report.changePoints =
      OrderBreaks::significant(Observed->fitter(), Data.simulated, MostChangePoints);
    Steps("axes shared", 1.0);
    judge(mixedUp);
    Steps("done", 10.0);
    return std::move(Report);
  }

  const GapData& data() const noexcept { return Data; }
  const IndexList& odd() const noexcept { return Odd; } // once it has run

private:
  // What is known of the noise before effects are.
  void expectNoise()
  {
    Data.variance =
      Noise.unknown ? unknownVariance(Data, Before) : readingVariance(Data, Noise.reading);
    Data.variance += Integration;
    addReflectanceNoise(Options.reflectanceNoise.value_or(0.0));
    setWeights(Data);
  }

  // Number 0: among all samples. Others: without one fold, for which the result predicts what is left.
  void search(std::size_t number)
  {
    const std::function<bool()> stop = [this] { return Steps("searching for effects"); };
    if (stop())
    {
      return;
    }
    SetSearchLimits limits;
    limits.maximumEffects = Options.maximumCauses;
    if (number == 0)
    {
      Found = searchSets(*Observed, limits, stop);
      Steps("effects found", 2.0);
      return;
    }
    const SampleList& heldOut = Data.folds[number - 1];
    const SampleList training = samplesOutside(Data, number - 1);
    const SampleObservation fold(Data, training, Choices, Options.seed + number);
    limits.beamWidth = 1;
    limits.optionsFitted = 5;
    limits.exchange = false;
    const FoundSets result = searchSets(fold, limits, stop);
    const EffectFit whole = fold.whole(*result.best);
    Predicted[number - 1] = whole.predicted;
    const Eigen::MatrixXd left = leftOfHeldOut(Data, whole, training);
    After(Eigen::all, heldOut) = left(Eigen::all, heldOut);
    Steps("checked on samples left out", 1.0);
  }

  // What the effects leave of samples held out shows the noise better.
  void learnNoise()
  {
    if (Noise.unknown)
    {
      Data.variance = Data.variance.cwiseMin(unknownVariance(Data, After) + Integration);
      TakenForNoise = measuredOnly(Data, Data.variance - Integration).sum();
    }
    Rest = shareOverAxes(Data, After);
    const bool predicts = Rest.heldOutResidual.squaredNorm() < After.squaredNorm();
    const Eigen::MatrixXd& left = predicts ? Rest.heldOutResidual : After;
    const double unpredicted = left.squaredNorm();
    Doubted = limitIntegration(Data, Integration, unpredicted);
    if (Capture.noise && Noise.degrees == 0.0)
    {
      const Eigen::MatrixXd modelled = readingVariance(Data, Noise.reading);
      Noise.excess = excessScatter(Data, left, modelled, Data.variance - modelled);
      Noise.unrepeated = Noise.excess > 1.0;
      Noise.reading.read *= Noise.excess;
      Noise.reading.shot *= Noise.excess;
      Data.variance += readingVariance(Data, Noise.reading) - modelled;
    }
    ReflectanceNoise = Options.reflectanceNoise.value_or(0.0);
    if (!Options.reflectanceNoise && !Noise.unknown)
    {
      ReflectanceNoise = reflectanceScatter(Data, After, unpredicted);
      const double known = measuredOnly(Data, Data.variance).sum();
      addReflectanceNoise(ReflectanceNoise);
      TakenForNoise = measuredOnly(Data, Data.variance).sum() - known;
    }
  }

  // Whether the causes found count, and what the report says of them.
  void judge(bool mixedUp)
  {
    const EffectFit best = Observed->whole(*Found.best);
    const ExcessNoise excess = excessNoise(Data, Noise, Capture.noise, Options.without);
    Evidence evidence = evidenceOf(best);
    const bool scatterAlone =
      evidence.credited == 0.0 && !evidence.gap && excess.energy > 0.0 && excess.belief == 0.0;
    evidence.gap = evidence.gap || scatterAlone;
    const double ofNoise = partOf(excess, Report.gap);
    evidence.explained = (1.0 - ofNoise) * evidence.explained + ofNoise * excess.belief;
    evidence.explained = mixedUp ? 0.0 : evidence.explained;
    evidence.takenForNoise = std::fmin(TakenForNoise / Before.squaredNorm(), 1.0);
    Predicted.back() = best.predicted;
    if (evidence.credited > 0.0)
    {
      Report.correction = found().simulated();
      Report.whiteAfterEffects = found().whiteAfterEffects();
    }
    else
    {
      After = Before;
      std::fill(Predicted.begin(), Predicted.end(), Data.simulated);
    }
    const std::vector<Explanation> explanations =
      conclude(Report, *Observed, Found, evidence, Options.seed);
    if (Report.verdict != GapVerdict::NoGap)
    {
      addRest(Report, Data, Predicted, Options, After);
      Report.nextCaptures =
        nextCaptures(*Observed, explanations, inQuestion(Report.causes), Options.seed);
    }
    if (scatterAlone)
    {
      Report.unexplained.where = whereOf(Noise);
    }
    addExcessNoise(Report, Data, Noise, excess);
    Report.notes = notesOn(Data, Capture, Noise, ReflectanceNoise, Report);
    const double nan = std::numeric_limits<double>::quiet_NaN();
    Report.gapBefore = Data.measured().select(Before, nan);
    Report.gapAfter = Data.measured().select(After, nan);
  }

  Evidence evidenceOf(const EffectFit& best)
  {
    Evidence evidence;
    if (best.set.size() > 0)
    {
      const double shrink = Report.gap.shrink;
      evidence.noticed = shrink > 0.0 ? noticed(Data, Before, After, Integration) : 0.0;
      if (shrink > 0.0 && (evidence.noticed > 1.0 || mostlyBesideSpectra()))
      {
        evidence.credited = evidence.explained = shrink;
        evidence.rest = Rest.axes;
        return evidence;
      }
      // All samples took part in the choice.
      const double alone = shrinkOf(Observed->energies(best));
      if (alone >= Decision::ExplainedShrink && inFewSamples(Data, best.predicted - Data.simulated))
      {
        Report.unconfirmed = true;
        evidence.credited = Decision::Unconfirmed * alone;
        evidence.explained = shrink;
        evidence.rest = Where.axes;
        return evidence;
      }
    }
    // What the axes predict; or what nothing predicts, but that neither noise nor sums over wavelength make.
    evidence.gap = (predictable(Data, Before, Where) &&
                     Where.predictable > negligibleEnergy(Data, After, Integration)) ||
      Report.gap.rmsBefore >
        Decision::BeyondNoise * std::hypot(Report.gap.noiseFloor, std::sqrt(Doubted));
    return evidence;
  }

  // Whether causes that errors of the sums over wavelength do not look like take most of the gap's energy alone.
  bool mostlyBesideSpectra() const
  {
    std::size_t others = 0;
    for (std::size_t p = 0; p < found().size(); ++p)
    {
      others |= actsOnSpectra(found().choices[p]) ? 0 : std::size_t(1) << p;
    }
    const EffectFit fit = Observed->whole(*Observed->reduced(*Found.best, others));
    return measuredOnly(Data, Data.observed - fit.predicted).squaredNorm() <
      0.5 * Before.squaredNorm();
  }

  const EffectSet& found() const { return static_cast<const SampleFit&>(*Found.best).effects; }

  void addReflectanceNoise(double deviation)
  {
    Data.variance.colwise() += deviation * deviation * reflectanceErrorGain(Data.camera);
  }

  const GapCapture& Capture;
  const GapOptions& Options;
  GapData Data;
  NoiseFinding Noise;
  Eigen::MatrixXd Integration;   // variance of errors of the sums over wavelength
  Eigen::MatrixXd Before, After; // real minus simulated; with the causes, of samples held out
  std::vector<Eigen::MatrixXd> Predicted; // of each fold, and last by all samples
  std::vector<EffectChoice> Choices;
  std::optional<SampleObservation> Observed;
  FoundSets Found;
  AxisShares Where, Rest;
  IndexList Odd;        // elements
  double Doubted = 0.0; // variance that sums over wavelength were taken to have and do not
  double ReflectanceNoise = 0.0;
  double TakenForNoise = 0.0; // energy of an error of each sample that only what is left shows
  GapReport Report;
  Progress Steps;
};
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
  GapCapture good = capture;
  const std::vector<OddReading> oddReadings = leaveOutOddReadings(good, options);
  IndexList leftOut;
  MixUp mixedUp;
  std::optional<TableDiagnosis> last;
  const auto diagnose = [&](IndexList& odd, bool unlessOdd)
  {
    leftOut.insert(leftOut.end(), odd.begin(), odd.end());
    std::sort(leftOut.begin(), leftOut.end());
    last.emplace(good, options, leftOut);
    mixedUp = leftOut.empty() ? mixUpOf(last->data()) : mixedUp;
    std::optional<GapReport> report = last->run(unlessOdd, mixedUp.ofAll);
    odd = last->odd();
    return report;
  };
  std::optional<GapReport> report = diagnoseWithoutOdd(
    diagnose, [](GapReport& one) -> GapReport& { return one; },
    [&] { return oddElementsNote(last->data(), ", without which there is no gap"); });
  if (report && !oddReadings.empty())
  {
    report->notes.insert(report->notes.begin(), oddReadingsNote(good, oddReadings));
  }
  if (report && !mixedUp.question.empty())
  {
    report->notes.insert(report->notes.begin(), mixedUp.question);
  }
  return report;
}

} // namespace msi
