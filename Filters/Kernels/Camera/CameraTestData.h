// A camera and a scene that the tests of this room share.
#pragma once

#include "Kernels/Camera/CameraDesign.h"
#include "Kernels/Camera/CameraSimulator.h"
#include "Kernels/Numerics/CounterRandom.h"
#include "Kernels/Numerics/NumericsTestData.h"

#include <Eigen/Core>

#include <string>
#include <utility>
#include <vector>

namespace msi::test
{

inline WavelengthGrid visibleGrid()
{
  return WavelengthGrid::uniform(400.0, 700.0, 10.0);
}

// Seven channels of 40 nm at 430, 470, ..., 670 nm; a perfect white gives one above the dark response.
inline CameraModel sevenChannels()
{
  CameraParts parts;
  parts.light = planckianLight(visibleGrid(), 3000.0);
  parts.detector = siliconDetector(visibleGrid());
  for (int k = 0; k < 7; ++k)
  {
    parts.filters.push_back({ 430.0 + 40.0 * k, 40.0, 2.0 });
  }
  const CameraModel camera = designCamera(visibleGrid(), parts);
  return camera.with(camera.responsivity(), Eigen::VectorXd::LinSpaced(7, 0.004, 0.010));
}

// Smooth reflectances on a raster of 8 columns: media paper and fabric in turn, the left half in scene a.
inline SceneSamples rasterSamples(Eigen::Index count = 48)
{
  const WavelengthGrid grid = visibleGrid();
  const CounterRandom random(20);
  SceneSamples samples;
  samples.reflectance.resize(grid.size(), count);
  samples.x.resize(count);
  samples.y.resize(count);
  samples.order.resize(count);
  for (Eigen::Index s = 0; s < count; ++s)
  {
    const auto index = static_cast<std::uint64_t>(s);
    const double center = 400.0 + 300.0 * random.uniform(index, 0);
    const double height = 0.75 * random.uniform(index, 1);
    samples.reflectance.col(s) =
      0.05 + height * (-((grid.vector().array() - center) / 60.0).square()).exp();
    samples.medium.push_back(s % 2 == 0 ? "paper" : "fabric");
    samples.scene.push_back(s % 8 < 4 ? "a" : "b");
    samples.x[s] = 10.0 * static_cast<double>(s % 8);
    samples.y[s] = 10.0 * static_cast<double>(s / 8);
    samples.order[s] = static_cast<double>(s);
  }
  return samples;
}

inline SampleScene rasterScene(Eigen::Index count = 48)
{
  return { visibleGrid(), rasterSamples(count) };
}

inline Eigen::MatrixXd responseWith(
  std::vector<CameraEffect> effects, bool whiteAfterEffects = false)
{
  return CameraSimulator(sevenChannels(), std::move(effects), { whiteAfterEffects })
    .respond(rasterScene());
}

} // namespace msi::test
