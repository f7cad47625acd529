// A capture made ready for fitting: one grid, averaged readings, weights, folds.
#pragma once

#include "Kernels/Doubts/OddOnes.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Gap/SimToRealGap.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

using SampleList = std::vector<Eigen::Index>; // numbers of samples, ascending

// Channels x samples throughout. An element without a reading has count 0 and weight 0, and observed
// there equals simulated.
struct GapData
{
  CameraModel camera;
  SampleScene scene;              // on the camera's grid
  std::vector<std::string> names; // of the samples
  Eigen::MatrixXd observed;
  Eigen::MatrixXd count;         // readings behind each element
  Eigen::MatrixXd scatter;       // sum of squared deviations of the readings from their mean
  Eigen::VectorXd step;          // K, to which the readings are rounded; 0 where no step shows
  Eigen::MatrixXd simulated;     // the nominal camera
  Eigen::MatrixXd variance;      // of observed - simulated from noise alone
  Eigen::MatrixXd weight;        // of a squared residual in a fit
  SampleList usable;             // with a reflectance and a reading, and not left out
  IndexList leftOut;             // elements, column by column, whose readings are not looked at
  std::vector<SampleList> folds; // of the usable samples
  Eigen::Index elements = 0;     // with weight

  auto measured() const { return count.array() > 0.0; }
  bool anyMeasured(Eigen::Index sample) const { return (count.col(sample).array() > 0.0).any(); }
  Eigen::Index channels() const noexcept { return observed.rows(); }
  Eigen::Index samples() const noexcept { return observed.cols(); }
};

// Positions and orders that are NaN, as a lid's beside a chart: in the middle of the field, captured first. A column of nothing else
// stays.
void fillInUnknown(SceneSamples& samples);

// The step to which values are rounded, of which there are several and far apart: all are multiples of it from one another; 0 where
// they are not.
double stepBetween(std::vector<double> values);

std::vector<std::string> sampleNames(const GapCapture& capture);

// Averages and aligns; variance is 0, weight is left empty.
// Errors: as diagnoseGap.
GapData prepareGapData(
  const GapCapture& capture, const GapOptions& options, IndexList leftOut = {});

// K x S, where something was measured, 0 elsewhere.
Eigen::MatrixXd measuredOnly(const GapData& data, const Eigen::MatrixXd& values);
// Of some samples. before, after: real minus simulated, K x S, 0 where nothing was measured.
GroupEnergies energiesOf(const GapData& data, const SampleList& samples,
  const Eigen::MatrixXd& before, const Eigen::MatrixXd& after);

// energiesBesideGain() together, weighted.
double energyBesideGain(const GapData& data, const Eigen::MatrixXd& weight, bool ofChannels);
// Weights 1 / (variance + Decision::FormPart x mean square of that): the library's forms are approximations of the
// physics, and below that part of the gap no element is trusted more than another.
void setWeights(GapData& data);

constexpr std::size_t InnerFolds = 5; // of training samples

// Balanced folds over some of the samples, as many as there are samples at most; the same for the same seed. Every fold has its part of
// each medium and, within it, of the bright and the dark: what few bright samples show, as the end of the range, is seen without each
// fold.
std::vector<SampleList> foldsOf(
  const GapData& data, SampleList among, std::size_t folds, std::uint64_t seed);

// The usable samples but those of a fold of the data.
SampleList samplesOutside(const GapData& data, std::size_t fold);

} // namespace msi
