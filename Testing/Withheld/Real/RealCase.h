// Effects planted in real measurements: the camera is fitted to one half of the samples, the effect is planted in what the real
// camera answered to the other half. Read from the folder in MULTISPECTRAL_DATA; without it there are no cases.
#pragma once

#include "Cases/CaseWriter.h"

#include <cstdint>

namespace withheld
{

// hkpolyu/paper and cotton, 16 channels, as published; or each channel made linear first by a cubic in the answers of the
// half that the camera is fitted to; or as published, and the camera fitted by ridge regression.
void writeRawCases(CaseWriter& writer, bool full, std::uint64_t seed);
void writeLinearisedCases(CaseWriter& writer, bool full, std::uint64_t seed);
void writeRidgeCases(CaseWriter& writer, bool full, std::uint64_t seed);
// The linear ones again, rounded to 1/200 of white, one reading of 250 nothing or full scale, and two labels exchanged.
void writeCarelessCases(CaseWriter& writer, bool full, std::uint64_t seed);
// filterwheel-cc24: 24 patches through 7 filters; the camera is light x filter as measured, scaled on half of the patches.
void writeChartCases(CaseWriter& writer, bool full, std::uint64_t seed);

} // namespace withheld
