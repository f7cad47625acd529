// Second thoughts of a search: other forms, other effects, fewer of them.
#pragma once

#include "Kernels/Gap/Field/FieldSearchState.h"

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
  // Vignetting about a center off the middle in the place of vignetting with a gradient, and the other way round.
  std::vector<FieldSet> otherLight() const;
  // The set with a form of fewer parameters in the place of one.
  std::vector<FieldSet> simpler(const FieldSet& set) const;
};

} // namespace msi
