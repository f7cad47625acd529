// What the report says in words, and about the noise itself.
#pragma once

#include "Kernels/Doubts/MixUps.h"
#include "Kernels/Gap/GapReport.h"
#include "Kernels/Gap/Samples/GapData.h"
#include "Kernels/Gap/Samples/GapNoise.h"

#include <optional>
#include <string>
#include <vector>

namespace msi
{

// Scatter of the readings beyond the given noise model.
struct ExcessNoise
{
  double energy = 0.0; // mean square of an element; 0: none
  double belief = 0.0; // probability that it is noise; 0 where noise may not be blamed
};
ExcessNoise excessNoise(const GapData& data, const NoiseFinding& noise,
  const std::optional<CameraNoise>& given, const std::vector<std::string>& without);
// Of the size of the gap, this scatter included.
double partOf(const ExcessNoise& excess, const GapFigures& gap);
std::string whereOf(const NoiseFinding& noise);
// Adds the cause excess_noise where noise may be blamed: the mean gap is measured against the model's floor before, and against
// that of the scatter after.
void addExcessNoise(
  GapReport& report, const GapData& data, const NoiseFinding& noise, const ExcessNoise& excess);

// mixUp() of samples, channels and places.
MixUp mixUpOf(const GapData& data);

// What the report says of the elements that are left out. consequence: " left out".
std::string oddElementsNote(const GapData& data, const std::string& consequence);
std::string oddReadingsNote(const GapCapture& capture, const std::vector<OddReading>& readings);

// What the data cannot decide, and why.
std::vector<std::string> notesOn(const GapData& data, const GapCapture& capture,
  const NoiseFinding& noise, double reflectanceNoise, const GapReport& report);

} // namespace msi
