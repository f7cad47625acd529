// How much of what the causes do is believed of them.
#pragma once

#include "Kernels/Gap/GapReport.h"

#include <Eigen/Core>

#include <array>
#include <vector>

namespace msi
{

// noiseAlone: nothing but noise is left. share: of all causes together, 0 where there is none.
GapVerdict verdictOf(double shrink, double share, bool noiseAlone) noexcept;

inline constexpr double ExplainedShrink = 0.85;
inline constexpr double ExplainedShare = 0.7; // of the causes together
inline constexpr double PartlyShrink = 0.25;

// What is left has a cause that is not known, and may overlap with those found by as much as its own size: of what they
// do (shrink, 0..1), only that part is certain.
double certainPart(double shrink) noexcept;

// From 0, where nothing may be left, to 1, where something is for sure. interval: of the shrink.
//
// Wrong causes that cancel one another mimic one that is not known, but not to the last; right ones may cancel and leave
// nothing. So what causes undo of one another counts as far as something is left.
double doubtOf(const std::array<double, 2>& interval) noexcept;

// For each cause the part of what it does, 0..1, that the others undo: as far as they point against it, and are as large
// as it there. What no other can reach is not undone, however large the others are.
// products: scalar products of what the causes do and, last, of what they do together.
std::vector<double> undoneParts(const Eigen::MatrixXd& products);

} // namespace msi
