// Spectral images on disk, one reader for all formats.
#pragma once

#include <cstddef>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace msi
{

// What a spectral image file says about itself. Lists "one per band" follow the band order of the
// reader, which is by wavelength where the wavelengths are known.
struct SpectralImageInfo
{
  int width = 0;
  int height = 0;
  std::vector<std::string> bandNames; // one per band
  std::vector<double> wavelengths;    // nm, one per band, fit for a WavelengthGrid; or empty
  std::vector<double> fwhm;           // nm, one per band; empty when unknown
  std::vector<bool> goodBands;        // one per band; empty: all are good
  std::vector<int> displayBands;      // 0-based: red, green, blue or gray; empty when unknown
  std::optional<double> ignoreValue;  // stored value that means "no data"; read as NaN
  double reflectanceScale = 1.0;      // stored values were divided by it
  std::string format;                 // "ENVI", "TIFF", "OpenEXR", "MAT", ...
  std::string sampleType;             // as stored: "uint16", "float32", ...
  std::string quantity; // "reflectance", "responses", "emission" or empty when unknown
  std::map<std::string, std::string> metadata; // all else, keys in lower case
  std::vector<std::string> notes;              // what was recognized and done, for the user to see

  int bands() const noexcept { return static_cast<int>(bandNames.size()); }
};

// Columns [x0, x1), rows [y0, y1); row 0 is the top row.
struct PixelRegion
{
  int x0 = 0;
  int x1 = 0;
  int y0 = 0;
  int y1 = 0;

  int width() const noexcept { return x1 - x0; }
  int height() const noexcept { return y1 - y0; }
};

enum class IntegerScaling
{
  UnitRange, // the largest value of the stored type becomes 1 (8 bit: 255, 16 bit: 65535)
  Raw        // values as stored
};

struct SpectralImageOptions
{
  // nm, one per band in the order of the files or of the file's bands. Overrides what the files say.
  std::vector<double> wavelengths;
  // Of image stacks (TIFF, PNG, EXR). ENVI, MAT and HDF5 are read as stored, divided by the scale
  // factor that the file states.
  IntegerScaling integers = IntegerScaling::UnitRange;
  // The variable of a MAT file or the dataset of an HDF5 file. Not given: the only cube in it.
  std::string variable;
  // Numbers of classes or patches are wanted: an ENVI classification is one, too.
  bool labels = false;
};

// An open spectral image. Nothing but the header is held in memory.
//
// Threads: readBlock may be called from several threads on one object.
class SpectralImageFile
{
public:
  virtual ~SpectralImageFile() = default;
  SpectralImageFile(const SpectralImageFile&) = delete;
  SpectralImageFile& operator=(const SpectralImageFile&) = delete;

  const SpectralImageInfo& info() const noexcept { return Info; }

  // Reads a region into pixels, band interleaved by pixel:
  //   pixels[(y - y0) * rowStride + (x - x0) * bands.size() + b].
  // 'bands' are 0-based, any order; empty means all. rowStride is in values, 0 means dense; a negative
  // stride with 'pixels' at the last row turns the image upside down for the same price.
  // Errors: std::invalid_argument for a region or band outside the image; FormatError naming the file.
  void readBlock(const PixelRegion& region, const std::vector<int>& bands, float* pixels,
    std::ptrdiff_t rowStride = 0) const;
  void readBlock(const PixelRegion& region, const std::vector<int>& bands, double* pixels,
    std::ptrdiff_t rowStride = 0) const;

protected:
  explicit SpectralImageFile(SpectralImageInfo info);

  struct Block
  {
    PixelRegion region;
    std::vector<int> bands; // never empty
    std::ptrdiff_t rowStride;
  };
  virtual void readChecked(const Block& block, float* pixels) const = 0;
  virtual void readChecked(const Block& block, double* pixels) const = 0;

  SpectralImageInfo Info;

private:
  Block checked(
    const PixelRegion& region, const std::vector<int>& bands, std::ptrdiff_t rowStride) const;
};

// Opens one file with many bands, or many files with one band each. The format is found from the
// content: ENVI (header or data file), TIFF, PNG, EXR (spectral or plain), MAT, HDF5.
//
// Errors: FormatError naming the file, the place in it, what was expected and what to do.
std::unique_ptr<SpectralImageFile> openSpectralImage(
  const std::vector<std::string>& files, const SpectralImageOptions& options = {});
std::unique_ptr<SpectralImageFile> openSpectralImage(
  const std::string& file, const SpectralImageOptions& options = {});

} // namespace msi
