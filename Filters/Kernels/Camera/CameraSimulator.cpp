#include "Kernels/Camera/CameraSimulator.h"

#include "Kernels/Camera/Effects/EffectChain.h"
#include "Kernels/Camera/Effects/SceneRun.h"

#include <utility>

namespace msi
{

struct CameraSimulator::Implementation
{
  EffectChain Chain;
};

CameraSimulator::CameraSimulator(
  CameraModel camera, std::vector<CameraEffect> effects, CameraSimulatorOptions options)
  : Self(new Implementation{
      EffectChain(std::move(camera), std::move(effects), options.whiteAfterEffects) })
{
}

CameraSimulator::~CameraSimulator() = default;
CameraSimulator::CameraSimulator(CameraSimulator&&) noexcept = default;
CameraSimulator& CameraSimulator::operator=(CameraSimulator&&) noexcept = default;

const Eigen::MatrixXd& CameraSimulator::effectiveResponsivity() const noexcept
{
  return Self->Chain.responsivity();
}

Eigen::MatrixXd CameraSimulator::respond(const SampleScene& scene) const
{
  const SceneRun run(Self->Chain, scene);
  Eigen::MatrixXd response = run.integral();
  std::shared_ptr<const TailWeights> tail;
  run.illuminate(response, tail);
  run.detect(response);
  return response;
}

NoiseGenerator CameraSimulator::noiseGenerator(const CameraNoise& noise, std::uint64_t seed) const
{
  return Self->Chain.noiseGenerator(noise, seed);
}

} // namespace msi
