// What images and the residuals of a model show before a fit: where displacements, clipping and stripes start.
#pragma once

#include "Kernels/Gap/Field/FieldColumns.h"
#include "Kernels/Gap/Field/FieldEffects.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// Where each channel of the real image lies by DisplacementSearch, where a fit by gradients starts. Nowhere else where that is next to
// nothing or the images do not tell; empty where that is so of all channels, and for images smaller than
// DisplacementSearch::LeastTileSide.
std::vector<ImageDisplacement> registrationStart(const FieldData& data);

// Weight and level of the effect that limits the response.
const std::vector<ImageTerm>& clippingTerms();

// For each channel the level beyond which the real image stays at one value while the model goes on: that of the least squares of
// real - min(model, level). A channel that shows none has that of all together, or the highest found; the neutral level where no channel
// shows any. The residuals are those of a model that does not clip, of each block the channels one after the other.
Eigen::ArrayXd findClipLevels(const std::vector<FieldResidual>& residuals, Eigen::Index channels);

// Gain and offset of each line as the residuals of a model show them, without their mean and, but for keepTrend, without
// the quadratic that may as well be light. The strongest fiftieth of the lines are cut to the next: a line that is defect
// is no stripe.
FieldProfile findProfile(const FieldData& data, const std::vector<FieldResidual>& residuals,
  bool alongRows, bool keepTrend, const Eigen::ArrayXd& limit);

// Finds the period of a gain that goes with the row (or column), the same in all channels, phases and sizes free.
//
// Method: least-squares periodogram (N. R. Lomb, 1976, doi:10.1007/BF00648343) of the relative gain of each row of the
//   training blocks, quadratic trend taken off; the channels' powers add. The largest power counts where noise
//   of the same median power would reach it anywhere in the spectrum with a probability below 1e-3.
// Range: 2 pixels to half the span. 0 where there is nothing beyond chance.
void findPeriod(const FieldData& data, const std::vector<FieldResidual>& residuals, bool alongRows,
  FieldStripes& stripes);

inline constexpr Eigen::Index BandingHarmonics = 3;

// sum over n of amplitude_kn sin(2 pi (n line / period + start_kn)); K x harmonics
struct BandingSines
{
  double period = 0.0;
  Eigen::ArrayXXd amplitude, start;
  double part = 1.0; // of the profile's energy
  double rms = 0.0;  // of the profile, in the channel where it is largest
};

// The three sines of a common period that come nearest to a profile, lines x K. Amplitudes stop at those of the library.
BandingSines nearestSines(const Eigen::ArrayXXd& profile);

// Those of a choice of banding: its own, or the nearest to its profile.
BandingSines bandingSines(const FieldChoice& choice, const FieldModel& model);

// Whether a profile has most of its energy in waves with fewer than four cycles over the image: light may as well be that uneven.
bool isSlow(const FieldChoice& profile, const FieldModel& model);

} // namespace msi
