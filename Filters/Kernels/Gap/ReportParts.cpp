#include "Kernels/Gap/ReportParts.h"

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Numerics/CounterRandom.h"

#include <algorithm>
#include <bitset>
#include <cmath>
#include <cstddef>
#include <numeric>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
constexpr std::size_t EquivalentNamed = 2;
constexpr std::size_t CellsNamed = 5;
constexpr double Alike = 1e-9; // shares
constexpr int Resamplings = 400;
constexpr std::uint32_t Stream = 72;

// The first axis and its worst cell.
std::string whereIs(const std::vector<GapAxis>& axes)
{
  if (axes.empty())
  {
    return "no axis stands out";
  }
  const GapAxis& axis = axes.front();
  if (axis.worst.empty())
  {
    return axis.axis;
  }
  const std::string& cell = axis.worst.front().cell;
  return cell.rfind(axis.axis, 0) == 0 ? cell : axis.axis + " " + cell;
}

// What a rest depends on, from its shares over the axes: GapRemainder::dependsOn.
std::vector<std::pair<std::string, double>> dependences(const std::vector<GapAxis>& axes)
{
  static const std::map<std::string, std::string> plain = { { "channel", "wavelength" },
    { "spectral_shape", "wavelength" }, { "edges", "neighbour" }, { "region", "position" },
    { "rows", "position" }, { "columns", "position" } };
  std::map<std::string, double> parts;
  for (const GapAxis& axis : axes)
  {
    const auto known = plain.find(axis.axis);
    parts[known == plain.end() ? axis.axis : known->second] += axis.share;
  }
  std::vector<std::pair<std::string, double>> sorted(parts.begin(), parts.end());
  std::stable_sort(
    sorted.begin(), sorted.end(), [](const auto& a, const auto& b) { return a.second > b.second; });
  return sorted;
}

// What a camera that was fitted as linear leaves of a detector's curve.
bool isOfLinearFit(const std::string& effect, const std::string& form)
{
  const EffectDefinition* known = findEffect(effect);
  const EffectForm* found = known == nullptr ? nullptr : findForm(*known, form);
  return found != nullptr && found->has(FormTrait::BesideLine);
}

bool isOfLinearFit(const GapCause& cause)
{
  return isOfLinearFit(cause.effect, cause.form);
}

bool isSmallErrorOfChannels(const GapCause& cause, double share)
{
  const EffectDefinition* effect = findEffect(cause.effect);
  return cause.perChannel && effect != nullptr && effect->stage != EffectStage::Image &&
    share <= Decision::LeastPartPerChannel;
}
}

double shrinkOf(const GroupEnergies& energies)
{
  const Eigen::Array3d sum = energies.colwise().sum();
  const double excess = sum[0] - sum[2];
  return excess > 0.0 ? std::fmax(1.0 - std::sqrt(std::fmax(sum[1] - sum[2], 0.0) / excess), -1.0)
                      : 0.0;
}

GapFigures figuresOf(const GroupEnergies& energies, double elements, std::uint64_t seed)
{
  const Eigen::Array3d rms = (energies.colwise().sum() / elements).sqrt();
  const double shrink = shrinkOf(energies);
  const auto [low, high] = shrinkInterval(energies, seed);
  return { rms[0], rms[1], rms[2], shrink, { std::fmin(low, shrink), std::fmax(high, shrink) } };
}

std::array<double, 2> shrinkInterval(const GroupEnergies& energies, std::uint64_t seed)
{
  const Eigen::Index count = energies.rows();
  if (count == 0)
  {
    return { 0.0, 0.0 };
  }
  const CounterRandom random(seed, Stream);
  std::vector<double> shrinks;
  GroupEnergies drawn(count, 3);
  for (int draw = 0; draw < Resamplings; ++draw)
  {
    for (Eigen::Index i = 0; i < count; ++i)
    {
      const double part = random.uniform(draw * count + i);
      const auto pick = static_cast<Eigen::Index>(part * static_cast<double>(count));
      drawn.row(i) = energies.row(std::min(pick, count - 1));
    }
    shrinks.push_back(shrinkOf(drawn));
  }
  std::sort(shrinks.begin(), shrinks.end());
  return { shrinks[Resamplings / 40], shrinks[Resamplings - 1 - Resamplings / 40] };
}

std::vector<double> shapleyValues(const std::vector<double>& value, std::size_t players)
{
  // (others)! (players - others - 1)! / players! for a coalition of so many others.
  const auto weight = [players](std::size_t others)
  {
    double part = 1.0 / static_cast<double>(players);
    for (std::size_t n = 1; n <= others; ++n)
    {
      part *= static_cast<double>(n) / static_cast<double>(players - n);
    }
    return part;
  };
  std::vector<double> share;
  for (std::size_t p = 0; p < players; ++p)
  {
    double sum = 0.0;
    for (std::size_t subset = 0; subset < value.size(); ++subset)
    {
      if ((subset >> p & 1U) == 0)
      {
        const std::size_t others = std::bitset<64>(subset).count();
        sum += weight(others) * (value[subset | std::size_t(1) << p] - value[subset]);
      }
    }
    share.push_back(sum);
  }
  return share;
}

