#include "Kernels/Sampling/PatchStatistics.h"

#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace msi
{

namespace
{
constexpr double LargestValue = 1048576.0; // 2^20: its square is within ExactSum's range
}

PatchStatistics::PatchStatistics(int patches, Eigen::Index channels)
  : Patches(patches)
  , Channels(channels)
{
  if (patches < 1 || channels < 1)
  {
    throw std::invalid_argument("patch statistics of " + std::to_string(patches) + " patches and " +
      std::to_string(channels) + " channels; expected at least one of each");
  }
  Counts.resize(static_cast<std::size_t>(patches));
  Sums.resize(static_cast<std::size_t>(patches) * static_cast<std::size_t>(2 * channels + 2));
}

ExactSum* PatchStatistics::sums(int label) noexcept
{
  return Sums.data() + (label - 1) * (2 * Channels + 2);
}

const ExactSum* PatchStatistics::sums(int label) const noexcept
{
  return Sums.data() + (label - 1) * (2 * Channels + 2);
}

template <typename T>
void PatchStatistics::addPixel(int label, double x, double y, const T* pixel) noexcept
{
  if (label == 0)
  {
    return;
  }
  auto& patch = Counts[static_cast<std::size_t>(label - 1)];
  for (Eigen::Index k = 0; k < Channels; ++k)
  {
    if (!(std::abs(static_cast<double>(pixel[k])) <= LargestValue))
    {
      ++patch.leftOut;
      return;
    }
  }
  ++patch.count;
  ExactSum* sum = sums(label);
  for (Eigen::Index k = 0; k < Channels; ++k)
  {
    const auto value = static_cast<double>(pixel[k]);
    sum[k].add(value);
    sum[Channels + k].add(value * value);
  }
  sum[2 * Channels].add(x);
  sum[2 * Channels + 1].add(y);
}

void PatchStatistics::add(int label, double x, double y, const float* pixel) noexcept
{
  addPixel(label, x, y, pixel);
}

void PatchStatistics::add(int label, double x, double y, const double* pixel) noexcept
{
  addPixel(label, x, y, pixel);
}

void PatchStatistics::merge(const PatchStatistics& other) noexcept
{
  for (std::size_t i = 0; i < Counts.size(); ++i)
  {
    Counts[i].count += other.Counts[i].count;
    Counts[i].leftOut += other.Counts[i].leftOut;
  }
  for (std::size_t i = 0; i < Sums.size(); ++i)
  {
    Sums[i].merge(other.Sums[i]);
  }
}

void PatchStatistics::grow(int patches)
{
  if (patches > Patches)
  {
    Patches = patches;
    Counts.resize(static_cast<std::size_t>(patches));
    Sums.resize(static_cast<std::size_t>(patches) * static_cast<std::size_t>(2 * Channels + 2));
  }
}

std::int64_t PatchStatistics::count(int label) const noexcept
{
  return Counts[static_cast<std::size_t>(label - 1)].count;
}

std::int64_t PatchStatistics::leftOut(int label) const noexcept
{
  return Counts[static_cast<std::size_t>(label - 1)].leftOut;
}

Eigen::VectorXd PatchStatistics::mean(int label) const
{
  Eigen::VectorXd result(Channels);
  const auto n = static_cast<double>(count(label));
  for (Eigen::Index k = 0; k < Channels; ++k)
  {
    result[k] = sums(label)[k].value() / n;
  }
  return result;
}

Eigen::VectorXd PatchStatistics::standardDeviation(int label) const
{
  Eigen::VectorXd result(Channels);
  const auto n = static_cast<double>(count(label));
  if (n == 1.0)
  {
    return result.setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  for (Eigen::Index k = 0; k < Channels; ++k)
  {
    const double sum = sums(label)[k].value();
    const double squares = sums(label)[Channels + k].value();
    result[k] = std::sqrt(std::max(0.0, squares - sum * sum / n) / (n - 1.0));
  }
  return result;
}

Eigen::Vector2d PatchStatistics::center(int label) const
{
  const auto n = static_cast<double>(count(label));
  return { sums(label)[2 * Channels].value() / n, sums(label)[2 * Channels + 1].value() / n };
}

std::vector<std::int64_t> PatchStatistics::toArray() const
{
  std::vector<std::int64_t> state;
  state.reserve(2 * Counts.size() + 3 * Sums.size());
  for (const auto& patch : Counts)
  {
    state.push_back(patch.count);
    state.push_back(patch.leftOut);
  }
  for (const auto& sum : Sums)
  {
    const auto limbs = sum.limbs();
    state.insert(state.end(), limbs.begin(), limbs.end());
  }
  return state;
}

void PatchStatistics::setArray(const std::vector<std::int64_t>& state)
{
  if (state.size() != 2 * Counts.size() + 3 * Sums.size())
  {
    throw std::invalid_argument("the state of other patches or channels was given");
  }
  auto next = state.begin();
  for (auto& patch : Counts)
  {
    patch.count = *next++;
    patch.leftOut = *next++;
  }
  for (auto& sum : Sums)
  {
    ExactSum::Limbs limbs;
    for (auto& limb : limbs)
    {
      limb = *next++;
    }
    sum = ExactSum::fromLimbs(limbs);
  }
}

} // namespace msi
