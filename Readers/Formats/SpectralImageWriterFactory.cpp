#include "Formats/SpectralImageWriter.h"

#include "Formats/Text/NumberText.h"

#include <filesystem>

namespace msi
{

std::unique_ptr<SpectralImageWriter> createSpectralImage(
  const std::string& path, const SpectralImageInfo& info, const EnviWriteOptions& options)
{
  return lowerCase(std::filesystem::path(path).extension().string()) == ".exr"
    ? createSpectralExr(path, info)
    : createEnviImage(path, info, options);
}

} // namespace msi
