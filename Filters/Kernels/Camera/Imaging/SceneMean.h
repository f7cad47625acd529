// The mean signal of a scene, gathered piece by piece.
#pragma once

#include "Kernels/Sampling/ExactSum.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <vector>

namespace msi
{

// Per channel the mean of all pixels whose value is finite and below 2^20 in size. Terms are rounded to
// 2^-32, then summed exactly: every split into pieces and ranks, in any order, gives the same bytes.
class SceneMean
{
public:
  explicit SceneMean(int channels)
    : Sums(static_cast<std::size_t>(channels))
    , Counts(static_cast<std::size_t>(channels), 0)
    , PartSums(static_cast<std::size_t>(channels))
    , PartCounts(static_cast<std::size_t>(channels))
  {
  }

  // Pixels with all their channels together.
  void add(const float* pixels, int count) noexcept;

  void merge(const SceneMean& other) noexcept
  {
    for (std::size_t k = 0; k < Sums.size(); ++k)
    {
      Sums[k].merge(other.Sums[k]);
      Counts[k] += other.Counts[k];
    }
  }

  // 0 where no value counted.
  Eigen::VectorXf value() const
  {
    Eigen::VectorXf mean(static_cast<Eigen::Index>(Sums.size()));
    for (std::size_t k = 0; k < Sums.size(); ++k)
    {
      const auto count = static_cast<double>(Counts[k] > 0 ? Counts[k] : 1);
      mean[static_cast<Eigen::Index>(k)] = static_cast<float>(Sums[k].value() / count);
    }
    return mean;
  }

  // For sums over ranks: add these element by element, then put them back.
  const std::vector<ExactSum>& sums() const noexcept { return Sums; }
  const std::vector<std::int64_t>& counts() const noexcept { return Counts; }
  void set(std::size_t channel, const ExactSum& sum, std::int64_t count) noexcept
  {
    Sums[channel] = sum;
    Counts[channel] = count;
  }

private:
  std::vector<ExactSum> Sums;
  std::vector<std::int64_t> Counts;
  std::vector<double> PartSums;
  std::vector<std::int64_t> PartCounts;
};

} // namespace msi
