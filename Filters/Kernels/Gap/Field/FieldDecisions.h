// The numbers by which the diagnosis of image pairs decides. Energies are weighted sums of squares over blocks; deviations
// are those from group to group of blocks.
#pragma once

namespace msi::ImageDecision
{

// Is an effect significant? From a tenth of what is left to all of it less and less is asked for: an effect that clears
// what is left may concern few blocks, as saturation does.
inline constexpr double Significant = 3.0;             // deviations
inline constexpr double SignificantWhereCleared = 2.0; // or where one takes another's place
inline constexpr double Cleared = 0.8;                 // of the energy beyond noise
inline constexpr double StaysIn = 0.85; // of the deviations, for an effect that is there

// Is an effect worth its parameters?
inline constexpr double PricePart = 0.0005;       // of the gap's energy, a parameter
inline constexpr double LargestPricePart = 0.001; // of all energy
inline constexpr double PriceOfEffect = 3.0;      // prices
inline constexpr double RelevantPart = 0.01;      // of the gap's energy
inline constexpr double RelevantOfRest = 0.1;     // and of what is left of it
inline constexpr double MostOfRest =
  0.5; // this alone will do where what is left is not much less than noise
inline constexpr double BesideNoise = 0.5; // of what noise allows
inline constexpr double OverNoise = 0.1;   // of it, where an effect clears what is left
inline constexpr double RelevantBesides =
  0.03; // of the gap's energy, where an effect of the edges is there
inline constexpr double LeastClip = 0.7; // of a clipping that is one

// How far does the search go?
inline constexpr double Tolerated = 0.01;  // of the gap's energy, on the way to a simpler form
inline constexpr double NothingLeft = 0.1; // of what noise allows
inline constexpr double Indistinct =
  0.5; // standard error over typical size: the scene does not show the effect

// What do effects look like before the data speak?
inline constexpr double PriorSize = 10.0;     // typical sizes
inline constexpr double TolerancePart = 0.05; // of the gap: forms are approximations
inline constexpr double HuberDeviations = 3.0;

// Can effects be told apart?
inline constexpr double EquivalentPart =
  0.02; // of the gap's energy by which an equivalent may cost more
inline constexpr double EquivalentPrices = 3.0; // and prices

// Is there a gap at all, and is it explained?
inline constexpr double UnexplainedRms = 1.1;    // of the noise floor
inline constexpr double UnexplainedBlocks = 2.0; // squared block means over what noise allows
inline constexpr double ExplainedBlocks = 1.5;
inline constexpr double ExactDoubt =
  0.5; // of causes that are exact: what they leave has another cause

} // namespace msi::ImageDecision
