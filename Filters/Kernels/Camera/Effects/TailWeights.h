// The long tail of stray light on tables: how much of each other sample's signal falls on a sample.
#pragma once

#include "Kernels/Camera/SampleScene.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace msi
{

// Of the other samples in a sample's surround, exp(-distance / reach) each; reach: pitches. Samples that are not usable
// (one number a sample) take no part.
class TailWeights
{
public:
  TailWeights(const SampleScene& scene, double reach, std::vector<char> usable);

  bool areFor(double reach, const std::vector<char>& usable) const noexcept
  {
    return Reach == reach && Usable == usable;
  }
  // The weighted mean of each sample's surround, K x S like the signal; the sample itself where it has none.
  Eigen::MatrixXd mean(const Eigen::MatrixXd& signal) const;

private:
  double Reach;
  std::vector<char> Usable;
  std::vector<std::size_t> First; // of each sample, and the end
  std::vector<int> Others;
  std::vector<double> Weights;
  std::vector<double> Sums; // of the weights of each sample
};

} // namespace msi
