#include "Formats/SpectralImageFile.h"

#include "Formats/Arrays/ArrayFile.h"
#include "Formats/FormatError.h"
#include "Formats/Images/ArrayImage.h"
#include "Formats/Images/EnviImage.h"
#include "Formats/Images/ImageStack.h"
#include "Formats/Storage/WholeFile.h"

#include <algorithm>
#include <array>
#include <string_view>
#include <utility>

namespace msi
{

namespace
{
using namespace std::string_view_literals;

constexpr std::size_t BeginningSize = 16;

bool startsWith(std::string_view text, std::string_view beginning)
{
  return text.substr(0, beginning.size()) == beginning;
}

bool isPicture(std::string_view beginning)
{
  static constexpr std::array<std::string_view, 6> Signatures = { "II*\0"sv, "MM\0*"sv, "II+\0"sv,
    "MM\0+"sv, "\x89PNG"sv, "\x76\x2F\x31\x01"sv };
  return std::any_of(Signatures.begin(), Signatures.end(),
    [beginning](std::string_view signature) { return startsWith(beginning, signature); });
}

std::unique_ptr<SpectralImageFile> openOneFile(
  const std::string& file, const SpectralImageOptions& options)
{
  const std::string beginning = readFileBeginning(file, BeginningSize);
  if (!isPicture(beginning))
  {
    if (auto arrays = openArrayFile(file))
    {
      return openArrayImage(std::move(arrays), options);
    }
    if (const auto envi = findEnviFiles(file))
    {
      return openEnviImage(*envi, options);
    }
  }
  return openImageStack({ file }, options);
}

// The header and the data file of one ENVI image, both named.
bool isEnviPair(const std::vector<std::string>& files)
{
  if (files.size() != 2)
  {
    return false;
  }
  for (const std::string& file : files)
  {
    const std::string& other = &file == &files[0] ? files[1] : files[0];
    if (startsWith(readFileBeginning(file, BeginningSize), "ENVI"))
    {
      const auto envi = findEnviFiles(file);
      return envi && envi->data == other;
    }
  }
  return false;
}
}

std::unique_ptr<SpectralImageFile> openSpectralImage(
  const std::vector<std::string>& files, const SpectralImageOptions& options)
{
  if (files.empty())
  {
    throw FormatError("spectral image", "no file was named",
      "one file with many bands, or one file per band", "name the files");
  }
  if (files.size() == 1 || isEnviPair(files))
  {
    return openOneFile(files[0], options);
  }
  return openImageStack(files, options);
}

} // namespace msi