std::vector<GapCell> GapCells::worst() const
{
  std::vector<GapCell> cells;
  for (const auto& [name, energy] : Energy)
  {
    if (energy > 0.0 && Total > 0.0)
    {
      cells.push_back({ name, std::fmin(energy / Total, 1.0) });
    }
  }
  std::stable_sort(cells.begin(), cells.end(),
    [](const GapCell& a, const GapCell& b) { return a.share > b.share; });
  cells.resize(std::min(cells.size(), CellsNamed));
  return cells;
}

std::string rangeText(const std::string& what, double low, double high, int digits)
{
  return textOf(digits, what, ' ', low, "..", high);
}

GapPart::GapPart(double value, double from, double to, int parts) noexcept
{
  const double width = (to - from) / parts;
  const double at = width > 0.0 ? std::floor((value - from) / width) : 0.0;
  const double part = std::fmin(std::fmax(at, 0.0), parts - 1.0);
  low = from + part * width;
  high = from + (part + 1.0) * width;
}

GapCells fifths(std::vector<std::pair<double, double>> pairs, const std::string& name)
{
  GapCells cells;
  std::stable_sort(
    pairs.begin(), pairs.end(), [](const auto& a, const auto& b) { return a.first < b.first; });
  const std::size_t n = pairs.size();
  const bool alike = n < 5 || !(pairs.front().first < pairs.back().first);
  for (std::size_t part = 0; part < 5 && !alike; ++part)
  {
    const std::size_t first = part * n / 5;
    const std::size_t last = (part + 1) * n / 5;
    const std::string cell = rangeText(name, pairs[first].first, pairs[last - 1].first, 2);
    for (std::size_t i = first; i < last; ++i)
    {
      cells.add(cell, pairs[i].second);
    }
  }
  return cells;
}

std::vector<GapAxis> worthNaming(std::vector<GapAxis> axes)
{
  const double sum = std::accumulate(axes.begin(), axes.end(), 0.0,
    [](double all, const GapAxis& axis) { return all + std::fmax(axis.share, 0.0); });
  for (GapAxis& axis : axes)
  {
    axis.share /= std::fmax(sum, 1.0);
  }
  axes.erase(std::remove_if(axes.begin(), axes.end(),
               [](const GapAxis& axis) { return !(axis.share > Decision::FormPart); }),
    axes.end());
  // Two axes may be the same: scenes of one medium each. Then rounding does not say which comes first.
  std::stable_sort(axes.begin(), axes.end(),
    [](const GapAxis& a, const GapAxis& b)
    { return std::round(a.share / Alike) > std::round(b.share / Alike); });
  return axes;
}

