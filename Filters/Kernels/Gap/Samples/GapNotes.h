// What the report says in words, and about the noise itself.
#pragma once

#include "Kernels/Gap/GapReport.h"
#include "Kernels/Gap/Samples/GapData.h"
#include "Kernels/Gap/Samples/GapNoise.h"

#include <optional>
#include <string>
#include <vector>

namespace msi
{

// Adds the cause excess_noise where the repeats scatter more than the given noise model: the mean gap is
// measured against the model's floor before, and against the repeats' after.
void addExcessNoise(GapReport& report, const GapData& data, const NoiseFinding& noise,
  const std::optional<CameraNoise>& given, const std::vector<std::string>& without);

// What the data cannot decide, and why.
std::vector<std::string> notesOn(const GapData& data, const GapCapture& capture,
  const NoiseFinding& noise, double reflectanceNoise, const GapReport& report);

} // namespace msi
