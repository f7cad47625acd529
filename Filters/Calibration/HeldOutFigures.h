// How well a method's estimates of held-out samples do, and the figures of all draws.
#ifndef HeldOutFigures_h
#define HeldOutFigures_h

#include "NameList.h"
#include "ViewingConditions.h"

#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"
#include "Kernels/Difference/ColorDifference.h"
#include "Kernels/Estimation/MethodComparison.h"

#include <Eigen/Core>

#include <array>
#include <cstddef>
#include <string>
#include <vector>

class vtkMultiProcessController;

namespace msi
{

// mean, median, p95, max
constexpr std::size_t FigureCount = 4;
// coverage90 and coverage95, which are of no single sample
constexpr std::size_t IntervalCount = 2;
using Figures = std::array<double, FigureCount>;

// What one method did on the held-out samples of one draw.
struct HeldOutErrors
{
  std::vector<Figures> figures; // of every metric
  std::vector<Eigen::VectorXd>
    samples; // of every metric but coverage: one error per held-out sample
};

// Immutable. The constructor throws std::invalid_argument for an illuminant or color difference not known.
class HeldOutJudge
{
public:
  // 'target' is the measured reflectance of all samples, bands x samples.
  HeldOutJudge(const WavelengthGrid& bands, const std::vector<std::string>& illuminants,
    const ViewingConditions& conditions, const std::string& difference,
    const Eigen::MatrixXd& target);

  // rms, the color difference of each illuminant, coverage90, coverage95.
  const std::vector<ErrorName>& metrics() const { return Metrics; }

  // In the order of metrics(); coverage is NaN for a method that does not know its uncertainty.
  HeldOutErrors operator()(
    const MethodEstimate& estimate, const std::vector<Eigen::Index>& heldOut) const;

private:
  struct Color
  {
    TristimulusTransform tristimulus;
    CIELAB space;
    Eigen::Matrix3Xd targetLab;
  };

  Eigen::MatrixXd Target;
  ColorDifference Difference;
  std::vector<Color> Colors;
  std::vector<ErrorName> Metrics;
};

// One error per draw and sample of the target: draws x samples, NaN where the sample was not held out. Every task writes
// its own rows.
class SampleErrorStore
{
public:
  // A number of tuning samples with its draws and its leading metrics.
  struct Count
  {
    std::size_t draws = 0;
    std::size_t metrics = 0;
  };
  SampleErrorStore(std::vector<Count> counts, std::size_t methods, std::size_t samples);

  std::size_t metrics(std::size_t count) const { return Counts[count].metrics; }
  Eigen::Map<Eigen::MatrixXd> at(std::size_t count, std::size_t method, std::size_t metric);

  // As FigureStore's.
  void sumOverRanks(vtkMultiProcessController* controller);

private:
  std::vector<Count> Counts;
  std::size_t Methods;
  std::size_t Samples;
  std::vector<std::size_t> Offsets;
  std::vector<double> Values;
};

// All figures of all draws: [tuning count][draw][method][metric][figure].
class FigureStore
{
public:
  FigureStore(std::size_t counts, std::size_t draws, std::size_t methods, std::size_t metrics);

  double* at(std::size_t count, std::size_t draw, std::size_t method, std::size_t metric);

  // Every figure was computed on one rank and is zero on the others. Null: this process has all.
  void sumOverRanks(vtkMultiProcessController* controller);

private:
  std::size_t Draws;
  std::size_t Methods;
  std::size_t Metrics;
  std::vector<double> Values;
};

} // namespace msi

#endif
