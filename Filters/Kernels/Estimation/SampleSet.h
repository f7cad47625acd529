// Samples with measured reflectance and camera response: a chart, or swatches of a material.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

// One column per sample; both matrices have the same number of columns.
//
// reflectance: N x L, reflectance factor (1 = perfect white).
// response:    K x L, camera response (1 = perfect white), same channel order everywhere.
struct SampleSet
{
  Eigen::MatrixXd reflectance;
  Eigen::MatrixXd response;

  Eigen::Index bands() const noexcept { return reflectance.rows(); }
  Eigen::Index channels() const noexcept { return response.rows(); }
  Eigen::Index size() const noexcept { return response.cols(); }

  // The given columns, in the given order. Indices must be within [0, size()).
  SampleSet subset(const std::vector<Eigen::Index>& columns) const;
};

// Throws std::invalid_argument naming the first value that is not finite, column (sample) and row
// counted from 1; 'name' opens the message.
void requireFinite(
  const Eigen::MatrixXd& values, const std::string& name, const std::string& rowName = "band");

// Throws std::invalid_argument unless the set has at least one sample, one band and one channel, as
// many reflectances as responses, and only finite values. 'name' (for example "calibration") opens
// the message; the first offending sample and row are named, counted from 1.
void requireValid(const SampleSet& samples, const std::string& name);

// Throws std::invalid_argument, naming both numbers, unless bands and channels agree.
void requireSameShape(
  const SampleSet& a, const std::string& nameOfA, const SampleSet& b, const std::string& nameOfB);

// The samples of a, then those of b; shapes must agree.
SampleSet joined(const SampleSet& a, const SampleSet& b);

} // namespace msi
