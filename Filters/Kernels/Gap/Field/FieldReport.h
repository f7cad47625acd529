// What is said about the effects that were found in an image pair.
#pragma once

#include "Kernels/Gap/Field/FieldSearch.h"
#include "Kernels/Gap/GapReport.h"

#include <cstdint>
#include <vector>

namespace msi
{

// Cause by cause, the largest share first; the shares sum to `total`.
std::vector<GapCause> fieldCauses(const FieldData& data, const FieldSearchResult& found,
  const std::vector<FieldChoice>& choices, double total);

std::vector<GapCandidate> fieldCandidates(
  const FieldData& data, const FieldSearchResult& found, std::uint64_t seed);

// The effects as the simulator takes them.
std::vector<CameraEffect> fieldCorrection(
  const FieldSet& set, const FieldModel& model, const std::vector<std::string>& channels);

} // namespace msi
