// Which page and channel of which file becomes which band, and at which wavelength.
#pragma once

#include "Formats/Images/OpenedImage.h"
#include "Formats/SpectralImageFile.h"

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace msi
{

struct BandSource
{
  std::size_t file; // into BandSources::files
  int page;
  int channel;
  std::string name;
  std::optional<double> wavelength; // as the file or its name tells it
};

struct BandSources
{
  std::vector<std::shared_ptr<const OpenedImage>> files;
  std::vector<BandSource> bands; // by wavelength, else in natural order
  std::string quantity;
  std::vector<std::string> notes;
};

// One file: every page of its first page's size and every channel but alpha; of a spectral EXR its
// spectral channels. Many files: one channel each. options.wavelengths, where given, count.
// Errors: FormatError for sizes that differ, files of several channels in a stack, the same wavelength
//         twice, a wavelength list of another length.
BandSources findBands(const std::vector<std::string>& files, const SpectralImageOptions& options);

} // namespace msi
