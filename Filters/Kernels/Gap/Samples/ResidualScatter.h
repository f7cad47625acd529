// What the scatter of a residual says: noise beyond its model, reflectances that were not measured exactly.
#pragma once

#include "Kernels/Gap/Samples/GapData.h"

#include <Eigen/Core>

namespace msi
{

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
