#include "Kernels/Gap/Field/FieldGap.h"

#include "Kernels/Doubts/MixUps.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/FoundCauses.h"
#include "Kernels/Gap/Diagnosis/GapRegression.h"
#include "Kernels/Gap/Field/FieldEffects.h"
#include "Kernels/Gap/Field/FieldObservation.h"
#include "Kernels/Gap/Field/FieldOddPixels.h"
#include "Kernels/Gap/Field/FieldStarts.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Gap/WithoutOddOnes.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>
#include <memory>
#include <numeric>
#include <utility>

namespace msi
{

namespace
{
constexpr double FewUsable = 0.5;
constexpr double WorthTelling = 1e-5;     // of the values
constexpr double MostlyExplained = 0.5;   // of the gap
constexpr double MiddleLevel = 0.5;       // of white
constexpr double SharedByChannels = 0.25; // of the variance
constexpr int RasterSide = 32;            // on which an image is looked at as a whole

// Sets of an image pair that are kept on the way, and options fitted in full for each: previews are cross-validated and good.
constexpr int PairBeamWidth = 2;
constexpr int PairOptionsFitted = 3;

struct FieldFinding
{
  FieldWeights weights;
  std::unique_ptr<FieldObservation> observation;
  FoundSets found;

  const FieldHypothesis& hypothesis(const FitPointer& fit) const
  {
    return static_cast<const FieldObservedFit&>(*fit).hypothesis;
  }
  const FieldStatistics& before() const { return *hypothesis(found.nominal).statistics; }
  const FieldStatistics& after() const { return *hypothesis(found.best).statistics; }
  const FieldSet& set() const { return hypothesis(found.best).set; }
};

// A first, quick search says what is left, which shows the noise.
void search(FieldFinding& finding, const FieldData& data, const std::vector<FieldChoice>& choices,
  const std::vector<ImageDisplacement>& start, int maximumEffects,
  const std::function<bool()>& stop)
{
  const auto statisticsAt = [&](const FieldModel& model)
  {
    return fieldStatistics(data, model, nullptr,
      AskedSteps{ fieldColumns().step[fieldColumns().gain],
        fieldColumns().step[fieldColumns().offset], fieldColumns().step[fieldColumns().blur] });
  };
  finding.weights = fieldWeights(statisticsAt(FieldModel(data.channels())));
  const auto observe = [&]
  {
    finding.observation = std::make_unique<FieldObservation>(data, choices, finding.weights, start);
  };
  observe();
  SetSearchLimits limits{ maximumEffects, 1, 1, false };
  finding.found = searchSets(*finding.observation, limits, stop);
  // A limit from what is left would take the gap itself for outliers.
  finding.weights.noise = fieldNoise(finding.after());
  finding.weights.sceneNoise = sceneNoise(statisticsAt(finding.after().model));
  observe();
  limits.beamWidth = PairBeamWidth;
  limits.optionsFitted = PairOptionsFitted;
  limits.exchange = true;
  finding.found = searchSets(*finding.observation, limits, stop);
}

// On the test blocks; on all where nothing was fitted.
GapFigures figuresOn(const FieldData& data, bool all, const FieldStatistics& before,
  const FieldStatistics& after, std::uint64_t seed)
{
  const auto sums = [&](const FieldStatistics& statistics, double BlockSums::*number)
  {
    const Eigen::ArrayXd test = groupSums(data, statistics.ofBlocks(number), false);
    const Eigen::ArrayXd others = groupSums(data, statistics.ofBlocks(number), true);
    Eigen::ArrayXd values(test.size() + (all ? others.size() : 0));
    values << test, others.tail(values.size() - test.size());
    return values;
  };
  const Eigen::ArrayXd pixels = sums(after, &BlockSums::pixels);
  GroupEnergies energies(pixels.size(), 3);
  energies << sums(before, &BlockSums::energy), sums(after, &BlockSums::energy),
    sums(after, &BlockSums::noise);
  return figuresOf(energies, std::fmax(pixels.sum(), 1.0), seed);
}

// The regular part of what a model leaves.
CameraEffect regularPartOf(const FieldData& data, const FieldStatistics& left)
{
  const Eigen::Index count = remainderStep().step->width();
  std::vector<Eigen::Index> columns(count);
  std::iota(columns.begin(), columns.end(), remainderStep().column);
  columns.push_back(fieldColumns().residual);
  std::vector<ChannelNormals> products = FieldFitter(data, left).folds();
  for (ChannelNormals& fold : products)
  {
    for (Eigen::MatrixXd& channel : fold)
    {
      channel = channel(columns, columns).eval();
    }
  }
  return regularPart(products, data.pair.channels);
}

// Adds it, where it predicts test blocks.
void addRest(
  FieldGap& gap, const FieldData& data, const FieldWeights& weights, const GapOptions& options)
{
  const PlacedStep& step = remainderStep();
  const FieldStatistics left = fieldStatistics(data, gap.model, &weights, { &step });
  const CameraEffect effect = regularPartOf(data, left);
  FieldModel model = gap.model;
  const Eigen::Map<const Eigen::ArrayXXd> numbers(effect.parameters.data(), data.channels(),
    static_cast<Eigen::Index>(effect.parameters.size()) / data.channels());
  for (std::size_t n = 0; n < step.step->numbers.size(); ++n)
  {
    model[step.number + n] = numbers.col(n);
  }
  const FieldStatistics less = fieldStatistics(data, model, &weights, AskedSteps{});
  const GapFigures figures = figuresOn(data, false, left, less, options.seed);
  if (!(figures.shrinkInterval[0] > 0.0))
  {
    return;
  }
  gap.report.unexplained.rmsWithRest = figures.rmsAfter;
  if (options.addRest)
  {
    gap.model = std::move(model);
    gap.report.correction.push_back(effect);
  }
}

// Mean over test blocks (or all) and channels of the squared block mean of the residual over what noise allows.
double blockMeanExcess(const FieldData& data, bool all, const FieldStatistics& statistics)
{
  double sum = 0.0;
  double count = 0.0;
  for (Eigen::Index k = 0; k < data.channels(); ++k)
  {
    const double coherence = noiseCoherence(statistics, k);
    for (std::size_t b = 0; b < data.blocks.size(); ++b)
    {
      const BlockSums& sums = statistics.at(b, k);
      if ((all || data.blocks[b].fold < 0) && sums.pixels > 0.0)
      {
        sum += sums.mean * sums.mean * sums.pixels * sums.pixels / (sums.noise * coherence);
        count += 1.0;
      }
    }
  }
  return count > 0.0 ? sum / count : 0.0;
}

// Effects whose parameters this scene does not show.
std::vector<std::string> indistinctEffects(
  const FieldData& data, const FieldStatistics& statistics, const std::vector<FieldChoice>& choices)
{
  std::vector<std::string> found;
  for (const FieldChoice& choice : choices)
  {
    const std::string& name = choice.effect->name;
    if (!choice.has(EffectTrait::ActsOnEdges) ||
      std::find(found.begin(), found.end(), name) != found.end())
    {
      continue;
    }
    const ImageTerm& first = choice.terms.front();
    double information = 1e-30;
    for (Eigen::Index k = 0; k < data.channels(); ++k)
    {
      Eigen::VectorXd column = Eigen::VectorXd::Zero(fieldColumns().count);
      column.head(fieldColumns().residual) =
        columnsChanged(first.parameter, statistics.model, statistics.model, k);
      for (std::size_t b = 0; b < data.blocks.size(); ++b)
      {
        information += column.dot(statistics.at(b, k).normal() * column);
      }
    }
    if (Decision::SureDeviations / std::sqrt(information) > first.typical)
    {
      found.push_back(name);
    }
  }
  return found;
}

// Means over a raster, K x cells, row after row; NaN where a cell has no value.
Eigen::MatrixXd rasterOf(const FieldPair& pair, const float* image, int width, int height)
{
  const Eigen::Index K = pair.channels.size();
  Eigen::ArrayXXd sum = Eigen::ArrayXXd::Zero(K, Eigen::Index{ width } * height);
  Eigen::ArrayXXd count = sum;
  const auto visit = [&](int x, int y, Eigen::Index cell)
  {
    const float* values = image + pair.index(x, y) * K;
    for (Eigen::Index k = 0; k < K; ++k)
    {
      const bool known = std::isfinite(values[k]);
      sum(k, cell) += known ? static_cast<double>(values[k]) : 0.0;
      count(k, cell) += known ? 1.0 : 0.0;
    }
  };
  forPixels(pair, width, height, visit);
  return sum / count;
}

// together: that the images go together at all is known.
MixUp mixUpOf(const FieldData& data, bool together)
{
  const FieldPair& pair = data.pair;
  const int width = std::min(RasterSide, pair.extent.width);
  const int height = std::min(RasterSide, pair.extent.height);
  const Eigen::ArrayXd x = Eigen::ArrayXd::LinSpaced(width, 0.0, width - 1.0);
  const Eigen::ArrayXd y = Eigen::ArrayXd::LinSpaced(height, 0.0, height - 1.0);
  const std::vector<Arrangement> arrangements =
    turnedPlaces(x.replicate(height, 1), y.transpose().replicate(width, 1).reshaped());
  Eigen::MatrixXd real = rasterOf(pair, pair.real, width, height);
  real(data.dead, Eigen::all).setConstant(std::numeric_limits<double>::quiet_NaN());
  return mixUp(
    real, rasterOf(pair, pair.simulated, width, height), arrangements, pair.channels, {}, together);
}

// A tenth of the noise of both images, in some channel.
bool hasSceneNoise(const FieldWeights& weights)
{
  for (std::size_t k = 0; k < weights.noise.size(); ++k)
  {
    const double both = noiseVariance(weights.noise[k], MiddleLevel);
    if (weights.sceneNoise[k] > Decision::SmallPart * Decision::SmallPart * both)
    {
      return true;
    }
  }
  return false;
}

// Mean correlation of what two channels leave, from one pixel to the next.
double sharedNoise(const FieldData& data, const FieldModel& model)
{
  const std::vector<FieldResidual> residuals = fieldResiduals(data, model, true);
  const Eigen::Index K = data.channels();
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(K, K);
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    const ImageWindow& window = data.blocks[b].window;
    Eigen::ArrayXXd left =
      Eigen::ArrayXXd::Constant(window.pixels(), K, std::numeric_limits<double>::quiet_NaN());
    for (Eigen::Index k = 0; k < K; ++k)
    {
      const FieldResidual& residual = residuals[b * K + k];
      left.col(k)(residual.pixel) = residual.residual;
    }
    const Eigen::Index pairs = left.rows() - 1;
    const Eigen::ArrayXXd steps = left.bottomRows(pairs) - left.topRows(pairs);
    const Eigen::MatrixXd known = steps.isFinite().select(steps, 0.0);
    products += known.transpose() * known;
  }
  const Eigen::VectorXd deviation = products.diagonal().cwiseSqrt().cwiseMax(1e-30);
  const Eigen::MatrixXd correlation =
    deviation.cwiseInverse().asDiagonal() * products * deviation.cwiseInverse().asDiagonal();
  const double others = static_cast<double>(K * (K - 1));
  return K > 1 ? (correlation.sum() - correlation.trace()) / others : 0.0;
}

std::vector<std::string> notesOn(const FieldData& data, const FieldFinding& finding,
  const std::vector<FieldChoice>& choices, const std::string& mixedUp)
{
  std::vector<std::string> notes;
  for (std::string note :
    { deadChannelsNote(data.dead, data.pair.channels, ", and takes no part"), mixedUp })
  {
    if (!note.empty())
    {
      notes.push_back(std::move(note));
    }
  }
  if (!data.leftOut.empty())
  {
    notes.push_back(oddPixelsNote(data, " left out"));
  }
  if (data.pair.framePart > 0.0)
  {
    notes.push_back(textOf(2, "a frame of ", 100.0 * data.pair.framePart,
      " % of the pixels is 0 in all channels of one image, as registration leaves it, and takes no "
      "part"));
  }
  if (data.defectPart > WorthTelling)
  {
    notes.push_back(textOf(2, "in the real image ", 100.0 * data.defectPart,
      " % of the values looked at stand out from all of their neighbours, as those of hot and dead "
      "pixels do, and take no part"));
  }
  if (hasSceneNoise(finding.weights))
  {
    notes.push_back(textOf(2, "the simulated image has noise of its own, ",
      std::sqrt(finding.weights.sceneNoise.maxCoeff()),
      " of white; blur and stray light get no credit for taking it away"));
  }
  if (const double shared = sharedNoise(data, finding.after().model); shared > SharedByChannels)
  {
    notes.push_back(textOf(2, "Noise? ", 100.0 * shared,
      " % of what differs from pixel to pixel is the same in all channels, and counts as noise "
      "here: the gain of the pixels (no flat field), dust, compression, or detail that the "
      "simulated scene lacks. The mean of several captures tells it from noise"));
  }
  const FieldSet& set = finding.set();
  for (const std::string& effect : indistinctEffects(data, finding.before(), choices))
  {
    notes.push_back(effect +
      " cannot be decided: the simulated image has too few edges and too little texture in the "
      "usable pixels");
  }
  if ((data.unit != 1.0).any())
  {
    const bool common = (data.unit == data.unit[0]).all();
    std::string units = textOf(3, data.unit[0]);
    for (Eigen::Index k = 1; !common && k < data.unit.size(); ++k)
    {
      units += textOf(3, ", ", data.unit[k]);
    }
    notes.push_back("Units? The real image is not in units of white: its channels are " + units +
      " times the simulated ones; the figures are after division by that, and an exposure is told "
      "relative to it alone. A flat field or the response of a white brings the real image to 1 "
      "for a perfect white");
  }
  if (data.usablePart < FewUsable)
  {
    notes.push_back(textOf(3, "only ", std::lround(100.0 * data.usablePart),
      " % of the pixels can be used; the others have no value in one of the images, or none "
      "beside them in the simulated one"));
  }
  const bool hasTail = hasChoice(
    set, [](const FieldChoice& choice) { return choice.stage() == ImageStage::Surround; });
  if (!data.filled.empty() && hasTail)
  {
    notes.emplace_back("the surround of the usable pixels is partly not simulated; "
                       "local_stray_light takes it to be like its neighbours in the row");
  }
  for (const FieldChoice* choice : set)
  {
    if (isProfile(*choice))
    {
      notes.push_back(textOf(3, "the stripes of ", isOfRows(*choice) ? "rows" : "columns",
        " may have any shape in the corrected image; the list of effects has the three sines "
        "that come nearest, with ",
        std::lround(100.0 * bandingSines(*choice, finding.after().model).part),
        " % of their energy"));
    }
  }
  const auto isOfLens = [](const FieldChoice* choice)
  { return choice->stage() == ImageStage::Lens; };
  const bool offMiddle = hasChoice(set,
    [](const FieldChoice& choice)
    { return numberOf(choice.terms.back().parameter).pull == ImagePull::Itself; });
  if (offMiddle || std::count_if(set.begin(), set.end(), isOfLens) > 1)
  {
    notes.emplace_back("vignetting about a center off the middle looks like vignetting with "
                       "illumination_gradient; the chart rotated by 180 degrees separates them");
  }
  const bool hasGlare = hasChoice(set,
    [](const FieldChoice& choice)
    { return choice.stage() == ImageStage::Light && choice.step().from == nullptr; });
  const bool hasOffset = hasChoice(set,
    [](const FieldChoice& choice)
    { return numberOf(choice.terms.front().parameter).axes == ImageAxis::Channel; });
  if (hasOffset != hasGlare)
  {
    notes.emplace_back("an offset of each channel may be dark_offset or veiling_glare: one image "
                       "cannot tell unless the offsets go with the channels' means");
  }
  return notes;
}

// odd: the pixels that are, counted block after block; unchanged where it was stopped. unlessOdd: where some are goes no further than
// to find them.
std::optional<FieldGap> diagnose(const FieldData& data, const std::vector<FieldChoice>& choices,
  const std::vector<ImageDisplacement>& start, const GapOptions& options, IndexList& odd,
  bool unlessOdd)
{
  double done = 0.0;
  bool stopped = false;
  const auto say = [&](double fraction, const char* what)
  {
    done = fraction;
    stopped = stopped || (options.progress && !options.progress(done, what));
    return stopped;
  };
  if (say(0.2, "searching for effects"))
  {
    return std::nullopt;
  }
  FieldFinding finding;
  search(finding, data, choices, start, options.maximumCauses,
    [&] { return say(done + 0.25 * (0.9 - done), "searching for effects"); });
  if (stopped || say(0.9, "describing what was found"))
  {
    return std::nullopt;
  }
  odd = oddPixels(data, finding.weights, finding.before().model, finding.after().model);
  if (unlessOdd && !odd.empty())
  {
    return std::nullopt;
  }

  std::optional<FieldGap> gap(std::in_place);
  gap->model = finding.after().model;
  gap->unit = data.unit;
  GapReport& report = gap->report;
  report.gap =
    figuresOn(data, finding.set().empty(), finding.before(), finding.after(), options.seed);
  // The stripes and the end of the range that were found are on the axes of the gap before, too.
  FieldModel nominal = finding.before().model;
  nominal.rows = gap->model.rows;
  nominal.columns = gap->model.columns;
  nominal.take(gap->model, isShape);
  report.where =
    fieldAxes(data, fieldStatistics(data, nominal, &finding.weights), &finding.after().model);
  const auto beyondNoise = [&](double rms, const FieldStatistics& statistics)
  {
    return rms > Decision::BeyondNoise * report.gap.noiseFloor ||
      blockMeanExcess(data, finding.set().empty(), statistics) > Decision::EstimateFactor;
  };
  Evidence evidence;
  if (!finding.set().empty() && report.gap.shrink > 0.0)
  {
    evidence.credited = report.gap.shrink;
    evidence.explained =
      beyondNoise(report.gap.rmsAfter, finding.after()) ? report.gap.shrink : 1.0;
    evidence.rest = fieldAxes(data, finding.after());
    report.correction = fieldCorrection(finding.set(), gap->model, data.pair.channels);
  }
  else
  {
    evidence.gap = beyondNoise(report.gap.rmsBefore, finding.before()) || !data.dead.empty();
    evidence.noticed = finding.set().empty() ? 1.0 : 0.0;
    gap->model = finding.before().model;
  }
  const MixUp mixedUp = mixUpOf(data, report.gap.shrink > MostlyExplained);
  evidence.explained = mixedUp.ofAll ? 0.0 : evidence.explained;
  const std::vector<Explanation> explanations =
    conclude(report, *finding.observation, finding.found, evidence, options.seed);
  if (report.verdict != GapVerdict::NoGap)
  {
    addRest(*gap, data, finding.weights, options);
  }
  report.nextCaptures = separatingCaptures(explanations, inQuestion(report.causes));
  report.notes = notesOn(data, finding, choices, mixedUp.question);
  noteDoubts(report.notes, report);
  say(1.0, "done");
  return gap;
}
}

std::optional<FieldGap> diagnoseField(const FieldPair& pair, const GapOptions& options)
{
  const std::vector<FieldChoice> choices = fieldChoices(options.without);
  if (options.progress && !options.progress(0.0, "reading the images"))
  {
    return std::nullopt;
  }
  FieldData data = prepareFieldData(pair, options.seed,
    [&options](int count, const std::function<void(int)>& body) { options.forAll(count, body); });
  leaveOutDefects(data);
  const std::vector<ImageDisplacement> start = registrationStart(data);
  return diagnoseWithoutOdd(
    [&](IndexList& odd, bool unlessOdd)
    {
      leaveOut(data, std::exchange(odd, {}));
      return diagnose(data, choices, start, options, odd, unlessOdd);
    },
    [](FieldGap& gap) -> GapReport& { return gap.report; },
    [&] { return oddPixelsNote(data, ", without which there is no gap"); });
}

} // namespace msi
