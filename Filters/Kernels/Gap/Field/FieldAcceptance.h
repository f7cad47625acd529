// When an effect counts.
#pragma once

#include "Kernels/Gap/Field/FieldHypothesis.h"

namespace msi
{

// What the tests of an effect refer to.
struct FieldAcceptance
{
  const FieldData& data;
  double gapEnergy = 0.0; // weighted, beyond noise, before any effect
  double price = 0.0;     // of a parameter, in energy

  double cost(const FieldFit& fit) const;
  // Whether `fit` takes the place of `current`: worth a parameter more, or significant from group to group with no more
  // parameters.
  bool mayReplace(const FieldFit& current, const FieldFit& fit) const;
  // Whether other effects, `fit`, take the place of those of `current`: worth a parameter more, and significant from
  // group to group; among many pairs some look better by chance.
  bool mayExchange(const FieldFit& current, const FieldFit& fit) const;
  // The last effect of `fit` beside those of `current`: significant from group to group, worth its parameters, and a relevant
  // part of the gap and of what is left of it. chance: what noise allows of the energies.
  bool mayJoin(const FieldFit& current, const FieldFit& fit, double chance) const;
  // An effect of `current` that `without` goes without.
  bool mayStay(const FieldFit& current, const FieldFit& without, double chance) const;
};

} // namespace msi
