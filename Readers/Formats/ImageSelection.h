// A part of a spectral image: some bands, a region, every n-th pixel.
#pragma once

#include "Formats/SpectralImageFile.h"

#include <memory>
#include <string>

namespace msi
{

struct ImageSelection
{
  // Bands counted from 1 in the reader's order, as numbers and ranges: "1-16, 20, 31". Empty: all.
  std::string bands;
  // nm, both ends included; both 0: all.
  double shortestWavelength = 0.0;
  double longestWavelength = 0.0;
  // Leave out the bands that the file itself marks as bad (bbl of ENVI).
  bool onlyGoodBands = false;
  // Row 0 is the top row. An empty region: the whole image.
  PixelRegion region;
  // Every n-th column and row of the region, from its first on; at least 1.
  int strideX = 1;
  int strideY = 1;

  bool isEverything() const noexcept;
};

// The file as if it held only the selected part; what was left out is noted.
// Errors: FormatError naming 'name' where the selection is not in the file or is no selection.
std::unique_ptr<SpectralImageFile> selectFrom(std::unique_ptr<SpectralImageFile> file,
  const ImageSelection& selection, const std::string& name);

} // namespace msi
