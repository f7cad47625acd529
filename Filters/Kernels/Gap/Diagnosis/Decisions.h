// The numbers by which the diagnosis decides. Documentation/Decisions/one-diagnosis.md has the reasons.
#pragma once

namespace msi::Decision
{

// The simulated camera is never exact: what is left of the gap beyond noise is systematic, and counts as this many
// independent numbers, however many samples there are; but as no more than there are groups.
inline constexpr double DiscrepancyNumbers = 50.0;

// And as this many where it is asked how sure the answer is.
inline constexpr double BeliefNumbers = 25.0;

// Part of the gap's energy that the forms of effects, approximations of physics, leave at the least.
inline constexpr double FormPart = 0.004;

// Minus the logarithm of the odds of an effect before the data speak.
inline constexpr double EffectImprobability = 3.0;

// And of each form of it, the more the later it stands in the library's list: the plain ones come first.
inline constexpr double FormImprobability = 1.0;

// And of a set with a parameter at the end of its range: the effect is stretched to stand for another.
inline constexpr double BoundImprobability = 3.0;

// Sets of each size that are kept on the way, and options fitted in full for each.
inline constexpr int BeamWidth = 3;
inline constexpr int OptionsFitted = 10;

// The search goes on with larger sets while the best of a size is no less likely than the best so far by this logarithm.
inline constexpr double Patience = 6.0;

// Logarithm of the probability by which a set with an equivalent effect may be less likely.
inline constexpr double EquivalentLog = 6.0;

// Probabilities of sets are raised to 1 / this: what the data hold is less independent than the criterion takes it to be.
inline constexpr double Temperature = 3.0;

// Part of the gap's energy that is left when a cause that the library does not have is as likely as none, and how fast that
// turns: the odds grow with this power of the rest.
inline constexpr double UnknownRest = 0.13;
inline constexpr double UnknownSteepness = 0.8;

} // namespace msi::Decision
