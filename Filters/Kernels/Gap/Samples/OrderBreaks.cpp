#include "Kernels/Gap/Samples/OrderBreaks.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace msi
{

namespace
{
constexpr std::size_t PlacesKept = 3;
constexpr double PlacesApart = 0.05;
constexpr double Significant = 5.0;
constexpr std::size_t ShortestSegment = 4;
constexpr double Rounding = 1e-16; // squared relative gap that numbers of this length have anyway

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
    const std::size_t least = std::max(ShortestSegment, order.size() / 10);
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

namespace
{
// Relative gap of each sample along the order, and its weight.
struct Series
{
  std::vector<double> value, weight;
};

Series relativeGaps(
  const EffectFitter& fitter, const Eigen::MatrixXd& predicted, const SampleList& order)
{
  const GapData& data = fitter.data();
  Series series;
  for (const Eigen::Index j : order)
  {
    const Eigen::ArrayXd w = fitter.weight().col(j).array();
    const Eigen::ArrayXd u = (w > 0.0).select(predicted.col(j).array(), 0.0);
    const Eigen::ArrayXd residual = (w > 0.0).select(data.observed.col(j).array() - u, 0.0);
    const double weight = (w * u.square()).sum();
    series.weight.push_back(weight);
    series.value.push_back(weight > 0.0 ? (w * u * residual).sum() / weight : 0.0);
  }
  return series;
}

// Weighted sums over the samples first .. last - 1.
struct Segment
{
  Segment(const Series& series, std::size_t from, std::size_t to)
    : first(from)
    , last(to)
  {
    for (std::size_t i = first; i < last; ++i)
    {
      add(series.value[i], series.weight[i]);
    }
  }
  void add(double value, double factor)
  {
    weight += factor;
    sum += factor * value;
    square += factor * value * value;
  }
  double mean() const { return weight > 0.0 ? sum / weight : 0.0; }
  double scatter() const { return std::fmax(square - sum * mean(), 0.0); }

  std::size_t first, last;
  double weight = 0.0, sum = 0.0, square = 0.0;
};

// The place behind which the segment breaks best; 0 where it does not break significantly.
std::size_t breakOf(const Series& series, const Segment& segment)
{
  Segment left(series, segment.first, segment.first);
  double best = 0.0;
  std::size_t place = 0;
  for (std::size_t i = segment.first; i + 1 < segment.last; ++i)
  {
    left.add(series.value[i], series.weight[i]);
    const double right = segment.weight - left.weight;
    const bool room =
      i + 1 >= segment.first + ShortestSegment && i + 1 + ShortestSegment <= segment.last;
    if (room && left.weight > 0.0 && right > 0.0)
    {
      const double change = (segment.sum - left.sum) / right - left.mean();
      const double explained = change * change * left.weight * right / segment.weight;
      place = explained > best ? i + 1 : place;
      best = std::fmax(best, explained);
    }
  }
  const auto count = static_cast<double>(segment.last - segment.first);
  const double spread =
    std::fmax((segment.scatter() - best) / (count - 2.0), Rounding * segment.weight / count);
  return best >= Significant * Significant * spread ? place : 0;
}
}

std::vector<GapChangePoint> OrderBreaks::significant(
  const EffectFitter& fitter, const Eigen::MatrixXd& predicted, int most)
{
  const SampleList order = inOrder(fitter);
  const Series series = relativeGaps(fitter, predicted, order);
  std::vector<std::size_t> places;
  std::vector<Segment> open{ { series, 0, order.size() } };
  while (!open.empty() && static_cast<int>(places.size()) < most)
  {
    const Segment segment = open.back();
    open.pop_back();
    const std::size_t place =
      segment.last - segment.first < 2 * ShortestSegment ? 0 : breakOf(series, segment);
    if (place > 0)
    {
      places.push_back(place);
      open.emplace_back(series, segment.first, place);
      open.emplace_back(series, place, segment.last);
    }
  }
  std::sort(places.begin(), places.end());
  // Sizes between neighbours, now that all places are known.
  std::vector<GapChangePoint> found;
  const Eigen::VectorXd& at = fitter.data().scene.samples().order;
  for (std::size_t p = 0; p < places.size(); ++p)
  {
    const Segment before(series, p > 0 ? places[p - 1] : 0, places[p]);
    const Segment after(
      series, places[p], p + 1 < places.size() ? places[p + 1] : series.value.size());
    const double change = after.mean() - before.mean();
    const double spread =
      (before.scatter() + after.scatter()) / (static_cast<double>(after.last - before.first) - 2.0);
    const double error = std::sqrt(spread * (1.0 / before.weight + 1.0 / after.weight));
    found.push_back({ 0.5 * (at[order[places[p] - 1]] + at[order[places[p]]]), change,
      error > 0.0 ? std::fabs(change) / error : 0.0 });
  }
  return found;
}

} // namespace msi
