// What a file is, from its content: one answer for each file, so that programs need not ask.
#pragma once

#include <string>

namespace msi
{

enum class FileKind
{
  Unknown,
  SpectralImage, // one that openSpectralImage opens
  LabelImage,    // one channel of whole numbers in even areas, with more than one value
  SampleTable,   // samples, transforms and models that readSampleTable reads
  Camera,        // a description (.json) or curves of channels over wavelength
  Capture        // capture.json beside camera.csv, samples.csv and responses.csv, or their folder
};

// Never throws; a file that cannot be read, or is none of these, is Unknown. Reads headers, the first 256 KiB of a
// table, and rows of an image of one channel that are spread over it.
//
// Tables with one row a wavelength are cameras where the columns are named as channels or each column sums to what a
// camera answers to white (0.5 to 2); else they are samples.
FileKind fileKind(const std::string& path) noexcept;

} // namespace msi
