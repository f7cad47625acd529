#include "Kernels/Estimation/SampleDraw.h"

#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <random>
#include <set>

namespace msi
{

namespace
{
std::uint64_t splitMix64(std::uint64_t state) noexcept
{
  std::uint64_t z = state + 0x9E3779B97F4A7C15U;
  z = (z ^ (z >> 30U)) * 0xBF58476D1CE4E5B9U;
  z = (z ^ (z >> 27U)) * 0x94D049BB133111EBU;
  return z ^ (z >> 31U);
}

// Uniform on [0, bound]: values past the last whole multiple are drawn again.
std::uint64_t uniformUpTo(std::mt19937_64& generator, std::uint64_t bound)
{
  const std::uint64_t values = bound + 1;
  const std::uint64_t excess = (UINT64_MAX % values + 1) % values;
  std::uint64_t value = generator();
  while (value > UINT64_MAX - excess)
  {
    value = generator();
  }
  return value % values;
}
}

std::vector<Eigen::Index> drawSamples(
  Eigen::Index population, Eigen::Index count, std::uint64_t seed, std::uint64_t draw)
{
  if (count < 0 || count > population)
  {
    reject(count, " samples are to be drawn from ", population, "; expected a number from 0 to ",
      population);
  }
  std::mt19937_64 generator(splitMix64(splitMix64(seed) ^ draw));
  std::set<Eigen::Index> chosen;
  for (Eigen::Index last = population - count; last < population; ++last)
  {
    const auto candidate =
      static_cast<Eigen::Index>(uniformUpTo(generator, static_cast<std::uint64_t>(last)));
    if (!chosen.insert(candidate).second)
    {
      chosen.insert(last);
    }
  }
  return { chosen.begin(), chosen.end() };
}

std::vector<Eigen::Index> remainingSamples(
  Eigen::Index population, const std::vector<Eigen::Index>& chosen)
{
  std::vector<Eigen::Index> remaining;
  auto next = chosen.begin();
  for (Eigen::Index i = 0; i < population; ++i)
  {
    if (next != chosen.end() && *next == i)
    {
      ++next;
    }
    else
    {
      remaining.push_back(i);
    }
  }
  return remaining;
}

std::vector<std::vector<Eigen::Index>> leftOutFolds(Eigen::Index samples, Eigen::Index mostFolds)
{
  const auto folds = static_cast<std::size_t>(std::min(samples, mostFolds));
  std::vector<std::vector<Eigen::Index>> left(folds);
  for (Eigen::Index i = 0; i < samples; ++i)
  {
    left[static_cast<std::size_t>(i) % folds].push_back(i);
  }
  return left;
}

} // namespace msi
