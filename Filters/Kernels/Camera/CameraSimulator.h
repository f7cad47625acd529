// A camera with everything that can be wrong with one, on sample tables.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraNoise.h"
#include "Kernels/Camera/SampleScene.h"

#include <Eigen/Core>

#include <cstdint>
#include <memory>
#include <vector>

namespace msi
{

struct CameraSimulatorOptions
{
  // The white calibration was made with the light and filters as they really were: after the effects of
  // the stage Responsivity every channel is scaled back to its nominal response to white.
  bool whiteAfterEffects = false;
};

// Response of a camera with effects.
//
// Order: reflectance effects -> M with its effects -> M r -> irradiance effects -> detector effects -> + b.
// With no effects, or all at neutral, the result is CameraResponse bit for bit.
// Errors: the constructor throws std::invalid_argument for an unknown effect, form or medium, a wrong
//         number of parameters, or a parameter out of bounds; respond() for a scene on another grid or
//         without what an effect needs.
// NaN in a sample stays in that sample; scene and neighbour means leave it out.
class CameraSimulator
{
public:
  CameraSimulator(
    CameraModel camera, std::vector<CameraEffect> effects, CameraSimulatorOptions options = {});
  ~CameraSimulator();
  CameraSimulator(CameraSimulator&&) noexcept;
  CameraSimulator& operator=(CameraSimulator&&) noexcept;

  // The responsivity with the lamp and filter effects in it, K x N.
  const Eigen::MatrixXd& effectiveResponsivity() const noexcept;

  // Noise-free response, K x S.
  Eigen::MatrixXd respond(const SampleScene& scene) const;

  // The noise of this camera: `noise` with the effect excess_noise in it.
  NoiseGenerator noiseGenerator(const CameraNoise& noise, std::uint64_t seed) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace msi
