// Second thoughts of a search: other forms, other effects, fewer of them.
#pragma once

#include "Kernels/Gap/Field/FieldSearchState.h"

#include <optional>
#include <vector>

namespace msi
{

class FieldRevision : public FieldSearchState
{
protected:
  using FieldSearchState::FieldSearchState;

  // Another form of the effect that came last: what a form leaves over is not to be taken for another effect.
  void chooseForm();
  // Puts another effect or form in the place of each, and a simpler form in the place of one more. True where it did.
  bool exchange();
  // Takes an effect out that does not stand any more. True where it did.
  bool drop();
  // Stripes of any shape may have a trend, which was taken for light up to here, and mended as such.
  void tryTrend();

private:
  // Keeps in `best` the cheapest fit that is worth more than the price.
  void consider(FieldFit fit, std::optional<FieldFit>& best) const;
  // Goes on from it where it is still worth that when refitted. True where it did.
  bool takeOver(const std::optional<FieldFit>& best);
  // Vignetting about a center off the middle in the place of vignetting with a gradient, and the other way round.
  std::vector<FieldSet> otherLight() const;
  // The set with a form of fewer parameters in the place of one.
  std::vector<FieldSet> simpler(const FieldSet& set) const;
};

} // namespace msi
