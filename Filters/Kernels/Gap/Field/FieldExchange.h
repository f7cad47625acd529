// Third thoughts of a search: two effects at once in the place of one or two.
#pragma once

#include "Kernels/Gap/Field/FieldRevision.h"

#include <vector>

namespace msi
{

// A set that grew effect by effect may hold one that stands for two: a curve of the detector and an offset look like another curve
// and a gain. Effect by effect there is no way back from it.
class FieldExchange : public FieldRevision
{
protected:
  using FieldRevision::FieldRevision;

  // Puts up to two effects in the place of up to two. True where it did.
  bool exchangePairs(int maximumEffects);

private:
  // Each effect that is new would also join the others.
  bool newOnesCount(const FieldHypothesis& hypothesis) const;
  // The best sets by linear prediction from a fitter's model, each with other effects, that cost less than `most`.
  std::vector<FieldFit> promising(
    const FieldFitter& fitter, double most, std::size_t largest) const;
  // `rest` with one or two more effects.
  void extend(const FieldFitter& fitter, const FieldSet& rest, std::vector<FieldFit>& found) const;
};

} // namespace msi
