// The response of a camera with effects that differ a little from response to response, as a fit asks for it.
#pragma once

#include "Kernels/Camera/CameraSimulator.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace msi
{

class EffectChain;
class SceneRun;
class TailWeights;

// CameraSimulator::respond, with what the light is after each stage kept. A response that is made from a related one
// takes over the stages before the first effect that is another; of an effect on one medium only the samples of that
// medium are done again. The numbers are those of CameraSimulator, bit for bit.
//
// Refers to the scene, which must outlive it.
// Errors: those of CameraSimulator.
class StagedResponse
{
public:
  StagedResponse(CameraModel camera, const SampleScene& scene, std::vector<CameraEffect> effects,
    CameraSimulatorOptions options = {});
  StagedResponse(const StagedResponse& related, std::vector<CameraEffect> effects,
    CameraSimulatorOptions options = {});
  ~StagedResponse();
  StagedResponse(const StagedResponse&) = delete;
  StagedResponse& operator=(const StagedResponse&) = delete;
  StagedResponse(StagedResponse&&) noexcept;
  StagedResponse& operator=(StagedResponse&&) noexcept;

  const Eigen::MatrixXd& response() const noexcept { return *Detected; } // K x S

private:
  using Stage = std::shared_ptr<const Eigen::MatrixXd>;

  void respond(const StagedResponse* related);
  void reflectAndIntegrate(const SceneRun& run, const StagedResponse* related);

  const SampleScene* Scene;
  std::unique_ptr<const EffectChain> Chain;
  Stage Reflected; // N x S; empty: the scene's own, or not kept
  Stage Integral;  // K x S, as the rest
  Stage Illuminated;
  std::shared_ptr<const TailWeights> Tail; // of the stray light; empty: none used yet
  Stage Detected;
};

} // namespace msi
