// How large a gap noise alone allows.
#pragma once

#include "Kernels/Gap/Samples/GapData.h"

#include <string>
#include <vector>

namespace msi
{

// Larger standard deviations of measured reflectances are an error of their own.
constexpr double LargestReflectanceNoise = 0.003;

// Deviation that all channels of a sample may share, by its placement and its reflectance. Measured samples of paper and
// cotton show .003 to .0057.
constexpr double SampleScatter = 0.006;

// Standard deviation of normal values of mean 0, by the median of their sizes.
double robustDeviation(std::vector<double> values);

// What was found about the noise of one reading.
struct NoiseFinding
{
  CameraNoise reading;           // the model the diagnosis goes by
  bool fromRepeats = false;      // fitted to the repeats
  bool unknown = false;          // no model and no repeats: set from the gap itself later
  bool unrepeated = false;       // the excess is read off what the effects leave, not off repeats
  double excess = 1.0;           // standard deviation of the readings over the given model's
  double excessDeviations = 0.0; // (excess^2 - 1) over its standard error
  double degrees = 0.0;          // of freedom in the repeats
  double shown = 1.0;            // standard deviation of the repeats over the given model's
};

// Noise model of one reading from the given model and the repeats.
//
// Repeats that scatter more than the given model by a significant part overrule it (excess_noise).
// Without a model the repeats' variances are fitted by read^2 + shot^2 u, weighted, not negative.
NoiseFinding findNoise(const GapData& data, const std::optional<CameraNoise>& given);

// Variance of what the mean of many readings that are rounded to a step errs by, noise of this variance having been added before:
// step^2 / 12 without noise, nothing where it is half of a step or more (Widrow and Kollar, Quantization Noise, 2008).
double sharedRounding(double variance, double step);

// A reading of one channel of one sample.
struct OddReading
{
  Eigen::Index channel = 0;
  Eigen::Index sample = 0;
};

// Readings far from others of the same sample, which are few and make most of the scatter: the one of each that is farthest from the
// others and from what is simulated becomes NaN in the capture.
std::vector<OddReading> leaveOutOddReadings(GapCapture& capture, const GapOptions& options);

// Variance of the averaged readings, rounding included; K x S.
Eigen::MatrixXd readingVariance(const GapData& data, const CameraNoise& noise);

// Squared standard deviation that a reflectance error of 1 (independent from wavelength to wavelength)
// has in each channel; K.
Eigen::VectorXd reflectanceErrorGain(const CameraModel& camera);

using ChannelMask = Eigen::Array<bool, Eigen::Dynamic, 1>;

// Channels that were fitted to samples, K: their negative part is larger than noise of a measured responsivity, a twentieth of the
// response to white.
ChannelMask fittedChannels(const CameraModel& camera);

// Squared size of what a plain sum over the grid may miss, K x S: the difference to the integral of the interpolated
// responsivity times the interpolated reflectance; that between straight lines and curves through the reflectance
// (both zero on grids of 2 nm or finer), the latter no more than the largest that there is; where the camera sees wavelengths at which
// no reflectance was measured or beyond its own grid, the difference between holding the end value and going on along its slope; and
// half of the weight that the sum gives to the ends, where the grid cuts off a passband. fittedChannels() were fitted with the sum as
// it is, its ends too: only straight lines and wavelengths beyond count.
Eigen::MatrixXd integrationVariance(const GapData& data, const WavelengthGrid& measured);

// Without noise model and repeats, K x S: per channel what no basis predicts of `left` (K x S, 0 where nothing was measured) is
// noise; but what the channels of a sample share only up to SampleScatter.
Eigen::MatrixXd unknownVariance(const GapData& data, const Eigen::MatrixXd& left);

// How many times the noise model's standard deviation the residual needs; 1 where it is not noise.
//
// residual: K x S, what the effects leave of samples that took no part; 0 where nothing was measured.
// noise: K x S, variance of the readings by the model. integration: K x S, variance that is not the readings' noise.
// Maximum likelihood of normal residuals. It is noise where that is far more likely than reflectances that scatter (whose
// errors go through the channels), and where neighbouring channels do not err together.
double excessScatter(const GapData& data, const Eigen::MatrixXd& residual,
  const Eigen::MatrixXd& noise, const Eigen::MatrixXd& integration);

// Standard deviation of the measured reflectance, independent from wavelength to wavelength, that the residual allows:
// what stands out of data.variance, but not more than the second differences between neighbouring channels show in the
// middle of the samples. Errors of the model are smooth over the channels, or large in few samples; scatter is neither.
// At most LargestReflectanceNoise.
double reflectanceScatter(const GapData& data, const Eigen::MatrixXd& residual, double unpredicted);

} // namespace msi
