// A pair of images as the diagnosis sees it.
#pragma once

#include "Kernels/Gap/Diagnosis/Observation.h"
#include "Kernels/Gap/Field/FieldFit.h"
#include "Kernels/Gap/Field/FieldStarts.h"

#include <Eigen/Core>

#include <map>
#include <optional>
#include <string>
#include <vector>

namespace msi
{

class FieldObservedFit : public ObservedFit
{
public:
  FieldHypothesis hypothesis;
  // Once they are asked for: with the starts that its residual shows; without some of its effects.
  mutable std::optional<FieldHypothesis> started;
  mutable std::map<std::size_t, FitPointer> reduced;
};

// Groups of training blocks are the groups. A fit's residual is looked at for stripes, clipping and displacements before
// options are previewed; what is found is where their fits start.
class FieldObservation : public Observation
{
public:
  // Hold references.
  FieldObservation(const FieldData& data, const std::vector<FieldChoice>& choices,
    const FieldWeights& weights, const std::vector<ImageDisplacement>& start);

  std::vector<GapPreview> previews(const ObservedFit& from) const override;
  FitPointer extended(const ObservedFit& from, const GapPreview& with) const override;
  FitPointer reduced(const ObservedFit& from, std::size_t positions) const override;
  GroupEnergies energies(const ObservedFit& fit) const override;
  std::vector<std::vector<GapParameter>> parameters(const ObservedFit& fit) const override;

private:
  // With starts for stripes and clipping that its residual shows.
  const FieldHypothesis& started(const ObservedFit& fit) const;
  void describe(ObservedFit& described, const FieldSet& set, const FieldFit& fit) const;
  FitPointer described(FieldHypothesis hypothesis) const;
  void findProfiles(FieldModel& model, const std::vector<FieldResidual>& residuals,
    const FieldSet& set, bool keepTrend) const;
  // With the terms of the choice where the images were seen to lie.
  FieldModel registered(const FieldModel& model, const FieldChoice& choice) const;
  // Whether the model has the start that it needs.
  static bool hasStart(const FieldModel& model, const FieldChoice& choice);

  const FieldData& Data;
  const std::vector<FieldChoice>& Choices;
  const FieldWeights& Weights;
  const std::vector<ImageDisplacement>& Start; // of each channel; empty: none is moved far
};

} // namespace msi