GapRemainder remainderOf(double share, const std::vector<GapAxis>& axes)
{
  return share > 0.0 ? GapRemainder{ share, whereIs(axes), dependences(axes) } : GapRemainder{};
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

double GapReport::probabilityOf(const std::string& name) const
{
  const auto found = std::find_if(probabilities.begin(), probabilities.end(),
    [&name](const auto& one) { return one.first == name; });
  return found == probabilities.end() ? 0.0 : found->second;
}

void believe(GapReport& report, std::vector<std::pair<std::string, double>> probabilities)
{
  std::stable_sort(probabilities.begin(), probabilities.end(),
    [](const auto& a, const auto& b) { return a.second > b.second; });
  report.probabilities = std::move(probabilities);
  for (GapCause& cause : report.causes)
  {
    cause.probability = report.probabilityOf(cause.effect);
  }
  if (report.verdict == GapVerdict::Explained && report.probabilityOf("unknown") > 0.5)
  {
    report.verdict = GapVerdict::PartlyExplained;
  }
}

void requireKnown(const std::vector<std::string>& without)
{
  for (const std::string& name : without)
  {
    if (findEffect(name) == nullptr)
    {
      throw std::invalid_argument("there is no effect '" + name + "' to leave out");
    }
  }
}

GapVerdict verdictOf(double explained) noexcept
{
  return explained >= Decision::ExplainedShrink ? GapVerdict::Explained
    : explained >= Decision::PartlyShrink       ? GapVerdict::PartlyExplained
                                                : GapVerdict::Unexplained;
}

void sortCauses(std::vector<GapCause>& causes)
{
  std::stable_sort(causes.begin(), causes.end(),
    [](const GapCause& a, const GapCause& b)
    {
      return std::make_pair(isOfLinearFit(a), -a.share) <
        std::make_pair(isOfLinearFit(b), -b.share);
    });
}

void creditCauses(GapReport& report, std::vector<GapCause> causes, double inexact)
{
  const auto sumOf = [](const std::vector<GapCause>& some)
  {
    return std::accumulate(some.begin(), some.end(), 0.0,
      [](double sum, const GapCause& cause) { return sum + cause.share; });
  };
  const double all = sumOf(causes);
  const auto isCause = [all, inexact](const GapCause& cause)
  {
    return isOfLinearFit(cause) ? cause.share > Decision::PartlyShrink
                                : cause.share > Decision::LeastPart * inexact * all &&
        !isSmallErrorOfChannels(cause, cause.share / all);
  };
  const auto first = std::stable_partition(causes.begin(), causes.end(), isCause);
  report.uncredited.clear();
  for (auto cause = first; cause != causes.end(); ++cause)
  {
    if (!isOfLinearFit(*cause)) // which has a note of its own
    {
      report.uncredited.push_back(cause->effect);
    }
  }
  causes.erase(first, causes.end());
  report.causes = std::move(causes);
  report.unexplained.share = std::clamp(1.0 - sumOf(report.causes), 0.0, 1.0);
}

namespace
{
// Whether the end of a parameter's range says that another effect may be behind it: it does not make up a shape, and is no width of
// an edge that may be as sharp as can be.
bool endTells(
  const EffectDefinition& effect, const std::string& form, const EffectParameter& parameter)
{
  bool ofImages = false;
  bool mayEnd = false;
  for (const ImageForm& shown : effect.imageForms)
  {
    for (const ImageTerm& term : shown.terms)
    {
      const bool own = shown.form == form && term.name == parameter.name;
      ofImages = ofImages || own;
      mayEnd = mayEnd || (own && term.mayEnd);
    }
  }
  return !mayEnd && (ofImages || !parameter.secondary);
}

// The parameters of a cause that lie at the end of their range; empty: none.
std::string atTheirEnds(const GapCause& cause)
{
  constexpr double Rounding = 1e-6; // of the range
  const EffectDefinition& effect = requireEffect(cause.effect);
  std::string ends;
  for (const EffectParameter& known : requireForm(effect, cause.form).parameters)
  {
    const double near = Rounding * (known.upper - known.lower);
    std::ptrdiff_t all = 0;
    std::ptrdiff_t count = 0;
    double end = 0.0;
    for (const GapParameter& found : cause.parameters)
    {
      const bool own = found.name.substr(0, found.name.find('[')) == known.name;
      // An end that is neutral is none.
      const bool high = own && known.upper > known.neutral && found.value > known.upper - near;
      const bool low = own && known.lower < known.neutral && found.value < known.lower + near;
      all += own ? 1 : 0;
      count += high || low ? 1 : 0;
      end = high ? known.upper : low ? known.lower : end;
    }
    if (count > 0 && endTells(effect, cause.form, known))
    {
      ends += (ends.empty() ? "" : ", ") + known.name + textOf(4, ' ', end);
      ends += all > 1 ? textOf(4, " (in ", count, " of ", all, " channels)") : "";
    }
  }
  return ends;
}
}

void noteDoubts(std::vector<std::string>& notes, const GapReport& report)
{
  for (const GapCause& cause : report.causes)
  {
    if (const std::string ends = atTheirEnds(cause); !ends.empty())
    {
      notes.push_back(
        cause.effect + " may stand for another effect. At the end of its range: " + ends + ".");
    }
  }
  if (report.unconfirmed)
  {
    notes.emplace_back(
      "What the causes do shows in a few samples only, and the others cannot confirm it: "
      "more samples like these would.");
  }
  if (std::any_of(report.correction.begin(), report.correction.end(),
        [](const CameraEffect& used) { return isOfLinearFit(used.name, used.form); }))
  {
    notes.emplace_back(
      "The nominal camera seems to be a linear fit to responses that are curved: fit it "
      "with the detector's curve (Camera Model Fit, Detector Curve).");
  }
  std::string names;
  const bool several = report.uncredited.size() > 1;
  for (const std::string& name : report.uncredited)
  {
    names += (names.empty() ? "" : ", ") + name;
  }
  if (!names.empty())
  {
    notes.push_back("The corrected simulator also has " + names +
      (several
          ? ": with them the readings are predicted better, but they are not believed to be causes."
          : ": with it the readings are predicted better, but it is not believed to be a cause."));
  }
}

std::vector<std::string> cheapestOf(std::vector<Rival> rivals)
{
  std::stable_sort(
    rivals.begin(), rivals.end(), [](const Rival& a, const Rival& b) { return a.cost < b.cost; });
  std::vector<std::string> names;
  for (const Rival& rival : rivals)
  {
    if (names.size() < EquivalentNamed &&
      std::find(names.begin(), names.end(), rival.effect) == names.end())
    {
      names.push_back(rival.effect);
    }
  }
  return names;
}

} // namespace msi
