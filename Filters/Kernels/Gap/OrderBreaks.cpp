#include "Kernels/Gap/OrderBreaks.h"

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

std::vector<Eigen::Index> inOrder(const EffectFitter& fitter)
{
  const SampleScene& scene = fitter.data().scene;
  std::vector<Eigen::Index> order;
  if (scene.hasOrder())
  {
    for (Eigen::Index j = 0; j < scene.size(); ++j)
    {
      if (fitter.training()[static_cast<std::size_t>(j)] != 0)
      {
        order.push_back(j);
      }
    }
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
  const std::vector<Eigen::Index> order = inOrder(fitter);
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

std::vector<std::vector<double>> OrderBreaks::startsFor(const std::string& form) const
{
  const std::vector<Break>& list = form.rfind("offset", 0) == 0 ? Offset
    : form.find("per_channel") != std::string::npos             ? GainPerChannel
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
  const GapData& data = fitter.data();
  const std::vector<Eigen::Index> order = inOrder(fitter);
  std::vector<GapChangePoint> found;
  // Relative gap of each sample, and its weight.
  std::vector<double> relative(order.size());
  std::vector<double> weight(order.size());
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    const Eigen::Index j = order[i];
    const Eigen::ArrayXd w = fitter.weight().col(j).array();
    const Eigen::ArrayXd u = (w > 0.0).select(predicted.col(j).array(), 0.0);
    const Eigen::ArrayXd residual = (w > 0.0).select(data.observed.col(j).array() - u, 0.0);
    weight[i] = (w * u.square()).sum();
    relative[i] = weight[i] > 0.0 ? (w * u * residual).sum() / weight[i] : 0.0;
  }
  struct Segment
  {
    std::size_t first, last;
  };
  std::vector<Segment> open{ { 0, order.size() } };
  while (!open.empty() && static_cast<int>(found.size()) < most)
  {
    const Segment segment = open.back();
    open.pop_back();
    if (segment.last - segment.first < 2 * ShortestSegment)
    {
      continue;
    }
    double total = 0.0;
    double sum = 0.0;
    double square = 0.0;
    for (std::size_t i = segment.first; i < segment.last; ++i)
    {
      total += weight[i];
      sum += weight[i] * relative[i];
      square += weight[i] * relative[i] * relative[i];
    }
    double left = 0.0;
    double leftSum = 0.0;
    double best = 0.0;
    double bestChange = 0.0;
    std::size_t place = segment.first;
    for (std::size_t i = segment.first; i + 1 < segment.last; ++i)
    {
      left += weight[i];
      leftSum += weight[i] * relative[i];
      const bool room =
        i + 1 >= segment.first + ShortestSegment && i + 1 + ShortestSegment <= segment.last;
      if (!room || left <= 0.0 || total - left <= 0.0)
      {
        continue;
      }
      const double change = (sum - leftSum) / (total - left) - leftSum / left;
      const double explained = change * change * left * (total - left) / total;
      if (explained > best)
      {
        best = explained;
        bestChange = change;
        place = i;
      }
    }
    const auto count = static_cast<double>(segment.last - segment.first);
    const double spread = total > 0.0 ? (square - sum * sum / total - best) / (count - 2.0) : 0.0;
    const double deviations = spread > 0.0 ? std::sqrt(best / spread) : 0.0;
    if (deviations >= Significant)
    {
      const Eigen::VectorXd& at = data.scene.samples().order;
      found.push_back({ 0.5 * (at[order[place]] + at[order[place + 1]]), bestChange, deviations });
      open.push_back({ segment.first, place + 1 });
      open.push_back({ place + 1, segment.last });
    }
  }
  std::sort(found.begin(), found.end(),
    [](const GapChangePoint& a, const GapChangePoint& b) { return a.order < b.order; });
  return found;
}

} // namespace msi
