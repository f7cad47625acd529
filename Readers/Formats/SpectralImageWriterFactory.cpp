#include "Formats/SpectralImageWriter.h"

#include "Formats/FormatError.h"
#include "Formats/Images/EnviImage.h"
#include "Formats/Text/NumberText.h"

#include <array>
#include <filesystem>
#include <utility>

namespace msi
{

namespace
{
constexpr std::array<std::pair<const char*, Interleave>, 3> InterleaveNames = { {
  { ".bsq", Interleave::BSQ },
  { ".bil", Interleave::BIL },
  { ".bip", Interleave::BIP },
} };
}

std::optional<Interleave> interleaveOfName(const std::string& path)
{
  const std::string extension = lowerCase(std::filesystem::path(path).extension().string());
  for (const auto& [name, interleave] : InterleaveNames)
  {
    if (extension == name)
    {
      return interleave;
    }
  }
  return std::nullopt;
}

std::unique_ptr<SpectralImageWriter> createSpectralImage(
  const std::string& path, const SpectralImageInfo& info, const EnviWriteOptions& options)
{
  const std::string extension = lowerCase(std::filesystem::path(path).extension().string());
  if (extension == ".exr")
  {
    return createSpectralExr(path, info);
  }
  if (!isEnviName(path))
  {
    throw FormatError(path,
      "has the extension '" + extension + "', which no spectral image is written in",
      ".exr (spectral OpenEXR) or .hdr, .img, .dat, .raw, .bin, .cube, .bsq, .bil, .bip (ENVI)",
      "choose one of these names");
  }
  return createEnviImage(path, info, options);
}

} // namespace msi
