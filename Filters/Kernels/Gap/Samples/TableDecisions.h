// The numbers by which the diagnosis of tables decides. Energies are weighted sums of squares; a dispersion is the energy
// that one residual has by chance.
#pragma once

namespace msi::TableDecision
{

// What do effects look like before the data speak?
inline constexpr double FreeSpread = 10.0;     // typical sizes, of a primary parameter
inline constexpr double SecondarySpread = 2.0; // of a secondary one
inline constexpr double FormTolerance = 0.03;  // of the gap: forms are approximations
inline constexpr double HuberCut = 5.0;        // median residuals

// How much of what a cause does is believed?
inline constexpr double LeastPartPerChannel =
  0.1; // of the causes together: every camera has small errors in its channels
inline constexpr double UnconfirmedShare = 0.4; // of what samples left out cannot confirm
inline constexpr double UnrepeatedProbability =
  0.4; // of scatter beyond the noise model: an error of each sample looks the same

// Is there a gap at all?
inline constexpr double PredictableDeviations = 4.0; // standard errors of what the axes predict
inline constexpr double PredictablePart = 0.1;       // of the noise energy
inline constexpr double UnpredictableFactor = 1.3;   // times the noise floor
inline constexpr double NegligiblePart = 0.25;       // of what is left
inline constexpr double Integrations = 2.0; // times the variance of the sums over wavelength
inline constexpr double MostOfIt = 0.5;     // of what the causes take away
inline constexpr double NearlyAll = 0.8;    // of a change's energy in few samples
inline constexpr double FewSamples = 0.02;  // of all
inline constexpr double ExcessVariance =
  1.2; // times the noise model's: below it the model counts as right
inline constexpr double ExcessDeviations = 4.0;
// Deviation that all channels of a sample may share, by its placement and its reflectance, where the noise is not known. Measured
// samples of paper and cotton show .003 to .0057.
inline constexpr double SampleScatter = 0.006;
inline constexpr double EqualReadings =
  0.01; // of all readings at the largest value: they look clipped

} // namespace msi::TableDecision
