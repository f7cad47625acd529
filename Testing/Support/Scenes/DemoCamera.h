// The camera of the demo data: halogen lamp, 16 interference filters, silicon detector.
#pragma once

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraNoise.h"

namespace msi::scenes
{

// Nominal centers 400, 420, ..., 700 nm; centers and widths off by a manufacturer's tolerance. On sceneGrid().
// shift: nm by which all filters pass longer waves, as they do when warm.
CameraModel demoCamera(double shift = 0.0);

// Noise of one pixel in one exposure of four averaged frames, and of a patch average.
CameraNoise pixelNoise();
CameraNoise patchNoise();

} // namespace msi::scenes
