#include "Formats/Tables/EnviLibrary.h"

#include "Formats/FormatError.h"
#include "Formats/Images/EnviHeader.h"
#include "Formats/Images/EnviImage.h"
#include "Formats/Storage/WholeFile.h"
#include "Formats/Tables/ReflectanceScale.h"
#include "Formats/Text/NumberText.h"
#include "Formats/Text/TextEncoding.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
constexpr std::size_t BeginningSize = 16; // of UTF-16 too
constexpr const char* Expected = "a spectral library";

bool mayBeLibrary(const std::string& path)
{
  const std::string extension = lowerCase(std::filesystem::path(path).extension().string());
  return extension == ".sli" ||
    (extension == ".hdr" &&
      looksLikeEnviHeader(asUtf8(readFileBeginning(path, BeginningSize)).value_or("")));
}

std::vector<std::string> namesOf(
  const SpectralImageInfo& info, std::size_t count, std::vector<std::string>& notes)
{
  std::vector<std::string> names;
  const auto listed = info.metadata.find("spectra names");
  if (listed == info.metadata.end())
  {
    return names;
  }
  const std::string_view text = listed->second;
  for (std::size_t begin = 0; begin <= text.size();)
  {
    const std::size_t end = std::min(text.find(',', begin), text.size());
    names.emplace_back(trimmed(text.substr(begin, end - begin)));
    begin = end + 1;
  }
  if (names.size() != count) // names may hold commas
  {
    notes.push_back("spectra names were left unread: " + std::to_string(names.size()) + " for " +
      std::to_string(count) + " spectra");
    names.clear();
  }
  return names;
}

void requireFinite(const SampleTable& table, const std::string& file)
{
  for (Eigen::Index sample = 0; sample < table.reflectance.cols(); ++sample)
  {
    for (Eigen::Index band = 0; band < table.reflectance.rows(); ++band)
    {
      if (!std::isfinite(table.reflectance(band, sample)))
      {
        throw FormatError(file,
          "spectrum '" + table.sampleNames()[static_cast<std::size_t>(sample)] +
            "' has no value at " + numberText((*table.wavelengths)[band]) + " nm",
          "finite numbers", "remove the spectrum");
      }
    }
  }
}
}

std::optional<SampleTable> readEnviLibrary(const std::string& path, ReflectanceUnit unit)
{
  const auto files = mayBeLibrary(path) ? findEnviFiles(path) : std::nullopt;
  if (!files)
  {
    return std::nullopt;
  }
  const auto library = openEnviLibrary(*files);
  const SpectralImageInfo& info = library->info();
  if (info.wavelengths.empty())
  {
    throw FormatError(files->header, "states no wavelengths",
      "'wavelength' with one number for each of " + std::to_string(info.bands()) + " bands",
      std::string("add them: ") + Expected + " without them is no sample table");
  }
  SampleTable table;
  table.notes = info.notes;
  table.wavelengths = WavelengthGrid(info.wavelengths);
  table.reflectance.resize(info.bands(), info.width);
  library->readBlock({ 0, info.width, 0, 1 }, {}, table.reflectance.data());
  auto names = namesOf(info, static_cast<std::size_t>(info.width), table.notes);
  if (!names.empty())
  {
    table.metadata.push_back({ "sample", std::move(names) });
  }
  requireFinite(table, files->data);
  bringToFactor(table, unit, [&files](Eigen::Index) { return FilePlace{ files->data, 0, 0 }; });
  return table;
}

} // namespace msi
