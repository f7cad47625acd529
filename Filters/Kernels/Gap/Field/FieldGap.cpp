#include "Kernels/Gap/Field/FieldGap.h"

#include "Kernels/Gap/Field/FieldBanding.h"
#include "Kernels/Gap/Field/FieldDecisions.h"
#include "Kernels/Gap/Field/FieldEffects.h"
#include "Kernels/Gap/Field/FieldGroups.h"
#include "Kernels/Gap/Field/FieldHypothesis.h"
#include "Kernels/Gap/Field/FieldReport.h"
#include "Kernels/Gap/Field/FieldSearch.h"
#include "Kernels/Gap/Field/FieldWhere.h"
#include "Kernels/Gap/GapCertainty.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Gap/Shrink.h"

#include <algorithm>
#include <cmath>
#include <sstream>

namespace msi
{

namespace
{
constexpr double FewUsable = 0.5;

struct TestEnergies
{
  SampleEnergies samples; // a group of blocks is a sample
  double elements = 0.0;
};

TestEnergies energiesOf(const FieldData& data, const FieldSearchResult& found)
{
  TestEnergies energies;
  const auto count = static_cast<Eigen::Index>(data.blocks.size());
  Eigen::VectorXd before = Eigen::VectorXd::Zero(count);
  Eigen::VectorXd after = before;
  Eigen::VectorXd noise = before;
  for (Eigen::Index b = 0; b < count; ++b)
  {
    const auto block = static_cast<std::size_t>(b);
    for (Eigen::Index k = 0; k < data.channels(); ++k)
    {
      before[b] += found.before.at(block, k).energy;
      after[b] += found.after.at(block, k).energy;
      noise[b] += found.after.at(block, k).noise;
      energies.elements += data.blocks[block].fold < 0 ? found.after.at(block, k).pixels : 0.0;
    }
  }
  energies.samples = { groupSums(data, before, false), groupSums(data, after, false),
    groupSums(data, noise, false) };
  return energies;
}

// Gains and offsets are what they are: no other formula of them leaves a rest. What they leave has another cause, and they
// may stand for a part of that.
bool areExact(const FieldSet& set)
{
  return std::all_of(set.begin(), set.end(),
    [](const FieldChoice* choice) { return choice->has(EffectTrait::Exact); });
}

std::vector<std::string> notesOn(
  const FieldData& data, const FieldSearchResult& found, const FieldSet& set)
{
  std::vector<std::string> notes;
  for (const std::string& effect : found.indistinct)
  {
    notes.push_back(effect +
      " cannot be decided: the simulated image has too few edges and too little texture in the "
      "usable pixels");
  }
  if ((data.unit != 1.0).any())
  {
    std::ostringstream text;
    text.precision(3);
    text << "the real image is not in units of white: its channels are ";
    const bool common = (data.unit == data.unit[0]).all();
    text << data.unit[0];
    for (Eigen::Index k = 1; !common && k < data.unit.size(); ++k)
    {
      text << ", " << data.unit[k];
    }
    text
      << " times the simulated ones; the figures are after division by that. A flat field or the "
         "response of a white brings them to 1 for a perfect white";
    notes.push_back(text.str());
  }
  if (data.usablePart < FewUsable)
  {
    std::ostringstream text;
    text << "only " << std::lround(100.0 * data.usablePart)
         << " % of the pixels can be used; the others have no value in one of the images, or none "
            "beside them in the simulated one";
    notes.push_back(text.str());
  }
  const bool hasTail =
    hasTerm(set, ImageParameter::TailFraction) || hasTerm(set, ImageParameter::SurroundFirst);
  if (!data.filled.empty() && hasTail)
  {
    notes.emplace_back("the surround of the usable pixels is partly not simulated; "
                       "local_stray_light takes it to be like its neighbours in the row");
  }
  for (const FieldChoice* choice : set)
  {
    if (isProfile(*choice))
    {
      std::ostringstream text;
      text << "the stripes of " << (isOfRows(*choice) ? "rows" : "columns")
           << " may have any shape in the corrected image; the list of effects has the three sines "
              "that come nearest, with "
           << std::lround(100.0 * bandingSines(*choice, found.after.model).part)
           << " % of their energy";
      notes.push_back(text.str());
    }
  }
  if ((hasTerm(set, ImageParameter::Falloff) && hasTerm(set, ImageParameter::GradientRight)) ||
    hasTerm(set, ImageParameter::CenterX))
  {
    notes.emplace_back("vignetting about a center off the middle looks like vignetting with "
                       "illumination_gradient; the chart rotated by 180 degrees separates them");
  }
  const bool hasGlare =
    hasTerm(set, ImageParameter::Glare) || hasTerm(set, ImageParameter::ConservingGlare);
  if (hasTerm(set, ImageParameter::Dark) != hasGlare)
  {
    notes.emplace_back("an offset of each channel may be dark_offset or veiling_glare: one image "
                       "cannot tell unless the offsets go with the channels' means");
  }
  return notes;
}
}

std::optional<FieldGap> diagnoseField(const FieldPair& pair, const GapOptions& options)
{
  const std::vector<FieldChoice> choices = fieldChoices(options.without);
  FieldLoop loop = options.parallelFor;
  if (!loop)
  {
    loop = [](int count, const std::function<void(int)>& body)
    {
      for (int i = 0; i < count; ++i)
      {
        body(i);
      }
    };
  }
  double done = 0.0;
  bool stopped = false;
  const auto say = [&](double fraction, const char* what)
  {
    done = fraction;
    stopped = stopped || (options.progress && !options.progress(done, what));
    return stopped;
  };
  say(0.0, "reading the images");
  const FieldData data = prepareFieldData(pair, options.seed, loop);
  if (say(0.2, "searching for effects"))
  {
    return std::nullopt;
  }
  const FieldSearchResult found = searchField(data, choices, options.maximumCauses, loop,
    [&] { return say(done + 0.5 * (0.9 - done) * 0.5, "searching for effects"); });
  if (stopped || say(0.9, "describing what was found"))
  {
    return std::nullopt;
  }

  std::optional<FieldGap> gap(std::in_place);
  gap->model = found.after.model;
  gap->unit = data.unit;
  GapReport& report = gap->report;
  const TestEnergies energies = energiesOf(data, found);
  report.gap = figuresOf(energies.samples, std::fmax(energies.elements, 1.0), options.seed);
  // The stripes that were found are an axis of the gap before, too.
  FieldModel nominal = found.before.model;
  nominal.rowPeriod = found.after.model.rowPeriod;
  nominal.columnPeriod = found.after.model.columnPeriod;
  nominal.rows = found.after.model.rows;
  nominal.columns = found.after.model.columns;
  report.where = fieldAxes(data, fieldStatistics(data, nominal, &found.weights, loop), loop);
  const std::vector<GapAxis> rest = fieldAxes(data, found.after, loop);
  const double left = blockMeanExcess(data, found.after, false);
  const double shrink = report.gap.shrink;
  const bool noiseAlone =
    report.gap.rmsAfter < ImageDecision::UnexplainedRms * report.gap.noiseFloor &&
    left < ImageDecision::ExplainedBlocks;
  // Effects that account for little are candidates, not causes.
  if (!found.set.empty() && (shrink >= PartlyShrink || (noiseAlone && shrink > 0.0)))
  {
    const double doubt = noiseAlone ? 0.0 : doubtOf(report.gap.shrinkInterval);
    const double certain = (noiseAlone ? shrink : certainPart(shrink)) *
      (areExact(found.set) ? 1.0 - ImageDecision::ExactDoubt * doubt : 1.0);
    const double share = creditCauses(report, fieldCauses(data, found, choices, certain, doubt));
    report.correction = fieldCorrection(found.set, found.after.model, pair.channels);
    // Of what a pair of images shrinks by, and not of the whole gap: its share is small where the shrink is uncertain.
    report.verdict = verdictOf(shrink, share / shrink, noiseAlone);
    report.unexplained.where = report.unexplained.share > 0.0 ? whereIs(rest) : "";
  }
  else
  {
    gap->model = found.before.model;
    const bool gapThere =
      report.gap.rmsBefore > ImageDecision::UnexplainedRms * report.gap.noiseFloor ||
      blockMeanExcess(data, found.before, false) > ImageDecision::UnexplainedBlocks;
    report.verdict = gapThere ? GapVerdict::Unexplained : GapVerdict::NoGap;
    if (gapThere)
    {
      report.unexplained.share = 1.0;
      report.unexplained.where = whereIs(report.where);
    }
    report.gap.rmsAfter = report.gap.rmsBefore;
    report.gap.shrink = 0.0;
    report.gap.shrinkInterval = { 0.0, 0.0 };
  }
  report.candidates = fieldCandidates(data, found, options.seed);
  recommendCapture(report);
  report.notes = notesOn(data, found, report.causes.empty() ? FieldSet() : found.set);
  noteUncredited(report.notes, report.uncredited);
  say(1.0, "done");
  return gap;
}

} // namespace msi
