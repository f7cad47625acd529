// Mean and deviation of the pixels of each patch, whatever the pieces they come in.
#pragma once

#include "Kernels/Sampling/ExactSum.h"

#include <Eigen/Core>

#include <cstdint>
#include <vector>

namespace msi
{

// Accumulates pixels by label 1..patches; label 0 and pixels with a value that is not finite (or beyond
// 2^20 in size) are left out, the latter counted.
//
// The state is integers that add up: any split over threads, pieces and ranks gives the same bytes.
class PatchStatistics
{
public:
  PatchStatistics(int patches, Eigen::Index channels);

  int patches() const noexcept { return Patches; }
  Eigen::Index channels() const noexcept { return Channels; }

  // One pixel at (x, y); labels outside 0..patches() must not come.
  void add(int label, double x, double y, const float* pixel) noexcept;
  void add(int label, double x, double y, const double* pixel) noexcept;
  void merge(const PatchStatistics& other) noexcept;
  // Makes room for labels up to 'patches'; fewer than there are change nothing.
  void grow(int patches);

  // For label 1..patches(). Mean, deviation and center are NaN where count is 0.
  std::int64_t count(int label) const noexcept;
  std::int64_t leftOut(int label) const noexcept;
  Eigen::VectorXd mean(int label) const;
  Eigen::VectorXd standardDeviation(int label) const; // of the sample: divided by count - 1
  Eigen::Vector2d center(int label) const;

  // Summed element by element over ranks, the array holds the state of the whole.
  std::vector<std::int64_t> toArray() const;
  void setArray(const std::vector<std::int64_t>& state);

private:
  struct Patch
  {
    std::int64_t count = 0;
    std::int64_t leftOut = 0;
  };

  template <typename T>
  void addPixel(int label, double x, double y, const T* pixel) noexcept;
  // The sums of a patch: values, squares (channels each), x, y.
  ExactSum* sums(int label) noexcept;
  const ExactSum* sums(int label) const noexcept;

  int Patches;
  Eigen::Index Channels;
  std::vector<Patch> Counts;
  std::vector<ExactSum> Sums;
};

} // namespace msi
