// ENVI rasters: a text header beside a file of samples.
#pragma once

#include "Formats/SpectralImageFile.h"

#include <memory>
#include <optional>
#include <string>

namespace msi
{

struct EnviFiles
{
  std::string header;
  std::string data;
};

// Opened by its header or its data file. The other one has the same name with .hdr, or with or without
// .img .dat .raw .bil .bsq .bip .bin .cube .sli (upper or lower case), or .hdr behind the whole name; else the data file
// is the only other file of that name.
// Nothing where 'path' is neither a header nor has one beside it.
std::optional<EnviFiles> findEnviFiles(const std::string& path);

// True for a name without an extension, or with .hdr or one of those above.
bool isEnviName(const std::string& path);

// Where an image named 'path' is written: NAME.hdr beside NAME.EXT for the extensions above, .img where
// there is none, NAME.EXT.hdr beside NAME.EXT for any other.
EnviFiles enviFilesToWrite(const std::string& path);

// Errors: FormatError as parseEnviHeader, and for data files smaller than the header says, naming both
// sizes. A larger data file is noted with both sizes.
std::unique_ptr<SpectralImageFile> openEnviImage(
  const EnviFiles& files, const SpectralImageOptions& options);

// A spectral library as an image of one row: a column per spectrum, a band per wavelength. The names of the spectra are
// the metadata "spectra names". Errors as of openEnviImage.
std::unique_ptr<SpectralImageFile> openEnviLibrary(const EnviFiles& files);

} // namespace msi
