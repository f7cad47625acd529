// Diagnosis of the gap between a real and a simulated image of the same scene, from the images themselves.
#pragma once

#include "Kernels/Gap/Field/FieldModel.h"
#include "Kernels/Gap/GapReport.h"
#include "Kernels/Gap/SimToRealGap.h"

#include <optional>

namespace msi
{

struct FieldGap
{
  GapReport report; // gapBefore and gapAfter stay empty: see FieldCorrection
  FieldModel model; // the effects found
  // What the real image's channels were divided by to be relative to white, K; the report speaks of the quotient.
  Eigen::ArrayXd unit;
};

// Empty only where progress() asked to stop.
//
// Finds: vignetting, illumination_gradient, veiling_glare, local_stray_light, defocus, distortion, misregistration,
//   banding, ghost_reflection, lag, channel_crosstalk, exposure_gain, channel_gain, dark_offset, detector_nonlinearity, saturation: names,
//   parameters and order of effectLibrary() and ImageSimulator, so that report.correction runs there.
// Method: Documentation/Filters/ImageSimToRealGap.md. Blocks of pixels, two thirds for choosing and fitting
//   (five folds), one third for the figures (all where no effect is found). Noise from differences of residuals.
// GapReport::where has the axes channel, level, position, edges, rows, columns, and sample (with labels) or region.
// Of GapOptions `folds` and `reflectanceNoise` are not looked at.
// Errors: std::invalid_argument for an empty image, no channel, fewer than 15 blocks of 4 x 4 usable pixels, an
//   unknown name in `without`.
// NaN in a channel of either image takes the pixel out in that channel, in the simulated one also its neighbours to
//   two pixels; gaps in the simulated image are filled along rows for what reads the surround.
// Where something unknown is more likely than not, a few places that fit nothing may be left out (a note says where), and the work is
//   done once more or more often.
// Cost: about 3 s on one core for 8 channels, up to 20 s where many effects compete, whatever the number of pixels, and one
//   reading of the images beside; linear in the channels. Memory: a copy of the simulated image where it has gaps, else of at most
//   2 million pixels.
std::optional<FieldGap> diagnoseField(const FieldPair& pair, const GapOptions& options = {});

} // namespace msi
