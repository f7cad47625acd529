// Pixels that take no part in the diagnosis of an image pair: those of a frame, hot and dead ones, and those that fit nothing.
#pragma once

#include "Kernels/Doubts/OddOnes.h"
#include "Kernels/Gap/Field/FieldData.h"
#include "Kernels/Gap/Field/FieldStatistics.h"

#include <string>

namespace msi
{

// The pair with NaN where one image has a frame, as registration leaves it: pixels that are 0 in all channels, from the border on, where
// the other image is not as dark. Keeps copies of images with a frame.
FieldPair withoutFrame(FieldPair pair);

// Values of the real image that differ from the simulated one unlike all of their neighbours but one, as those of hot and dead pixels
// do: not usable from here on. Sets FieldData::defectPart.
void leaveOutDefects(FieldData& data);

// oddElements() by what is left of them with and without the effects found, mean over the channels, over noise; compared are pixels where
// the simulated image is as steep. Counted block after block.
IndexList oddPixels(const FieldData& data, const FieldWeights& weights, const FieldModel& nominal,
  const FieldModel& found);

// Those take no part from here on, and are in FieldData::leftOut.
void leaveOut(FieldData& data, const IndexList& pixels);

// How many are left out, and near which places. consequence: " left out".
std::string oddPixelsNote(const FieldData& data, const std::string& consequence);

} // namespace msi
