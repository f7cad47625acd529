// Reflectance transform from samples by least squares: the methods direct, pinv and pooled.
#pragma once

#include "Kernels/Estimation/SampleSet.h"
#include "Kernels/Numerics/AffineTransform.h"
#include "Kernels/Numerics/FitSummary.h"

namespace msi
{

struct CalibrationFit
{
  AffineTransform transform; // W, N x (K+1)
  FitSummary summary;
};

struct CalibrationOptions
{
  // Singular values below rankTolerance times the largest one count as zero. Negative: the larger
  // dimension of the system times 2^-52.
  double rankTolerance = -1.0;
};

// W = R U~+ with the Moore-Penrose pseudoinverse of the responses U~ = (U; 1), by singular value
// decomposition: the least-squares W, and where the samples leave it undetermined (fewer than K+1
// samples, dependent channels) the one of least norm; the summary then says so with rank and need.
// Called with the chart it is the method "direct", with the tuning samples the method "pinv".
//
// Source:  "Correcting cross-media instrument metamerism for reflectance estimation in multispectral
//          imaging", 2011, doi 10.1364/JOSAA.28.000511, Eq. 9.
// Shapes:  samples N x L and K x L; W is N x (K+1).
// Errors:  std::invalid_argument from requireValid(samples, "calibration").
// Summary: residualRms over N x L reflectances; rank and condition of U~; unknowns N (K+1).
// Cost:    O(L K^2 + N L K).
CalibrationFit fitPseudoinverse(const SampleSet& samples, const CalibrationOptions& options = {});

// "pooled": W = (R, w S)(U~, w V~)+, the least-squares W over chart and tuning samples together, a
// squared tuning error counting tuningWeight^2 times. 1 is plain pooling; the square root of
// L_A / L_T gives both sets the same say (Eqs. 18-19).
//
// Errors:  std::invalid_argument also where bands or channels of the two sets differ, or where
//          tuningWeight is not positive and finite.
// Summary: residualRms is unweighted, over both sets.
CalibrationFit fitPooled(const SampleSet& calibration, const SampleSet& tuning,
  double tuningWeight = 1.0, const CalibrationOptions& options = {});

} // namespace msi
