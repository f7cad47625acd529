// The numbers by which the diagnosis decides. Documentation/Decisions/one-diagnosis.md has the reasons.
#pragma once

namespace msi::Decision
{

// The simulated camera is never exact: what is left of the gap beyond noise is systematic, and counts as this many
// independent numbers, however many samples there are; but as no more than there are groups.
inline constexpr double DiscrepancyNumbers = 50.0;

// And as this many where it is asked how sure the answer is.
inline constexpr double BeliefNumbers = 25.0;

// Standard deviation of a number of an effect before the data speak, in typical sizes.
inline constexpr double FreeSpread = 10.0;

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

// Of the gap's size, that the causes found must take away.
inline constexpr double ExplainedShrink = 0.85;
inline constexpr double PartlyShrink = 0.25;

// Where channel and level alone predict this part of what all axes predict, the other axes are asked only for contrasts.
inline constexpr double ContrastPart = 0.9;

// Of the gap's energy: an axis with less is not named.
inline constexpr double LeastAxis = 0.005;

// Of what all causes together get: one that gets less is none.
inline constexpr double LeastPart = 0.03;

} // namespace msi::Decision

// Of tables. Energies are weighted sums of squares; a dispersion is the energy that one residual has by chance.
namespace msi::TableDecision
{

// What do effects look like before the data speak?
inline constexpr double SecondarySpread = 2.0; // typical sizes, of a secondary parameter
inline constexpr double FormTolerance = 0.03;  // of the gap: forms are approximations
inline constexpr double HuberCut = 5.0;        // median residuals

// How much of what a cause does is believed?
inline constexpr double LeastPartPerChannel =
  0.1; // of the causes together: every camera has small errors in its channels
// Of what samples left out cannot confirm; of scatter beyond the noise model where an error of each sample looks the same.
inline constexpr double Unconfirmed = 0.4;

// Is there a gap at all?
inline constexpr double SureDeviations =
  4.0; // standard errors, of what the axes predict and of excess variance
inline constexpr double PredictablePart = 0.1;     // of the noise energy
inline constexpr double UnpredictableFactor = 1.3; // times the noise floor
inline constexpr double NegligiblePart = 0.25;     // of what is left
inline constexpr double Integrations = 2.0;        // times the variance of the sums over wavelength
inline constexpr double MostOfIt = 0.5;            // of what the causes take away
inline constexpr double NearlyAll = 0.8;           // of a change's energy in few samples
inline constexpr double FewSamples = 0.02;         // of all
inline constexpr double ExcessVariance =
  1.2; // times the noise model's: below it the model counts as right
// Deviation that all channels of a sample may share, by its placement and its reflectance, where the noise is not known. Measured
// samples of paper and cotton show .003 to .0057.
inline constexpr double SampleScatter = 0.006;
inline constexpr double EqualReadings =
  0.01; // of all readings at the largest value: they look clipped

} // namespace msi::TableDecision

// Of image pairs.
namespace msi::ImageDecision
{

inline constexpr double LeastClip = 0.7; // of a clipping that is one
inline constexpr double Indistinct =
  0.5; // standard error over typical size: the scene does not show the effect

// What do effects look like before the data speak?
inline constexpr double TolerancePart = 0.05; // of the gap: forms are approximations
inline constexpr double HuberDeviations = 6.0;

// Is there a gap at all, and is it explained?
inline constexpr double UnexplainedRms = 1.1;    // of the noise floor
inline constexpr double UnexplainedBlocks = 2.0; // squared block means over what noise allows
inline constexpr double ExplainedBlocks = 1.5;

} // namespace msi::ImageDecision
