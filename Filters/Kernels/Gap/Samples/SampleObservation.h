// A table of samples as the diagnosis sees it.
#pragma once

#include "Kernels/Gap/Diagnosis/Observation.h"
#include "Kernels/Gap/Samples/EffectFit.h"

#include <cstdint>
#include <vector>

namespace msi
{

class SampleFit : public ObservedFit
{
public:
  EffectSet effects;
};

// Samples are the groups; only those for training are looked at.
class SampleObservation : public Observation
{
public:
  // Hold references to data.
  SampleObservation(const GapData& data, SampleList training,
    const std::vector<EffectChoice>& choices, std::uint64_t seed);

  // Forms with several starting points keep the best; steps in time start where the cumulative sums of the residual break.
  std::vector<GapPreview> previews(const ObservedFit& from) const override;
  FitPointer extended(const ObservedFit& from, const GapPreview& with) const override;
  FitPointer reduced(const ObservedFit& from, std::size_t positions) const override;
  GroupEnergies energies(const ObservedFit& fit) const override;
  std::vector<std::vector<GapParameter>> parameters(const ObservedFit& fit) const override;

  const EffectFitter& fitter() const noexcept { return Fitter; }
  // The fit as it was found, and taken to the end.
  EffectFit linearised(const ObservedFit& fit) const;
  EffectFit whole(const ObservedFit& fit) const;
  GroupEnergies energies(const EffectFit& fit) const;

private:
  void describe(ObservedFit& described, const EffectFit& fit, const Eigen::VectorXd& step) const;
  FitPointer described(EffectFit fit, std::vector<std::size_t> set) const;

  EffectFitter Fitter;
  std::vector<EffectChoice> Choices;
};

} // namespace msi
