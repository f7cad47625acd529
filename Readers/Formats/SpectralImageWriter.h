// Spectral images to disk, row by row.
#pragma once

#include "Formats/SampleType.h"
#include "Formats/SpectralImageFile.h"

#include <cstddef>
#include <memory>
#include <optional>
#include <string>

namespace msi
{

enum class Interleave
{
  BSQ,
  BIL,
  BIP
};

enum class ByteOrder
{
  Little,
  Big
};

// Receives an image from the top row down and makes one file (ENVI: two) of it. Until finish() returns
// nothing stands under the file's name; a writer that is destroyed before leaves nothing behind.
//
// Rows may have any height; the sum over all calls is the height of the image. rowStride as in
// SpectralImageFile::readBlock. Errors: FormatError naming the file (disk full, not writable);
// std::invalid_argument for too many or missing rows.
class SpectralImageWriter
{
public:
  virtual ~SpectralImageWriter() = default;
  SpectralImageWriter(const SpectralImageWriter&) = delete;
  SpectralImageWriter& operator=(const SpectralImageWriter&) = delete;

  virtual void writeRows(int rows, const float* pixels, std::ptrdiff_t rowStride = 0) = 0;
  virtual void writeRows(int rows, const double* pixels, std::ptrdiff_t rowStride = 0) = 0;
  virtual void finish() = 0;

protected:
  SpectralImageWriter() = default;
};

struct EnviWriteOptions
{
  Interleave interleave = Interleave::BIL;
  SampleType type = SampleType::Float32; // ENVI has no Int8
  ByteOrder byteOrder = ByteOrder::Little;
};

// Writes NAME.hdr beside the data file NAME.EXT. 'path' may name either; without an extension the data
// file gets .img. From info: size, bandNames, wavelengths, fwhm, goodBands, displayBands, ignoreValue,
// reflectanceScale (values are multiplied by it), and metadata "description". Values are rounded to
// nearest for integer types and refused when out of range; NaN becomes ignoreValue, and is refused for
// integer types without one.
std::unique_ptr<SpectralImageWriter> createEnviImage(
  const std::string& path, const SpectralImageInfo& info, const EnviWriteOptions& options = {});

// Writes a spectral OpenEXR (float32, scan lines). info.wavelengths must be known; info.quantity
// "emission" gives S0 channels, else T. The layout knows no camera responses: with info.quantity
// "responses" an attribute says that the T channels are that.
// Source: A. Fichet, R. Pacanowski, A. Wilkie, "An OpenEXR Layout for Spectral Images", JCGT 10 (2021).
std::unique_ptr<SpectralImageWriter> createSpectralExr(
  const std::string& path, const SpectralImageInfo& info);

// What the extension .bsq, .bil or .bip says; nothing for any other.
std::optional<Interleave> interleaveOfName(const std::string& path);

// By the extension of path: .exr or ENVI (.hdr, .img, .dat, .raw, .bin, .cube, .bsq, .bil, .bip or none).
// Errors: FormatError for any other extension.
std::unique_ptr<SpectralImageWriter> createSpectralImage(
  const std::string& path, const SpectralImageInfo& info, const EnviWriteOptions& options = {});

} // namespace msi
