// Pixels that take no part in the diagnosis of an image pair: hot and dead ones, and those that fit nothing.
#pragma once

#include "Kernels/Doubts/OddOnes.h"
#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldStatistics.h"

#include <string>

namespace msi
{

// Values of the real image that differ from the simulated one unlike all of their neighbours but one, as those of hot and dead pixels
// do: not usable from here on. Sets FieldData::defectPart.
void leaveOutDefects(FieldData& data);

// oddElements() by what is left of them with and without the effects found, mean over the channels, over noise; compared are pixels where
// the simulated image is as steep. Counted block after block.
IndexList oddPixels(const FieldData& data, const FieldWeights& weights, const FieldModel& nominal,
  const FieldModel& found, const FieldLoop& loop);

// Those take no part from here on, and are in FieldData::leftOut.
void leaveOut(FieldData& data, const IndexList& pixels);

// How many are left out, and near which places. consequence: " left out".
std::string oddPixelsNote(const FieldData& data, const std::string& consequence);

} // namespace msi
