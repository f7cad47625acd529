#include "Kernels/Gap/Samples/OrderBreaks.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr std::size_t PlacesKept = 3;
constexpr double PlacesApart = 0.05;
constexpr double Significant = 5.0;
constexpr Eigen::Index ShortestSegment = 4;
constexpr double Rounding = 1e-16; // squared: of numbers of this length

SampleList inOrder(const EffectFitter& fitter)
{
  const SampleScene& scene = fitter.data().scene;
  SampleList order;
  if (scene.hasOrder())
  {
    order = fitter.training();
    std::stable_sort(order.begin(), order.end(),
      [&scene](Eigen::Index a, Eigen::Index b) { return scene.time()[a] < scene.time()[b]; });
  }
  return order;
}

// Relative gap of each sample along the order, its weight, and when it was captured.
struct Series
{
  Eigen::ArrayXd value, weight, time;
};

Series relativeGaps(
  const EffectFitter& fitter, const Eigen::MatrixXd& predicted, const SampleList& order)
{
  const GapData& data = fitter.data();
  const Eigen::ArrayXXd weight = fitter.weight()(Eigen::all, order);
  const Eigen::ArrayXXd u = (weight > 0.0).select(predicted(Eigen::all, order).array(), 0.0);
  const Eigen::ArrayXXd residual =
    (weight > 0.0).select(data.observed(Eigen::all, order).array() - u, 0.0);
  const Eigen::ArrayXd information = (weight * u.square()).colwise().sum();
  const Eigen::ArrayXd product = (weight * u * residual).colwise().sum();
  return { (information > 0.0).select(product / information, 0.0), information,
    data.scene.time()(order) };
}

// Samples in a row, whose gap is a straight line over the time but for at most one break: a drift is no row of breaks.
class Stretch
{
public:
  Stretch(const Series& series, Eigen::Index first, Eigen::Index end)
    : Count(end - first)
    , Weight(series.weight.segment(first, Count))
    , Time(besideMean(series.time.segment(first, Count)))
    , Value(besideLine(series.value.segment(first, Count)))
  {
  }

  struct Break
  {
    double change = 0.0, information = 0.0; // 1 / variance for a gap of unit variance and weight
    double energy() const { return change * change * information; }
  };

  // In front of the sample with this number in the stretch.
  Break at(Eigen::Index place) const
  {
    Eigen::ArrayXd behind = Eigen::ArrayXd::Zero(Count);
    behind.tail(Count - place).setOnes();
    behind = besideLine(behind);
    const double information = (Weight * behind.square()).sum();
    return information > Rounding * Weight.sum()
      ? Break{ (Weight * behind * Value).sum() / information, information }
      : Break{};
  }

  double deviations(const Break& found) const
  {
    const double left = (Weight * Value.square()).sum() - found.energy();
    const double spread =
      std::fmax(left / static_cast<double>(Count - 3), Rounding * Weight.mean());
    return spread > 0.0 ? std::sqrt(found.energy() / spread) : 0.0;
  }

private:
  Eigen::ArrayXd besideMean(const Eigen::ArrayXd& values) const
  {
    return values - (Weight * values).sum() / std::fmax(Weight.sum(), 1e-300);
  }
  Eigen::ArrayXd besideLine(const Eigen::ArrayXd& values) const
  {
    const double slope =
      (Weight * Time * values).sum() / std::fmax((Weight * Time.square()).sum(), 1e-300);
    return besideMean(values) - slope * Time;
  }

  Eigen::Index Count;
  Eigen::ArrayXd Weight, Time, Value;
};

// The number of the sample in front of which first .. end - 1 breaks best; `first` where they do not break significantly.
Eigen::Index breakOf(const Series& series, Eigen::Index first, Eigen::Index end)
{
  if (end - first < 2 * ShortestSegment)
  {
    return first;
  }
  const Stretch stretch(series, first, end);
  Stretch::Break best;
  Eigen::Index place = 0;
  for (Eigen::Index i = ShortestSegment; i + ShortestSegment <= end - first; ++i)
  {
    const Stretch::Break found = stretch.at(i);
    if (found.energy() > best.energy())
    {
      best = found;
      place = i;
    }
  }
  return stretch.deviations(best) >= Significant ? first + place : first;
}
}

void OrderBreaks::keepBest(std::vector<Break>& list, const Break& candidate)
{
  for (Break& other : list)
  {
    if (std::fabs(other.place - candidate.place) < PlacesApart)
    {
      if (candidate.gain > other.gain)
      {
        other = candidate;
      }
      return;
    }
  }
  list.push_back(candidate);
}

