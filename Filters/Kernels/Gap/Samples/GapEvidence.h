// The numbers by which a diagnosis decides whether there is a gap, and whether its causes account for it.
#pragma once

#include "Kernels/Gap/GapReport.h"
#include "Kernels/Gap/Samples/AxisShares.h"
#include "Kernels/Gap/Samples/GapData.h"

#include <Eigen/Core>

namespace msi
{

// K x S throughout; `gap`, `before`, `after`: real minus simulated, 0 where nothing was measured.

// The values where something was measured, 0 elsewhere.
Eigen::MatrixXd measuredOnly(const GapData& data, const Eigen::MatrixXd& values);

// The error of the sums over wavelength is estimated from their steps and may be too large: where less is left than
// it allows, only as much of it stays in data.variance as what is left shows. Returns the mean variance taken away.
double limitIntegration(GapData& data, const Eigen::MatrixXd& integration, double unpredicted);

// Energies of some samples before and after, and what noise allows.
GroupEnergies energiesOf(const GapData& data, const SampleList& samples,
  const Eigen::MatrixXd& before, const Eigen::MatrixXd& after);

// Whether the bases predict held-out samples: their gain in energy, sample by sample, against its own error.
bool predictable(const GapData& data, const Eigen::MatrixXd& gap, const AxisShares& shares);

// Energy that errors of sums over wavelength, or a small part of what is left, may be.
double negligibleEnergy(
  const GapData& data, const Eigen::MatrixXd& after, const Eigen::MatrixXd& integration);

// What the causes take away over what errors of sums over wavelength and of reflectance could be: on average, or in single
// samples that make up most of it. Noticeable beyond 1; 0 where they take nothing away.
double noticed(const GapData& data, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after,
  const Eigen::MatrixXd& integration);

// oddElements() by what is left of them with and without the causes found, channels of samples.
IndexList oddElements(
  const GapData& data, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after);

// Whether a change of the response stands in so few samples that none of them can be left out to check it.
bool inFewSamples(const GapData& data, const Eigen::MatrixXd& change);

} // namespace msi
