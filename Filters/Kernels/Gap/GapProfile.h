// The gap along what a picture can show: groups of samples, and the capture order.
#pragma once

#include "Kernels/Camera/SampleScene.h"
#include "Kernels/Gap/GapReport.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

struct SampleGroup
{
  std::string kind; // medium, scene, reflectance, order or position
  std::string name; // "paper", "reflectance 0.05..0.21", "order 1..40", "x 0..80, y 0..80"
  std::vector<Eigen::Index> samples;
};

// Groups of every kind that the samples allow: each medium and each scene where there are several; fifths by
// mean reflectance; fifths of the capture order; the thirds by thirds of the field that hold samples. A sample without
// a finite reflectance, order or position is in no group of that kind.
std::vector<SampleGroup> groupSamples(const SceneSamples& samples);

// Over the finite elements of each channel and group; NaN where there is none.
struct GroupedGap
{
  Eigen::MatrixXd mean; // K x groups, signed
  Eigen::MatrixXd rms;  // K x groups
};
GroupedGap groupGap(const Eigen::MatrixXd& gap, const std::vector<SampleGroup>& groups);

// Sum of the gap over a sample's channels, relative to the sum of the simulated responses.
// Shapes: K x S both. NaN for a sample without a finite gap.
Eigen::VectorXd relativeGap(const Eigen::MatrixXd& gap, const Eigen::MatrixXd& simulated);

// The gap over the capture order, first to last.
struct GapTrend
{
  std::vector<Eigen::Index> sample;
  Eigen::VectorXd order;
  Eigen::VectorXd before; // relativeGap
  Eigen::VectorXd after;
  Eigen::VectorXd level; // line through `before` between one change point and the next
};
// Samples with a finite gap; empty without an order.
GapTrend trendOf(
  const SceneSamples& samples, const GapReport& report, const Eigen::MatrixXd& simulated);

} // namespace msi