OrderBreaks::OrderBreaks(const EffectFitter& fitter, const Eigen::MatrixXd& predicted)
{
  const SampleList order = inOrder(fitter);
  if (order.size() < 4)
  {
    return;
  }
  const GapData& data = fitter.data();
  Width = std::fmax(0.001, 0.5 / static_cast<double>(order.size()));
  Eigen::ArrayXd numerator = Eigen::ArrayXd::Zero(data.channels());
  Eigen::ArrayXd denominator = numerator;
  double offsetNumerator = 0.0;
  double offsetDenominator = 0.0;
  // From the end: everything behind the place.
  for (std::size_t i = order.size() - 1; i > 0; --i)
  {
    const Eigen::Index j = order[i];
    const Eigen::ArrayXd weight = fitter.weight().col(j).array();
    const Eigen::ArrayXd u = predicted.col(j).array();
    const Eigen::ArrayXd residual = (weight > 0.0).select(data.observed.col(j).array() - u, 0.0);
    const Eigen::ArrayXd level = (weight > 0.0).select(u, 0.0);
    numerator += weight * residual * level;
    denominator += weight * level.square();
    offsetNumerator += (weight * residual).sum();
    offsetDenominator += weight.sum();
    const double before = data.scene.time()[order[i - 1]];
    const double after = data.scene.time()[j];
    // A step with next to nothing on one side is a gain.
    const std::size_t least = std::max<std::size_t>(ShortestSegment, order.size() / 10);
    const bool room = i >= least && i + least <= order.size();
    if (!room || after <= before || denominator.sum() <= 0.0 || offsetDenominator <= 0.0)
    {
      continue;
    }
    const double place = 0.5 * (before + after);
    const double change = numerator.sum() / denominator.sum();
    keepBest(Gain, { place, change, numerator.sum() * change });
    keepBest(
      GainPerChannel, { place, change, (numerator.square() / denominator.max(1e-300)).sum() });
    const double offset = offsetNumerator / offsetDenominator;
    keepBest(Offset, { place, offset, offsetNumerator * offset });
  }
  for (std::vector<Break>* list : { &Gain, &GainPerChannel, &Offset })
  {
    std::sort(
      list->begin(), list->end(), [](const Break& a, const Break& b) { return a.gain > b.gain; });
    list->resize(std::min(list->size(), PlacesKept));
  }
}

std::vector<std::vector<double>> OrderBreaks::startsFor(const EffectForm& form) const
{
  const std::vector<Break>& list = form.has(FormTrait::Adds) ? Offset
    : form.parameters.front().perChannel                     ? GainPerChannel
                                                             : Gain;
  std::vector<std::vector<double>> starts;
  for (const Break& place : list)
  {
    const double change = std::fmin(std::fmax(place.change, -0.5), 0.5);
    starts.push_back({ change == 0.0 ? 1e-4 : change, place.place, Width });
  }
  return starts;
}

std::vector<GapChangePoint> OrderBreaks::significant(
  const EffectFitter& fitter, const Eigen::MatrixXd& predicted, int most)
{
  const SampleList order = inOrder(fitter);
  const Series series = relativeGaps(fitter, predicted, order);
  const Eigen::Index count = order.size();
  std::vector<Eigen::Index> places{ 0, count };
  std::vector<std::pair<Eigen::Index, Eigen::Index>> open{ { 0, count } };
  while (!open.empty() && static_cast<int>(places.size()) < most + 2)
  {
    const auto [first, end] = open.back();
    open.pop_back();
    const Eigen::Index place = breakOf(series, first, end);
    if (place > first)
    {
      places.push_back(place);
      open.emplace_back(first, place);
      open.emplace_back(place, end);
    }
  }
  std::sort(places.begin(), places.end());
  // Between their neighbours, now that all are known: some looked like one only beside larger ones that were not known yet.
  std::vector<GapChangePoint> found;
  const Eigen::VectorXd& at = fitter.data().scene.samples().order;
  for (std::size_t p = 1; p + 1 < places.size(); ++p)
  {
    const Stretch stretch(series, places[p - 1], places[p + 1]);
    const Stretch::Break one = stretch.at(places[p] - places[p - 1]);
    const std::size_t behind = places[p];
    if (const double deviations = stretch.deviations(one); deviations >= Significant)
    {
      found.push_back(
        { 0.5 * (at[order[behind - 1]] + at[order[behind]]), one.change, deviations });
    }
  }
  return found;
}

} // namespace msi
