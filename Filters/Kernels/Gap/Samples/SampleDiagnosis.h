// The diagnosis of a table of samples by sets of effects and one criterion: Documentation/Decisions/one-diagnosis.md.
#pragma once

#include "Kernels/Gap/SimToRealGap.h"

#include <optional>

namespace msi
{

// As diagnoseGap. The report tells probabilities.
std::optional<GapReport> diagnoseSamples(const GapCapture& capture, const GapOptions& options = {});

} // namespace msi
