// The text header of an ENVI raster.
#pragma once

#include "Formats/SampleType.h"
#include "Formats/SpectralImageFile.h"
#include "Formats/SpectralImageWriter.h"

#include <cstddef>
#include <cstdint>
#include <string>
#include <string_view>
#include <vector>

namespace msi
{

struct EnviHeader
{
  SpectralImageInfo info; // in the order of the file; everything but 'format'
  Interleave interleave = Interleave::BSQ;
  SampleType type = SampleType::UInt8;
  ByteOrder byteOrder = ByteOrder::Little;
  std::int64_t headerOffset = 0;

  // headerOffset and all samples; the parser made sure that it fits.
  std::int64_t expectedFileSize() const noexcept;
};

// Of this machine.
inline constexpr ByteOrder NativeByteOrder =
  __BYTE_ORDER__ == __ORDER_LITTLE_ENDIAN__ ? ByteOrder::Little : ByteOrder::Big;
// Samples are read and written in pieces that stay in the second-level cache until they are interleaved.
inline constexpr std::size_t EnviChunkBytes = 1 << 20;

// True for a text that begins with the word ENVI or envi.
bool looksLikeEnviHeader(std::string_view beginning) noexcept;

struct EnviHeaderOptions
{
  // False: the wavelengths and bandwidths of the header are left unread, as others are given.
  bool ownWavelengths = true;
  // True: a classification is read, whose samples are numbers of classes.
  bool classification = false;
  // True: a spectral library is read, as an image of one row with a column per spectrum.
  bool library = false;
};

// Keys in upper or lower case with any spacing; values in braces over several lines; comments with ;
// Wavelengths in nm, um, mm, cm, m, Angstrom, as wavenumber or frequency become nm. Without units they are nm from
// 100 up, and um below 100 unless all are whole numbers. Without the key 'wavelength' they may stand in the names of
// all bands.
// Errors: FormatError naming line and key: a file of another type, a missing key, a value that is none, complex or unknown data
//         types, lists whose length is not the number of bands, compressed files, frame offsets.
EnviHeader parseEnviHeader(
  const std::string& file, const std::string& text, const EnviHeaderOptions& options = {});

// The text for a header. Errors: std::invalid_argument for Int8, which ENVI does not have.
std::string enviHeaderText(const EnviHeader& header);

} // namespace msi
