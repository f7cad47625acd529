// TIFF, PNG, EXR and other formats of OpenImageIO: one file with many bands, or one file per band.
#pragma once

#include "Formats/SpectralImageFile.h"

#include <memory>
#include <string>
#include <vector>

namespace msi
{

std::unique_ptr<SpectralImageFile> openImageStack(
  const std::vector<std::string>& files, const SpectralImageOptions& options);

} // namespace msi
