#include "DemoCapture.h"

#include "DemoCamera.h"
#include "Kernels/Scenes/Measuring.h"
#include "Kernels/Scenes/Samples.h"

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Numerics/CounterRandom.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <utility>

namespace msi::scenes
{

namespace
{
enum Stream : std::uint32_t
{
  Order = 31,
  Repeatability
};

constexpr std::uint64_t Seed = 3110;
constexpr int Papers = 24;
constexpr int Fabrics = 96;
constexpr int Columns = 12;
constexpr int Repeats = 2;
constexpr double Spacing = 40.0;    // pixels
constexpr double WarmFilters = 1.6; // nm
constexpr double LampGain = 0.03;
constexpr double LampTime = 0.35; // of the session
constexpr double FabricLight = 0.95;
constexpr double RepeatabilityOfReading = 0.0005;

// Place in the capture order of each sample, 0 first.
std::vector<int> shuffled(int count)
{
  const CounterRandom random(Seed, Order);
  std::vector<int> samples(static_cast<std::size_t>(count));
  std::iota(samples.begin(), samples.end(), 0);
  std::stable_sort(samples.begin(), samples.end(),
    [&random](int a, int b)
    {
      return random.uniform(static_cast<std::uint64_t>(a)) <
        random.uniform(static_cast<std::uint64_t>(b));
    });
  return samples;
}

// Readings every 10 nm of spectra known every 5 nm, corrected for the instrument's passband.
Eigen::MatrixXd measured(const WavelengthGrid& grid, const Eigen::MatrixXd& spectra)
{
  const CounterRandom noise(Seed, Repeatability);
  Eigen::MatrixXd result(grid.size(), spectra.cols());
  for (Eigen::Index s = 0; s < spectra.cols(); ++s)
  {
    for (Eigen::Index j = 0; j < grid.size(); ++j)
    {
      const auto index = static_cast<std::uint64_t>(s * grid.size() + j);
      result(j, s) = spectra(2 * j, s) + RepeatabilityOfReading * noise.normal(index);
    }
  }
  return result;
}
}

DemoCapture demoCapture()
{
  const WavelengthGrid grid = sceneGrid();
  const Swatches paper = printedChart(grid, Papers, Seed);
  const Swatches fabric = dyedFabric(grid, Fabrics, Seed);
  constexpr int Count = Papers + Fabrics;
  Eigen::MatrixXd spectra(grid.size(), Count);
  spectra << paper.body, fabric.body;

  DemoCapture capture{ demoCamera(), patchNoise(), {}, {}, Eigen::VectorXd(Count),
    Eigen::VectorXd(Count), Eigen::VectorXd(Count),
    WavelengthGrid::uniform(grid.front(), grid.back(), 10.0), {}, {}, {}, {} };
  capture.reflectance = measured(capture.wavelengths, spectra);
  Eigen::MatrixXd answered = cameraResponse(demoCamera(WarmFilters))(spectra);
  const std::vector<int> place = shuffled(Count);
  for (int i = 0; i < Count; ++i)
  {
    const bool isPaper = i < Papers;
    capture.sample.push_back(isPaper ? paper.name[static_cast<std::size_t>(i)]
                                     : fabric.name[static_cast<std::size_t>(i - Papers)]);
    capture.medium.emplace_back(isPaper ? "paper" : "fabric");
    const int cell = place[static_cast<std::size_t>(i)];
    capture.x[i] = Spacing * (cell % Columns + 1);
    capture.y[i] = Spacing * (cell / Columns + 1);
    // Captured row by row, every other row backwards.
    const int row = cell / Columns;
    const int column = row % 2 == 0 ? cell % Columns : Columns - 1 - cell % Columns;
    const int turn = row * Columns + column;
    capture.order[i] = turn + 1;
    const double time = static_cast<double>(turn) / (Count - 1);
    answered.col(i) *=
      (1.0 + LampGain * (1.0 - std::exp(-time / LampTime))) * (isPaper ? 1.0 : FabricLight);
  }
  capture.readings.resize(answered.rows(), static_cast<Eigen::Index>(Count) * Repeats);
  for (int i = 0; i < Count; ++i)
  {
    for (int repeat = 0; repeat < Repeats; ++repeat)
    {
      capture.readings.col(i * Repeats + repeat) = answered.col(i);
      capture.readingSample.push_back(capture.sample[static_cast<std::size_t>(i)]);
      capture.readingRepeat.push_back(std::to_string(repeat + 1));
    }
  }
  NoiseGenerator{ patchNoise(), Seed }(capture.readings, 0);
  return capture;
}

} // namespace msi::scenes
