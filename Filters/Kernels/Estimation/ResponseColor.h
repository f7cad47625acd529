// From camera response to CIELAB in one step, where the reflectance itself is not asked for.
#pragma once

#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/TristimulusBlocks.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"
#include "Kernels/Difference/CIEDE2000.h"
#include "Kernels/Numerics/AffineTransform.h"

#include <Eigen/Core>

namespace msi
{

// Immutable: an affine estimator of reflectance and the tristimulus weights as one 3 x channels matrix.
//
// Shapes:   responses are channels x pixels, Lab 3 x pixels, contiguous, pixel after pixel.
// Accuracy: for responses within -0.5..1.5 and an estimator whose coefficients have an absolute sum of at most 20 a band,
//           L*, a* and b* are within 3e-3 of those by reflectance in double.
// Bytes:    as TristimulusBlocks. A NaN stays in its own pixel.
// Errors:   the constructor throws std::invalid_argument where the estimator's bands are not those of the weights.
class ResponseColor
{
public:
  ResponseColor(const AffineTransform& toReflectance, const TristimulusTransform& tristimulus);

  void lab(const float* responses, float* lab, Eigen::Index pixels) const noexcept;
  // CIEDE2000 from the colors 'lab' (3 x pixels) to those of the responses: the same bytes as of lab().
  void differences(const CIEDE2000Factors& factors, const float* responses, const float* lab,
    float* difference, Eigen::Index pixels) const noexcept;

private:
  TristimulusBlocks ToXYZ;
  CIELAB ToLab;
};

} // namespace msi
