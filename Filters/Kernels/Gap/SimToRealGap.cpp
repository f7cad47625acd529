#include "Kernels/Gap/SimToRealGap.h"

#include "Kernels/Gap/EffectSearch.h"
#include "Kernels/Gap/GapAxes.h"
#include "Kernels/Gap/GapCauses.h"
#include "Kernels/Gap/GapData.h"
#include "Kernels/Gap/GapNoise.h"
#include "Kernels/Gap/GapNotes.h"
#include "Kernels/Gap/HeldOut.h"
#include "Kernels/Gap/OrderBreaks.h"
#include "Kernels/Gap/ResidualScatter.h"
#include "Kernels/Gap/SeparatingCapture.h"
#include "Kernels/Gap/Shrink.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>

namespace msi
{

namespace
{
constexpr double ExplainedShrink = 0.85;
constexpr double DoubtfulRest = 0.05;   // of the gap's size
constexpr double ExplainedShare = 0.7;  // of the causes together
constexpr double NegligiblePart = 0.25; // of what is left
constexpr double PartlyShrink = 0.25;
constexpr double PredictableDeviations = 4.0;
constexpr double PredictablePart = 0.1; // of the noise energy
constexpr double UnpredictableFactor = 1.3;
constexpr int MostChangePoints = 6;

// Progress over jobs that may run on several threads.
class Progress
{
public:
  Progress(const GapOptions& options, double steps)
    : Report(options.progress)
    , Exclusive(options.exclusive)
    , Steps(steps)
  {
  }
  bool stopped() const
  {
    bool now = false;
    alone([&] { now = Stopped; });
    return now;
  }
  void step(const char* what, double count = 1.0)
  {
    alone(
      [&]
      {
        Done += count;
        ask(what);
      });
  }
  bool ask()
  {
    bool now = false;
    alone(
      [&]
      {
        ask("searching for effects");
        now = Stopped;
      });
    return now;
  }

private:
  void alone(const std::function<void()>& body) const
  {
    if (Exclusive)
    {
      Exclusive(body);
    }
    else
    {
      body();
    }
  }
  void ask(const char* what)
  {
    if (Report && !Stopped && !Report(std::fmin(Done / Steps, 1.0), what))
    {
      Stopped = true;
    }
  }
  std::function<bool(double, const char*)> Report;
  std::function<void(const std::function<void()>&)> Exclusive;
  bool Stopped = false;
  double Done = 0.0;
  double Steps;
};

Eigen::MatrixXd measuredOnly(const GapData& data, const Eigen::MatrixXd& values)
{
  return (data.count.array() > 0.0).select(values, 0.0);
}

double meanOverMeasured(const GapData& data, const Eigen::MatrixXd& values)
{
  return measuredOnly(data, values).sum() / static_cast<double>(data.elements);
}

// Without noise model and repeats: per channel what no basis predicts is noise.
void setUnknownNoise(GapData& data)
{
  data.variance = Eigen::MatrixXd::Zero(data.channels(), data.samples());
  const Eigen::MatrixXd residual =
    shareOverAxes(data, measuredOnly(data, data.observed - data.simulated), false).heldOutResidual;
  for (Eigen::Index k = 0; k < data.channels(); ++k)
  {
    std::vector<double> size;
    for (Eigen::Index i = 0; i < data.samples(); ++i)
    {
      if (data.count(k, i) > 0.0)
      {
        size.push_back(std::fabs(residual(k, i)));
      }
    }
    if (!size.empty())
    {
      const auto middle = size.begin() + static_cast<std::ptrdiff_t>(size.size() / 2);
      std::nth_element(size.begin(), middle, size.end());
      data.variance.row(k).setConstant(std::pow(1.4826 * *middle, 2) + 1e-12);
    }
  }
}

// The error of the sums over wavelength is estimated from their steps and may be too large: where less is left than
// it allows, only as much of it stays in the variance as what is left shows. Returns the mean variance taken away.
double limitIntegration(GapData& data, const Eigen::MatrixXd& integration, double unpredicted)
{
  const double allowed = measuredOnly(data, integration).sum();
  const double other = measuredOnly(data, data.variance).sum() - allowed;
  double kept = 1.0;
  if (allowed > 0.0)
  {
    kept = std::fmin(std::fmax((unpredicted - other) / allowed, 0.0), 1.0);
    data.variance -= (1.0 - kept) * integration;
  }
  return (1.0 - kept) * allowed / static_cast<double>(data.elements);
}

// Per-sample energies before and after, and what noise allows.
SampleEnergies energiesOf(
  const GapData& data, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after)
{
  SampleEnergies energies;
  for (Eigen::Index i = 0; i < data.samples(); ++i)
  {
    if (data.usable[static_cast<std::size_t>(i)] != 0)
    {
      energies.before.push_back(before.col(i).squaredNorm());
      energies.after.push_back(after.col(i).squaredNorm());
      energies.noise.push_back(
        (data.count.col(i).array() > 0.0).select(data.variance.col(i), 0.0).sum());
    }
  }
  return energies;
}

GapFigures figuresOf(const GapData& data, const SampleEnergies& energies, std::uint64_t seed)
{
  double before = 0.0;
  double after = 0.0;
  double noise = 0.0;
  const std::size_t count = energies.before.size();
  for (std::size_t i = 0; i < count; ++i)
  {
    before += energies.before[i];
    after += energies.after[i];
    noise += energies.noise[i];
  }
  GapFigures figures;
  const auto elements = static_cast<double>(data.elements);
  figures.rmsBefore = std::sqrt(before / elements);
  figures.rmsAfter = std::sqrt(after / elements);
  figures.noiseFloor = std::sqrt(noise / elements);
  figures.shrink = shrinkOf(before, after, noise);
  figures.shrinkInterval = shrinkInterval(energies, seed);
  figures.shrinkInterval[0] = std::fmin(figures.shrinkInterval[0], figures.shrink);
  figures.shrinkInterval[1] = std::fmax(figures.shrinkInterval[1], figures.shrink);
  return figures;
}

// Whether the bases predict held-out samples: their gain in energy, sample by sample, against its own error.
bool predictable(const GapData& data, const Eigen::MatrixXd& gap, const AxisShares& shares)
{
  double sum = 0.0;
  double square = 0.0;
  double samples = 0.0;
  for (Eigen::Index i = 0; i < data.samples(); ++i)
  {
    if (data.usable[static_cast<std::size_t>(i)] != 0)
    {
      const double gain = gap.col(i).squaredNorm() - shares.heldOutResidual.col(i).squaredNorm();
      sum += gain;
      square += gain * gain;
      samples += 1.0;
    }
  }
  const double error = std::sqrt(std::fmax(square - sum * sum / samples, 0.0));
  const double noise = measuredOnly(data, data.variance).sum();
  return sum > PredictableDeviations * error && sum > PredictablePart * noise;
}

// A gap that nothing predicts but that noise, with the largest reflectance noise allowed for, does not make.
// integration: further variance that sums over wavelength may make.
bool beyondNoise(const GapFigures& gap, double integration)
{
  return gap.rmsBefore >
    UnpredictableFactor * std::sqrt(gap.noiseFloor * gap.noiseFloor + integration);
}

std::string whereIs(const AxisShares& shares)
{
  if (shares.axes.empty())
  {
    return "no axis stands out";
  }
  const GapAxis& axis = shares.axes.front();
  return axis.axis + (axis.worst.empty() ? "" : " " + axis.worst.front().cell);
}
}

const char* nameOf(GapVerdict verdict) noexcept
{
  switch (verdict)
  {
    case GapVerdict::NoGap:
      return "no gap";
    case GapVerdict::Explained:
      return "explained";
    case GapVerdict::PartlyExplained:
      return "partly explained";
    case GapVerdict::Unexplained:
      break;
  }
  return "unexplained";
}

std::optional<GapReport> diagnoseGap(const GapCapture& capture, const GapOptions& options)
{
  for (const std::string& name : options.without)
  {
    if (findEffect(name) == nullptr)
    {
      throw std::invalid_argument("there is no effect '" + name + "' to leave out");
    }
  }
  GapData data = prepareGapData(capture, options);
  NoiseFinding noise = findNoise(data, capture.noise);
  if (noise.unknown)
  {
    setUnknownNoise(data);
  }
  else
  {
    data.variance = readingVariance(data, noise.reading);
  }
  const Eigen::MatrixXd integration = integrationVariance(data, capture.wavelengths);
  data.variance += integration;
  if (options.reflectanceNoise)
  {
    data.variance.colwise() +=
      *options.reflectanceNoise * *options.reflectanceNoise * reflectanceErrorGain(data.camera);
  }
  setWeights(data);

  GapReport report;
  const Eigen::MatrixXd before = measuredOnly(data, data.observed - data.simulated);
  Progress progress(options, data.folds + 4.0);
  const std::vector<EffectChoice> choices = choicesFor(data.scene, options.without);
  const EffectFitter fitter(data, data.usable, options.seed);
  SearchResult found;
  Eigen::MatrixXd after = before;
  const auto stop = [&progress] { return progress.ask(); };
  const auto job = [&](int number)
  {
    if (number == 0)
    {
      SearchLimits limits;
      limits.maximumEffects = options.maximumCauses;
      found = searchEffects(fitter, choices, limits, stop);
      progress.step("effects found", 2.0);
      return;
    }
    std::vector<char> training = data.usable;
    for (std::size_t i = 0; i < training.size(); ++i)
    {
      training[i] = training[i] != 0 && data.fold[i] != number - 1 ? 1 : 0;
    }
    const EffectFitter fold(data, training, options.seed + static_cast<std::uint64_t>(number));
    SearchLimits limits;
    limits.maximumEffects = options.maximumCauses;
    limits.width = 2;
    limits.fullFits = 7;
    const SearchResult result = searchEffects(fold, choices, limits, stop);
    const Eigen::MatrixXd left = leftOfHeldOut(data, result.best, training);
    for (Eigen::Index i = 0; i < data.samples(); ++i)
    {
      if (data.fold[static_cast<std::size_t>(i)] == number - 1)
      {
        after.col(i) = left.col(i);
      }
    }
    progress.step("checked on samples left out");
  };
  if (options.parallelFor)
  {
    options.parallelFor(data.folds + 1, job);
  }
  else
  {
    for (int number = 0; number <= data.folds && !progress.stopped(); ++number)
    {
      job(number);
    }
  }
  if (progress.stopped())
  {
    return std::nullopt;
  }

  const AxisShares rest = shareOverAxes(data, after, true);
  const double unpredicted = std::fmin(after.squaredNorm(), rest.heldOutResidual.squaredNorm());
  const double doubted = limitIntegration(data, integration, unpredicted);
  if (capture.noise && noise.degrees == 0.0)
  {
    noise.excess = excessScatter(
      data, after, *capture.noise, data.variance - readingVariance(data, *capture.noise));
    noise.unrepeated = noise.excess > 1.0;
    const Eigen::MatrixXd modelled = readingVariance(data, noise.reading);
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
  report.gap = figuresOf(data, energiesOf(data, before, after), options.seed);
  const AxisShares where = shareOverAxes(data, before, true);
  report.where = where.axes;
  report.changePoints = OrderBreaks::significant(fitter, data.simulated, MostChangePoints);
  progress.step("axes shared");

  const double explained = meanOverMeasured(data, before.array().square().matrix()) -
    meanOverMeasured(data, after.array().square().matrix());
  // A change this small is not told apart from errors of sums over wavelength and of reflectance.
  const double negligible = std::fmax(2.0 * meanOverMeasured(data, integration),
    NegligiblePart * meanOverMeasured(data, after.array().square().matrix()));
  if (found.best.set.size() > 0 && explained > negligible && report.gap.shrink > 0.0)
  {
    // What is left has a cause that is not known, and may overlap with those found by as much as its own size: of what
    // they do, only that part is certain.
    const double shrink = report.gap.shrink;
    const double certain = shrink * std::fmax(2.0 * shrink - 1.0, 0.0);
    // Wrong causes that cancel one another mimic one that is not known, but not to the last; right ones may cancel and
    // leave nothing.
    const double left = 1.0 - report.gap.shrinkInterval[1];
    const double doubt = std::fmin(std::fmax(left / DoubtfulRest, 0.0), 1.0);
    report.causes = describeCauses(fitter, found, choices, certain, doubt);
    report.uncredited = takeUncredited(report.causes);
    report.correction = found.best.set.simulated();
    report.whiteAfterEffects = found.best.set.whiteAfterEffects();
    double share = 0.0;
    for (const GapCause& cause : report.causes)
    {
      share += cause.share;
    }
    report.unexplained.share = std::fmin(std::fmax(1.0 - share, 0.0), 1.0);
    report.verdict = shrink >= ExplainedShrink && share >= ExplainedShare ? GapVerdict::Explained
      : shrink >= PartlyShrink && !report.causes.empty() ? GapVerdict::PartlyExplained
                                                         : GapVerdict::Unexplained;
    report.unexplained.where = report.unexplained.share > 0.0 ? whereIs(rest) : "";
  }
  else if ((predictable(data, before, where) &&
             where.predictable > negligible * static_cast<double>(data.elements)) ||
    beyondNoise(report.gap, doubted))
  {
    report.verdict = GapVerdict::Unexplained;
    report.unexplained = { 1.0, whereIs(where) };
  }
  if (report.verdict == GapVerdict::NoGap)
  {
    report.gap.rmsAfter = report.gap.rmsBefore;
    report.gap.shrink = 0.0;
    report.gap.shrinkInterval = { 0.0, 0.0 };
    after = before;
  }
  report.candidates = describeCandidates(fitter, found, options.seed);
  addExcessNoise(report, data, noise, capture.noise, options.without);
  for (const GapCause& cause : report.causes)
  {
    if (!cause.equivalent.empty() && !report.nextCapture)
    {
      GapNextCapture next{ separatingCapture(cause.effect), { cause.effect } };
      next.separates.insert(next.separates.end(), cause.equivalent.begin(), cause.equivalent.end());
      report.nextCapture = std::move(next);
    }
  }
  report.notes = notesOn(data, capture, noise, reflectanceNoise, report);
  const double nan = std::numeric_limits<double>::quiet_NaN();
  report.gapBefore = (data.count.array() > 0.0).select(before, nan);
  report.gapAfter = (data.count.array() > 0.0).select(after, nan);
  progress.step("done", 10.0);
  return report;
}

} // namespace msi
