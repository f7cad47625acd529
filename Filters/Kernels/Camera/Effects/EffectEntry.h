// What a stage contributes to the effect library: definitions and how to make their operators.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Camera/Effects/BoundEffect.h"
#include "Kernels/Camera/Effects/EffectOperators.h"

#include <memory>
#include <vector>

namespace msi
{

// Exactly one factory is set, none for effects that the simulators treat themselves (noise, image).
struct EffectEntry
{
  EffectDefinition definition;
  std::unique_ptr<ResponsivityOperator> (*makeResponsivity)(const BoundEffect&) = nullptr;
  std::unique_ptr<BlockOperator> (*makeBlock)(const BoundEffect&) = nullptr;
  std::unique_ptr<SurroundOperator> (*makeSurround)(const BoundEffect&) = nullptr;
  bool afterDark = false; // a detector effect that acts on u with the dark response in it
};

template <typename Operator>
std::unique_ptr<ResponsivityOperator> makeResponsivityOperator(const BoundEffect& effect)
{
  return std::make_unique<Operator>(effect);
}
template <typename Operator>
std::unique_ptr<BlockOperator> makeBlockOperator(const BoundEffect& effect)
{
  return std::make_unique<Operator>(effect);
}
template <typename Operator>
std::unique_ptr<SurroundOperator> makeSurroundOperator(const BoundEffect& effect)
{
  return std::make_unique<Operator>(effect);
}

// The stages, each in the order in which its effects act.
std::vector<EffectEntry> reflectanceEffects();
std::vector<EffectEntry> responsivityEffects();
std::vector<EffectEntry> irradianceEffects();
std::vector<EffectEntry> gainEffects();     // detector, linear
EffectEntry sessionDrift();                 // detector
std::vector<EffectEntry> detectorEffects(); // detector, curve and offset
std::vector<EffectEntry> noiseEffects();
std::vector<EffectEntry> imageEffects();

// All of them; the definitions are those of effectLibrary(), at the same positions.
const std::vector<EffectEntry>& effectEntries();
const EffectEntry& entryOf(const EffectDefinition& definition);

} // namespace msi
