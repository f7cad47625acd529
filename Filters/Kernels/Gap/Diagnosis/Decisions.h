// The numbers by which the diagnosis decides, of tables and of image pairs. Documentation/Decisions/one-diagnosis.md has the
// reasons, and what happens when each is halved or doubled.
#pragma once

namespace msi::Decision
{

// Which set of effects?

// The simulated camera is never exact: what is left of the gap beyond noise is systematic, and counts as this many
// independent numbers, however many samples there are; but as no more than there are groups.
inline constexpr double DiscrepancyNumbers = 50.0;

// And as this many where it is asked how sure the answer is.
inline constexpr double BeliefNumbers = 25.0;

// In both cases at least as this many for each number that an effect needs for a channel: otherwise few samples could not show
// the errors of many single channels.
inline constexpr double DiscrepancyPerChannel = 1.5;

// Standard deviation of a number of an effect in a fit before the data speak, in typical sizes.
inline constexpr double FreeSpread = 10.0;

// Part of the gap's energy that the forms of effects, approximations of physics, leave at the least. A fit does not
// count on less, and an axis with less is not named.
inline constexpr double FormPart = 0.004;

// Residuals beyond this many standard deviations count less in a fit.
inline constexpr double OutlierDeviations = 6.0;

// Minus the logarithm of the odds of an effect before the data speak.
inline constexpr double EffectImprobability = 5.0;

// And of each form of it, the more the later it stands in the library's list: the plain ones come first.
inline constexpr double FormImprobability = 1.0;

// Logarithm of odds beyond which a set is out of the question: the search does not go on from it, its effects are not equivalent.
inline constexpr double DecisiveOdds = 6.0;

// Of an effect that seems to stand for another: a parameter at the end of its range, an effect of a medium that all of several media
// have, a gain in disguise. It is also the price of what a linear fit leaves of a curve: every camera that was fitted so has some.
inline constexpr double StandIn = 0.5 * DecisiveOdds;

// How sure?

// Probabilities of sets are raised to 1 / this: what the data hold is less independent than the criterion takes it to be.
inline constexpr double Temperature = 2.0;

// Part of the gap's size that is left when a cause that the library does not have is as likely as none; the odds are proportional to it.
inline constexpr double UnknownRest = 1.0 / 3.0;

// Of what samples left out cannot confirm; of scatter beyond the noise model where an error of each sample looks the same.
inline constexpr double Unconfirmed = 0.4;

// What counts?

// Of the gap's size, that the causes found must take away.
inline constexpr double ExplainedShrink = 0.85;
inline constexpr double PartlyShrink = 0.25;

// Of what all causes together get: one that gets less is none.
inline constexpr double LeastPart = 0.03;

// Small beside the whole: what is predicted or explained, beside the noise or what is left. All but this part is nearly all.
inline constexpr double SmallPart = 0.1;

// Numbers of single channels that get less are none, since every camera has small errors in its channels; but for effects that
// need an image, which a pattern tells from everything else.
inline constexpr double LeastPartPerChannel = 2.0 * SmallPart;

// Is there a gap beyond noise?

// Standard errors, of what is sure.
inline constexpr double SureDeviations = 4.0;

// Root mean square over that of the noise.
inline constexpr double BeyondNoise = 1.2;

// Errors that are themselves estimated, of sums over wavelength and of means of blocks, may have this much more energy.
inline constexpr double EstimateFactor = 2.0;

} // namespace msi::Decision
