#include "DemoCamera.h"

#include "Kernels/Camera/CameraDesign.h"
#include "Kernels/Numerics/CounterRandom.h"
#include "Kernels/Scenes/Measuring.h"

#include <string>

namespace msi::scenes
{

CameraModel demoCamera(double shift)
{
  constexpr std::uint64_t Seed = 16;
  const WavelengthGrid grid = sceneGrid();
  const CounterRandom tolerance(Seed);
  CameraParts parts;
  parts.light = planckianLight(grid, 2900.0);
  parts.detector = siliconDetector(grid);
  for (int k = 0; k < 16; ++k)
  {
    const auto [center, width] = tolerance.normalPair(static_cast<std::uint64_t>(k));
    BandpassFilter filter;
    filter.center = 400.0 + 20.0 * k + 0.7 * center + shift;
    filter.width = 18.0 + 0.8 * width;
    filter.order = 4.0;
    filter.peak = 0.6;
    parts.filters.push_back(filter);
    parts.channels.push_back(std::to_string(400 + 20 * k) + "nm");
  }
  return designCamera(grid, parts);
}

CameraNoise pixelNoise()
{
  CameraNoise noise;
  noise.read = 0.0008;
  noise.shot = 0.0045;
  noise.fixedPatternGain = 0.002;
  noise.fixedPatternOffset = 0.0004;
  return noise;
}

CameraNoise patchNoise()
{
  CameraNoise noise;
  noise.read = 0.0006;
  noise.shot = 0.0012;
  return noise;
}

} // namespace msi::scenes
