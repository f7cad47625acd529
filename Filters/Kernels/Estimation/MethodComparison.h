// Compares estimation methods on a target medium: random tuning samples, the rest held out.
#pragma once

#include "Kernels/Estimation/SampleDraw.h"
#include "Kernels/Estimation/SampleSet.h"
#include "Kernels/Numerics/FitSummary.h"
#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <cstddef>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace msi
{

// The names of all methods, in the registry's order.
std::vector<std::string> allMethodNames();

struct ComparisonOptions
{
  std::vector<std::string> methods = allMethodNames(); // names in the registry (EstimationMethod.h)
  Eigen::Index tuningSamples = 16;
  std::uint64_t seed = 1;
  std::optional<WavelengthGrid> channelWavelengths; // for the structure of the method banded
  bool uncertainty = true; // MethodEstimate::standardDeviation is asked for
};

// One method on the held-out samples of one draw.
struct MethodEstimate
{
  std::string method;
  Eigen::MatrixXd reflectance; // N x held-out
  Eigen::MatrixXd
    standardDeviation; // N x held-out where the method knows it and it is asked for, else 0 x 0
  Eigen::VectorXd rms; // held-out: sqrt(mean over bands of the squared error), Eq. 21
  FitSummary summary;
  std::string failure; // why the method has no estimate; empty where it has one
};

struct ComparisonDraw
{
  std::vector<Eigen::Index> tuning;      // columns of the target set, increasing
  std::vector<Eigen::Index> heldOut;     // the other columns, increasing
  std::vector<MethodEstimate> estimates; // one per method, in the order of the options
};

// The immutable set-up of a comparison. Draws are independent of each other: callers spread
// run(0), run(1), ... over threads or ranks and get the same numbers.
//
// Errors: the constructor throws std::invalid_argument where a set is empty or not finite, bands or
//         channels differ, no method is asked for or one is not known, or tuningSamples leaves nothing to hold out;
//         run() does not throw: a method that cannot be fitted to the samples of a draw, or whose estimates are not
//         finite, has a failure and no estimate.
class MethodComparison
{
public:
  MethodComparison(SampleSet calibration, SampleSet target, ComparisonOptions options = {});

  ComparisonDraw run(std::uint64_t draw) const;

  // Every sample of the target as a calibration on that medium itself would estimate it: least squares on the other nine
  // tenths of the target. A failure where those do not determine it.
  MethodEstimate ownMedium() const;

  // The same draws with one of the methods, by its place in the options.
  MethodComparison only(std::size_t method) const;

  const SampleSet& target() const noexcept { return Target; }
  const ComparisonOptions& options() const noexcept { return Options; }

private:
  SampleSet Calibration;
  SampleSet Target;
  ComparisonOptions Options;
};

} // namespace msi
