// A chain of effects at work on the samples of a scene, stage by stage. Internal to the simulator.
#pragma once

#include "Kernels/Camera/Effects/EffectChain.h"
#include "Kernels/Camera/Effects/TailWeights.h"
#include "Kernels/Camera/SampleScene.h"

#include <Eigen/Core>

#include <memory>
#include <vector>

namespace msi
{

// Shapes: N wavelengths, K channels, S samples of the scene, P of them.
// Both are referred to, not copied.
class SceneRun
{
public:
  // Errors: std::invalid_argument for a scene on another grid or without what an effect needs.
  SceneRun(const EffectChain& chain, const SampleScene& scene);

  Eigen::MatrixXd reflected() const; // N x S
  Eigen::MatrixXd reflected(
    const std::vector<Eigen::Index>& samples) const;                // N x P, of these alone
  Eigen::MatrixXd integral() const;                                 // K x S
  Eigen::MatrixXd integral(const Eigen::MatrixXd& reflected) const; // K x P
  // With stray light and glare. tail: weights to use where they fit; those that were used.
  void illuminate(Eigen::MatrixXd& signal, std::shared_ptr<const TailWeights>& tail) const;
  void detect(Eigen::MatrixXd& signal) const;

private:
  void require() const;
  ColumnContext columns() const noexcept;

  const EffectChain& Chain;
  const SampleScene& Scene;
  std::vector<int> Medium; // of the chain, where it asks for it
};

} // namespace msi
