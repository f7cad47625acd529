// The numbers by which the diagnosis of tables decides. Energies are weighted sums of squares; a dispersion is the energy
// that one residual has by chance.
#pragma once

#include <cstddef>

namespace msi::TableDecision
{

// Is an effect worth its parameters?
inline constexpr double ChanceOfMany =
  14.0; // dispersions that the best of some fifty useless effects stays below
inline constexpr double RelevantPart =
  0.004;                                  // of the gap's energy: below it nothing is worth a cause
inline constexpr double FormPart = 0.002; // of the gap's energy that a parameter must be worth
inline constexpr double UnlikelyForm =
  2.0; // dispersions: a form is e times less likely than the one before it
inline constexpr double IdlePart =
  0.001; // of the gap's energy: an effect that does less beside the others is dropped

// Which form of an effect?
inline constexpr double RicherFormPart =
  0.0002; // of the gap's energy that each further parameter must gain
inline constexpr double FormDeviations = 4.0; // dispersions by which another form must be better
inline constexpr double SimplerPart =
  0.02; // of the gap's energy by which a simpler cause may be worse
inline constexpr double SimplerDeviations = 9.0; // and dispersions

// How far does the search go?
inline constexpr double AlikePart =
  0.05;                               // of the smaller change's energy, by which two changes differ
inline constexpr int FormsFitted = 2; // of one effect
inline constexpr int MostExchanges = 3;   // rounds
inline constexpr int ExchangesFitted = 3; // for each effect that may go
inline constexpr int ExchangesFormed = 6; // the best of a round in the forms that suit them
inline constexpr double HopefulScreen =
  2.0; // times the present cost, above which an exchange is not fitted
inline constexpr double HopefulFit = 1.25;        // and above which its forms are not tried
inline constexpr double WorthAnotherRound = 0.95; // of the cost before
inline constexpr double NoiseLeft = 1.1;          // times the noise: nothing is left to do better

// What do effects look like before the data speak?
inline constexpr double FreeSpread = 10.0;     // typical sizes, of a primary parameter
inline constexpr double SecondarySpread = 2.0; // of a secondary one
inline constexpr double FormTolerance = 0.03;  // of the gap: forms are approximations
inline constexpr double HuberCut = 5.0;        // median residuals

// Can effects be told apart?
inline constexpr int AlternativesFitted = 8;
inline constexpr double EquivalentPart =
  0.02; // of the gap's energy by which an equivalent may cost more
inline constexpr double EquivalentDeviations = 9.0; // and dispersions

// How much of what a cause does is believed?
inline constexpr double AlikeDoubt = 0.5; // of what other effects on the same medium do alike
inline constexpr double RefutedDeviations =
  4.0; // dispersions by which a plain gain must be better than a drift
inline constexpr double UnconfirmedShare = 0.4; // of what samples left out cannot confirm
inline constexpr double UnrepeatedShare =
  0.4; // of scatter beyond the noise model: an error of each sample looks the same
inline constexpr int CommonDirections = 4; // of a curve over the channels
inline constexpr double StructuredChance =
  0.003; // probability below which numbers of channels follow a curve

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
inline constexpr double EqualReadings =
  0.01; // of all readings at the largest value: they look clipped

} // namespace msi::TableDecision
