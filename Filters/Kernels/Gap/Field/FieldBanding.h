// Stripes as the effect library writes them.
#pragma once

#include "Kernels/Gap/Field/FieldFit.h"
#include "Kernels/Gap/Field/FieldModel.h"

#include <Eigen/Core>

namespace msi
{

inline constexpr Eigen::Index BandingHarmonics = 3;

// sum over n of amplitude_kn sin(2 pi (n line / period + start_kn)); K x harmonics
struct BandingSines
{
  double period = 0.0;
  Eigen::ArrayXXd amplitude, start;
  double part = 1.0; // of the profile's energy
};

// The three sines of a common period that come nearest to a profile, lines x K. Amplitudes stop at those of the library.
BandingSines nearestSines(const Eigen::ArrayXXd& profile);

// Those of a choice of banding: its own, or the nearest to its profile.
BandingSines bandingSines(const FieldChoice& choice, const FieldModel& model);

} // namespace msi
