// What the camera looked at: measured samples with their medium, place and time.
#pragma once

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

namespace msi
{

// What the simulator needs of a sample table. Empty: not known.
struct SceneSamples
{
  Eigen::MatrixXd reflectance;          // N x S
  std::vector<std::string> medium = {}; // S
  std::vector<std::string> scene = {};  // S
  Eigen::VectorXd x = {}, y = {};       // S, any unit
  Eigen::VectorXd order = {};           // S, position in the capture sequence
};

// Validated samples with what follows from it: medium and scene numbers, field coordinates,
// capture time, neighbours.
//
// Field coordinates: the samples' bounding box is centered on 0 and scaled by half its longer side,
//   so that every sample lies within [-1, 1] in both axes and circles stay circles.
// Capture time: order mapped linearly to [0, 1].
// Neighbours of a sample: the samples of the same scene within 1.5 times its nearest neighbour's
//   distance, with equal weight.
// Surround of a sample: the samples of the same scene within SurroundReach pitches; the pitch is the scene's median
//   distance to the nearest neighbour.
// Errors: std::invalid_argument naming the column and both counts.
class SampleScene
{
public:
  struct Other
  {
    int sample;
    int distance; // in distances()
  };
  static constexpr double SurroundReach = 8.0;

  SampleScene(WavelengthGrid wavelengths, SceneSamples samples);

  const WavelengthGrid& wavelengths() const noexcept { return Grid; }
  const Eigen::MatrixXd& reflectance() const noexcept { return Samples.reflectance; }
  const SceneSamples& samples() const noexcept { return Samples; }
  Eigen::Index size() const noexcept { return Samples.reflectance.cols(); }

  const std::vector<std::string>& media() const noexcept
  {
    return Media;
  } // distinct, in order of appearance
  const std::vector<std::string>& scenes() const noexcept { return Scenes; }
  const std::vector<int>& medium() const noexcept { return MediumOf; } // S; all 0 where not known
  const std::vector<int>& scene() const noexcept { return SceneOf; }

  bool hasPositions() const noexcept { return Samples.x.size() > 0; }
  bool hasOrder() const noexcept { return Samples.order.size() > 0; }
  const Eigen::VectorXd& fieldX() const noexcept { return FieldX; }
  const Eigen::VectorXd& fieldY() const noexcept { return FieldY; }
  const Eigen::VectorXd& time() const noexcept { return Time; }
  const std::vector<std::vector<int>>& neighbours() const noexcept { return Neighbours; }
  const std::vector<std::vector<Other>>& surround() const noexcept { return Surround; }
  // The distances that occur in a surround, in pitches, to 1e-7: few on a raster.
  const std::vector<double>& distances() const noexcept { return Distances; }

private:
  void placeInField();
  void findNeighbours();
  void findSurround(const std::vector<double>& nearest);

  WavelengthGrid Grid;
  SceneSamples Samples;
  std::vector<std::string> Media, Scenes;
  std::vector<int> MediumOf, SceneOf;
  Eigen::VectorXd FieldX, FieldY, Time;
  std::vector<std::vector<int>> Neighbours;
  std::vector<std::vector<Other>> Surround;
  std::vector<double> Distances;
};

} // namespace msi
