// The numbers by which the diagnosis of image pairs decides.
#pragma once

namespace msi::ImageDecision
{

inline constexpr double LeastClip = 0.7; // of a clipping that is one
inline constexpr double Indistinct =
  0.5; // standard error over typical size: the scene does not show the effect

// What do effects look like before the data speak?
inline constexpr double PriorSize = 10.0;     // typical sizes
inline constexpr double TolerancePart = 0.05; // of the gap: forms are approximations
inline constexpr double HuberDeviations = 6.0;

// Is there a gap at all, and is it explained?
inline constexpr double UnexplainedRms = 1.1;    // of the noise floor
inline constexpr double UnexplainedBlocks = 2.0; // squared block means over what noise allows
inline constexpr double ExplainedBlocks = 1.5;

} // namespace msi::ImageDecision
