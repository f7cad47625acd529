// Where a search for effects stands, and the steps that it takes.
#pragma once

#include "Kernels/Gap/Field/FieldAcceptance.h"
#include "Kernels/Gap/Field/FieldHypothesis.h"
#include "Kernels/Gap/Field/FieldSearch.h"
#include "Kernels/Gap/Field/FieldShift.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

class FieldSearchState
{
public:
  // Holds references.
  FieldSearchState(
    const FieldData& data, const std::vector<FieldChoice>& choices, const FieldLoop& loop);

  FieldSearchResult result() const;

protected:
  const FieldData& Data;
  const std::vector<FieldChoice>& Choices;
  const FieldLoop& Loop;
  FieldStart Start; // of misregistration
  FieldHypothesis Current;
  bool KeepTrend = false; // of the profiles of stripes
  FieldSearchResult Result;

  FieldAcceptance acceptance() const { return { Data, Result.gapEnergy, Result.price }; }
  double cost(const FieldFit& fit) const { return acceptance().cost(fit); }
  FieldHypothesis refit(const FieldSet& set, const FieldModel& start) const
  {
    return refitted(Data, Result.weights, set, start, Loop);
  }
  // Beside the effects of `set`, with a start where it needs one.
  bool available(const FieldSet& set, const FieldChoice& choice) const;
  // What bends the curve does not clip: false where the hypothesis has a saturation that does.
  static bool clips(const FieldHypothesis& hypothesis);
  // With the starts that Current has for stripes and clipping.
  FieldStatistics nominalStatistics() const;
  // Looks for stripes and clipping in what is left.
  void findStarts();
  // Goes on from here, with weights for what is left.
  void accept(const FieldHypothesis& hypothesis);

private:
  Eigen::ArrayXd Limit; // of residuals, at the nominal model

  void findProfiles(FieldModel& model, const FieldSet& set) const;
  void measureNominal();
  void setPrice(const FieldFitter& fitter);
};

} // namespace msi
