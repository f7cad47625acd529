#include "Kernels/Gap/Samples/GapNotes.h"

#include "Kernels/Doubts/MixUps.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Gap/Samples/EffectSet.h"
#include "Kernels/Gap/Samples/GapEvidence.h"
#include "Kernels/Spectra/Counted.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <set>

namespace msi
{

namespace
{
constexpr double ClippedReadings = 0.01; // of all at the largest value
constexpr double FarFromWhite = 2.0;     // factor
constexpr double OtherUnits = 0.25;      // of the gap's energy left in the readings' units
constexpr double FarBelowModel = 0.5;    // scatter of the repeats

// By more than chance, of a root mean square of all elements.
bool isSmallerThan(const GapData& data, const CameraNoise& noise, double rms)
{
  const double ratio = rms * rms / measuredOnly(data, readingVariance(data, noise)).sum() *
    static_cast<double>(data.elements);
  return ratio * Decision::BeyondNoise * Decision::BeyondNoise < 1.0 &&
    1.0 - ratio > Decision::SureDeviations * std::sqrt(2.0 / static_cast<double>(data.elements));
}

void noteNoise(std::vector<std::string>& notes, const GapData& data, const GapCapture& capture,
  const NoiseFinding& noise, double reflectanceNoise, const GapReport& report)
{
  if (noise.unknown)
  {
    notes.push_back(textOf(3,
      "Noise? No noise model and one reading a sample: what no effect and no axis predicts, ",
      report.gap.noiseFloor,
      " of white, is taken for noise, but may be something else. A second reading of each sample "
      "would tell."));
  }
  else if (!capture.noise)
  {
    notes.push_back(textOf(3, "The noise comes from the repeats: read ", noise.reading.read,
      ", shot ", noise.reading.shot, ", relative to white."));
  }
  else if (noise.unrepeated)
  {
    notes.push_back(textOf(3, "One reading a sample, and what is left scatters ", noise.excess,
      " times as much as the noise model allows: noise, or an error of its own of each sample. "
      "A second reading of each would tell."));
  }
  else if (noise.shown < FarBelowModel && noise.excessDeviations < -Decision::SureDeviations)
  {
    notes.push_back(textOf(3, "Noise? The repeats scatter ", noise.shown,
      " times as much as the noise model says. Where it is too large, causes stay hidden: "
      "without it (null) the noise is that of the repeats."));
  }
  else if (isSmallerThan(data, noise.reading, report.gap.rmsBefore))
  {
    notes.emplace_back("Noise? The gap is smaller than the noise model says noise is: the model "
                       "looks too large, and causes stay hidden. Without it (null) the noise is "
                       "what nothing predicts.");
  }
  else if (noise.degrees < 4.0)
  {
    notes.push_back("One reading a sample: the noise model could not be checked.");
  }
  const double rounding =
    std::sqrt(data.step.squaredNorm() / 12.0 / static_cast<double>(data.channels()));
  if (rounding * rounding * static_cast<double>(data.elements) >
    Decision::SmallPart * measuredOnly(data, data.variance).sum())
  {
    notes.push_back(textOf(3, "The readings are rounded, to steps of ", data.step.maxCoeff(),
      ": the error by it, ", rounding, " of white, is taken for noise."));
  }
  if (reflectanceNoise > 1e-5) // instruments give four or five digits
  {
    notes.push_back(
      textOf(3, "The measured reflectances are taken to scatter by ", reflectanceNoise, "."));
  }
}

// "illumination gradient, vignetting and local stray light"
std::string namesOf(EffectNeed need)
{
  std::vector<std::string> names;
  for (const EffectDefinition& effect : effectLibrary())
  {
    if (effect.need == need)
    {
      names.push_back(effect.name);
      std::replace(names.back().begin(), names.back().end(), '_', ' ');
    }
  }
  return listed(names);
}

void noteUnknown(std::vector<std::string>& notes, const Eigen::ArrayXd& column, const char* what,
  const char* taken)
{
  const Eigen::Index unknown = column.size() - column.isFinite().count();
  if (unknown > 0)
  {
    notes.push_back(textOf(3, unknown, " of ", column.size(), " samples have no ", what,
      ": they are taken to be ", taken, "."));
  }
}

void noteScene(std::vector<std::string>& notes, const GapData& data, const SceneSamples& given)
{
  const SceneSamples& samples = data.scene.samples();
  if (samples.medium.empty())
  {
    notes.push_back("The samples name no medium: effects of one medium were not tried.");
  }
  else if (data.scene.media().size() == 1)
  {
    notes.push_back(
      "One medium only: an effect of the medium and one of the camera can look alike.");
  }
  if (const std::size_t single =
        data.scene.media().size() - mediaOfSeveralSamples(data.scene).size();
      single > 0)
  {
    notes.push_back(textOf(3, single, " of ", data.scene.media().size(),
      " media have one sample: effects of these media were not tried."));
  }
  if (!data.scene.hasPositions())
  {
    notes.push_back("No positions: " + namesOf(EffectNeed::Position) + " were not tried.");
  }
  else
  {
    noteUnknown(notes, given.x.array() + given.y.array(), "position", "in the middle of the field");
  }
  if (!data.scene.hasOrder())
  {
    notes.push_back("No capture order: " + namesOf(EffectNeed::Order) + " was not tried.");
  }
  else
  {
    noteUnknown(notes, given.order.array(), "capture order", "captured first");
  }
  if (data.scene.scenes().size() == 1)
  {
    notes.push_back("One scene only: veiling glare looks like a dark offset of each channel.");
  }
}

// Those of which nothing is left.
std::set<Eigen::Index> samplesLeftOut(const GapData& data)
{
  std::set<Eigen::Index> samples;
  for (const Eigen::Index element : data.leftOut)
  {
    if (!data.anyMeasured(element / data.channels()))
    {
      samples.insert(element / data.channels());
    }
  }
  return samples;
}

void noteSamples(std::vector<std::string>& notes, const GapData& data, const GapReport& report)
{
  const Eigen::Index usable = data.usable.size();
  const Eigen::Index unusable =
    data.samples() - usable - static_cast<Eigen::Index>(samplesLeftOut(data).size());
  if (unusable > 0)
  {
    notes.push_back(textOf(3, unusable, " of ", data.samples(),
      " samples have no reading or no reflectance and were left out."));
  }
  std::size_t parameters = 0;
  for (const GapCause& cause : report.causes)
  {
    parameters += cause.parameters.size();
  }
  if (static_cast<std::size_t>(usable) < std::max<std::size_t>(parameters, 20))
  {
    notes.push_back(textOf(3, usable, " samples are few",
      parameters > 0 ? textOf(3, " for ", parameters, " parameters") : "",
      ": expect wide intervals."));
  }
  const Eigen::ArrayXXd r = data.scene.reflectance()(Eigen::all, data.usable);
  const Eigen::Array<double, 1, Eigen::Dynamic> mean = r.colwise().mean();
  const double spread = (r.rowwise() - mean).square().colwise().mean().sum();
  if (spread < 1e-4 * mean.square().sum())
  {
    notes.push_back(
      "The reflectances hardly change with wavelength: lamp, filters and channel gains "
      "cannot be told apart.");
  }
}

// Typical sizes, and effects that depend on the level, are those of responses relative to white.
void noteWhite(std::vector<std::string>& notes, const GapData& data, const GapReport& report)
{
  const Eigen::ArrayXd white = data.camera.whiteResponse();
  const auto energy = [&data](const Eigen::MatrixXd& simulated)
  { return measuredOnly(data, data.observed - simulated).squaredNorm(); };
  if (report.verdict != GapVerdict::NoGap && white.minCoeff() > 0.0 &&
    energy(data.simulated.array().colwise() / white) < OtherUnits * energy(data.simulated))
  {
    notes.push_back(textOf(3, "Units? The curves of the simulated camera give a perfect white ",
      white.minCoeff(), " to ", white.maxCoeff(),
      ", but the readings look relative to white, which is 1: divide each curve by what it gives a "
      "perfect white, the sum of its values."));
  }
  else if (const double mean = white.mean(); mean < 1.0 / FarFromWhite || mean > FarFromWhite)
  {
    notes.push_back(textOf(3, "The simulated camera answers ", mean,
      " to a perfect white; expected about 1: effects that depend on the level, as a curve of the "
      "detector, are then taken for "
      "others. Divide camera and responses by that."));
  }
}

void noteFit(std::vector<std::string>& notes, const CameraModel& camera)
{
  if (const auto fitted = fittedChannels(camera).count(); fitted > 0)
  {
    notes.push_back(textOf(3, fitted, " of ", camera.channelCount(),
      " channels have responsivities that are negative in part: they were fitted to samples, and "
      "filters that moved or became wider are hard to find with such a camera. Fit it with Camera "
      "Model Fit, which keeps responsivities positive."));
  }
}

void noteSaturation(std::vector<std::string>& notes, const GapData& data)
{
  const double top = data.observed.maxCoeff();
  const Eigen::Index equal =
    (data.measured() && data.observed.array() >= top - 1e-6 * std::fabs(top)).count();
  if (equal > 1 &&
    static_cast<double>(equal) > ClippedReadings * static_cast<double>(data.elements))
  {
    notes.push_back(textOf(3, equal, " readings share the largest value ", top,
      ": they look clipped and say little about any other effect."));
  }
}

std::string elementName(const std::vector<std::string>& channels,
  const std::vector<std::string>& samples, Eigen::Index channel, Eigen::Index sample)
{
  return channels[channel] + " of " + samples[sample];
}
}

ExcessNoise excessNoise(const GapData& data, const NoiseFinding& noise,
  const std::optional<CameraNoise>& given, const std::vector<std::string>& without)
{
  if (!given || noise.excess <= 1.0)
  {
    return {};
  }
  const Eigen::MatrixXd beyond =
    readingVariance(data, noise.reading) - readingVariance(data, *given);
  const bool barred =
    std::find(without.begin(), without.end(), effectOf(EffectStage::Noise).name) != without.end();
  return { measuredOnly(data, beyond).sum() / static_cast<double>(data.elements),
    barred               ? 0.0
      : noise.unrepeated ? Decision::Unconfirmed
                         : 1.0 };
}

double partOf(const ExcessNoise& excess, const GapFigures& gap)
{
  // Sizes, not energies, as the shares of causes.
  const double size = std::sqrt(std::fmax(excess.energy, 0.0));
  const double other =
    std::sqrt(std::fmax(gap.rmsBefore * gap.rmsBefore - gap.noiseFloor * gap.noiseFloor, 0.0));
  return size > 0.0 ? size / (size + other) : 0.0;
}

std::string whereOf(const NoiseFinding& noise)
{
  return textOf(3, noise.unrepeated ? "scatter, " : "scatter between repeats, ", noise.excess,
    " times what the noise model allows");
}

void addExcessNoise(
  GapReport& report, const GapData& data, const NoiseFinding& noise, const ExcessNoise& excess)
{
  if (excess.belief == 0.0)
  {
    return;
  }
  const EffectDefinition& effect = effectOf(EffectStage::Noise);
  GapCause cause;
  cause.effect = effect.name;
  cause.form = effect.forms.front().name;
  const EffectParameter& factor = effect.forms.front().parameters.front();
  cause.parameters.push_back({ factor.name, noise.excess, factor.unit,
    noise.excess /
      std::sqrt(2.0 * (noise.unrepeated ? static_cast<double>(data.elements) : noise.degrees)) });
  if (report.verdict == GapVerdict::NoGap)
  {
    // The gap is what the given model does not allow; with the effect in the simulator it does.
    const double before2 = report.gap.rmsBefore * report.gap.rmsBefore;
    const double expected2 =
      std::fmax(report.gap.noiseFloor * report.gap.noiseFloor - excess.energy, 0.0);
    cause.share = 1.0;
    report.verdict = GapVerdict::Explained;
    report.gap.noiseFloor = std::sqrt(expected2);
    report.gap.rmsAfter = std::sqrt(std::fmax(before2 - excess.energy, expected2));
    report.gap.shrink = before2 > expected2
      ? 1.0 - std::sqrt(std::fmax(before2 - excess.energy - expected2, 0.0) / (before2 - expected2))
      : 1.0;
    cause.shrink = report.gap.shrink;
    report.gap.shrinkInterval = { std::fmin(report.gap.shrink, 0.0), 1.0 };
    if (noise.unrepeated)
    {
      report.verdict = GapVerdict::PartlyExplained;
      report.unexplained.where = "scatter of single readings";
    }
  }
  else
  {
    const double part = partOf(excess, report.gap);
    cause.share = part;
    for (GapCause& other : report.causes)
    {
      other.share *= 1.0 - part;
    }
    report.unexplained.share *= 1.0 - part;
  }
  std::vector<std::pair<std::string, double>> beliefs = report.probabilities;
  for (auto& [name, probability] : beliefs)
  {
    if (name == "unknown" && report.causes.empty())
    {
      probability = std::fmax(probability, 1.0 - excess.belief);
    }
    probability = name == "nothing" ? 0.0 : probability;
  }
  beliefs.emplace_back(cause.effect, excess.belief);
  report.correction.push_back(
    { cause.effect, cause.form, "", { std::fmin(noise.excess, factor.upper) } });
  report.causes.push_back(std::move(cause));
  sortCauses(report.causes);
  believe(report, std::move(beliefs));
}

MixUp mixUpOf(const GapData& data)
{
  const double none = std::numeric_limits<double>::quiet_NaN();
  const std::vector<Arrangement> arrangements = data.scene.hasPositions()
    ? arrangementsOf(data.samples(), data.scene.fieldX(), data.scene.fieldY())
    : arrangementsOf(data.samples());
  return mixUp(data.measured().select(data.observed, none), data.simulated, arrangements,
    data.camera.channels(), data.names);
}

std::string oddElementsNote(const GapData& data, const std::string& consequence)
{
  std::vector<std::string> samples, values;
  for (const Eigen::Index sample : samplesLeftOut(data))
  {
    samples.push_back(data.names[sample]);
  }
  for (const Eigen::Index element : data.leftOut)
  {
    const Eigen::Index sample = element / data.channels();
    if (data.anyMeasured(sample))
    {
      values.push_back(
        elementName(data.camera.channels(), data.names, element % data.channels(), sample));
    }
  }
  std::string text = "Odd? ";
  if (!samples.empty())
  {
    text += textOf(3, listed(samples), " (", samples.size(), " of ", data.samples(), " samples)");
  }
  if (!values.empty())
  {
    text += textOf(3, samples.empty() ? "" : "; ", listedFew(values), " (", values.size(), " of ",
      data.observed.size(), " values)");
  }
  return text + consequence +
    ": far from what is found in all others. Look at label, patch and readings.";
}

std::string oddReadingsNote(const GapCapture& capture, const std::vector<OddReading>& readings)
{
  const std::vector<std::string> samples = sampleNames(capture);
  std::vector<std::string> names;
  names.reserve(readings.size());
  for (const OddReading& odd : readings)
  {
    names.push_back(elementName(capture.camera.channels(), samples, odd.channel, odd.sample));
  }
  return textOf(3, "Odd? A reading of ", listedFew(names), " (", readings.size(), " of ",
    capture.readings.size(),
    " readings) left out: far from other readings of the same sample. Look at them.");
}

std::vector<std::string> notesOn(const GapData& data, const GapCapture& capture,
  const NoiseFinding& noise, double reflectanceNoise, const GapReport& report)
{
  std::vector<std::string> notes;
  if (!data.leftOut.empty())
  {
    notes.push_back(oddElementsNote(data, " left out"));
  }
  noteNoise(notes, data, capture, noise, reflectanceNoise, report);
  noteScene(notes, data, capture.samples);
  noteSamples(notes, data, report);
  noteWhite(notes, data, report);
  noteFit(notes, data.camera);
  noteSaturation(notes, data);
  noteDoubts(notes, report);
  return notes;
}

} // namespace msi
