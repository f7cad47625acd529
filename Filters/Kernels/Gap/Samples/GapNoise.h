// How large a gap noise alone allows.
#pragma once

#include "Kernels/Gap/Samples/GapData.h"

#include <string>
#include <vector>

namespace msi
{

// Larger standard deviations of measured reflectances are an error of their own.
constexpr double LargestReflectanceNoise = 0.003;

// What was found about the noise of one reading.
struct NoiseFinding
{
  ReadingNoise reading;          // the model the diagnosis goes by
  bool fromRepeats = false;      // fitted to the repeats
  bool unknown = false;          // no model and no repeats: set from the gap itself later
  bool unrepeated = false;       // the excess is read off what the effects leave, not off repeats
  double excess = 1.0;           // standard deviation of the readings over the given model's
  double excessDeviations = 0.0; // (excess^2 - 1) over its standard error
  double degrees = 0.0;          // of freedom in the repeats
};

// Noise model of one reading from the given model and the repeats.
//
// Repeats that scatter more than the given model by a significant part overrule it (excess_noise).
// Without a model the repeats' variances are fitted by read^2 + shot^2 u, weighted, not negative.
NoiseFinding findNoise(const GapData& data, const std::optional<ReadingNoise>& given);

// Variance of the averaged readings; K x S.
Eigen::MatrixXd readingVariance(const GapData& data, const ReadingNoise& noise);

// Squared standard deviation that a reflectance error of 1 (independent from wavelength to wavelength)
// has in each channel; K.
Eigen::VectorXd reflectanceErrorGain(const CameraModel& camera);

// Squared size of what a plain sum over the grid may miss, K x S: the difference to the integral of the interpolated
// responsivity times the interpolated reflectance; that between straight lines and curves through the reflectance
// (both zero on grids of 2 nm or finer); and, where the camera sees wavelengths at which no reflectance was measured,
// the difference between holding the end value and going on along its slope.
Eigen::MatrixXd integrationVariance(const GapData& data, const WavelengthGrid& measured);

} // namespace msi
