#include "Formats/SceneFolder.h"

#include "Formats/FileKind.h"
#include "Formats/FormatError.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <cctype>
#include <cstddef>
#include <filesystem>
#include <string_view>
#include <system_error>

namespace msi
{

namespace
{
namespace fs = std::filesystem;
using Paths = std::vector<fs::path>;

const std::vector<std::string_view> WhiteNames{ "white", "flat" };
const std::vector<std::string_view> DarkNames{ "dark", "black" };

std::string lowerStem(const fs::path& path)
{
  std::string stem = path.stem().string();
  std::transform(stem.begin(), stem.end(), stem.begin(),
    [](unsigned char c) { return static_cast<char>(std::tolower(c)); });
  return stem;
}

bool isNamed(const fs::path& path, const std::vector<std::string_view>& names)
{
  return std::find(names.begin(), names.end(), lowerStem(path)) != names.end();
}

// white.hdr and white_450nm.tif, but not whitewash.tif.
bool startsWithOneOf(const fs::path& path, const std::vector<std::string_view>& names)
{
  const std::string stem = lowerStem(path);
  return std::any_of(names.begin(), names.end(),
    [&](std::string_view name)
    {
      return stem.compare(0, name.size(), name) == 0 &&
        (stem.size() == name.size() ||
          !std::isalpha(static_cast<unsigned char>(stem[name.size()])));
    });
}

// Files before folders, as a person would list them.
Paths entriesOf(const fs::path& folder)
{
  Paths entries;
  std::error_code error;
  for (auto entry = fs::directory_iterator(folder, error);
       !error && entry != fs::directory_iterator(); entry.increment(error))
  {
    if (entry->path().filename().string().front() != '.')
    {
      entries.push_back(entry->path());
    }
  }
  if (error)
  {
    throw FormatError(folder.string(), "cannot be listed (" + error.message() + ")",
      "the folder of a scene", "check the name and the access rights");
  }
  std::sort(entries.begin(), entries.end(),
    [](const fs::path& a, const fs::path& b)
    { return naturalLess(a.filename().string(), b.filename().string()); });
  return entries;
}

// An ENVI image is its header: the data file beside it is the same image.
bool isDataOfHeader(const fs::path& path)
{
  std::error_code error;
  return path.extension() != ".hdr" &&
    (fs::exists(fs::path(path).replace_extension(".hdr"), error) ||
      fs::exists(path.string() + ".hdr", error));
}

// One file, or one per channel; 'what' names the part.
std::vector<std::string> oneImage(
  const Paths& files, const fs::path& folder, const std::string& what)
{
  if (files.size() > 1)
  {
    const auto unnamed = std::find_if(files.begin(), files.end(),
      [](const fs::path& file) { return fileNameWavelengths(file.string()).empty(); });
    if (unnamed != files.end())
    {
      throw FormatError(folder.string(),
        "has " + std::to_string(files.size()) + " files for " + what + ", and the name of " +
          unnamed->filename().string() + " holds no wavelength",
        "one file, or one file per channel with its wavelength in the name (channel_450nm.tif)",
        "rename the files or move those of another image away");
    }
  }
  std::vector<std::string> names;
  names.reserve(files.size());
  for (const auto& file : files)
  {
    names.push_back(file.string());
  }
  return names;
}

void setOnce(
  std::string& part, const fs::path& file, const fs::path& folder, const std::string& what)
{
  if (!part.empty())
  {
    throw FormatError(folder.string(),
      "has two files for " + what + ": " + fs::path(part).filename().string() + " and " +
        file.filename().string(),
      "one", "move the other one away");
  }
  part = file.string();
}

Paths imagesIn(const fs::path& folder)
{
  Paths images;
  for (const auto& path : entriesOf(folder))
  {
    if (!fs::is_directory(path) && !isDataOfHeader(path))
    {
      const auto kind = fileKind(path.string());
      if (kind == FileKind::SpectralImage || kind == FileKind::LabelImage)
      {
        images.push_back(path); // a frame may be as even as a label image
      }
    }
  }
  return images;
}

void addTable(const fs::path& file, const fs::path& folder, SceneFolder& scene)
{
  if (isNamed(file, { "patches" }))
  {
    setOnce(scene.patches, file, folder, "the patches");
  }
  else if (isNamed(file, { "chart", "calibration" }))
  {
    setOnce(scene.calibration, file, folder, "the chart's samples");
  }
  else if (isNamed(file, { "swatches", "tuning" }))
  {
    setOnce(scene.tuning, file, folder, "the tuning samples");
  }
}
}

SceneFolder findScene(const std::string& name)
{
  const fs::path folder(name);
  SceneFolder scene;
  Paths image;
  Paths white;
  Paths dark;
  for (const auto& path : entriesOf(folder))
  {
    std::error_code error;
    if (fs::is_directory(path, error))
    {
      if (isNamed(path, WhiteNames))
      {
        scene.white = oneImage(imagesIn(path), path, "the white reference");
      }
      else if (isNamed(path, DarkNames))
      {
        scene.dark = oneImage(imagesIn(path), path, "the dark frame");
      }
      continue;
    }
    if (isDataOfHeader(path))
    {
      continue;
    }
    switch (fileKind(path.string()))
    {
      case FileKind::SpectralImage:
        (startsWithOneOf(path, WhiteNames)     ? white
            : startsWithOneOf(path, DarkNames) ? dark
                                               : image)
          .push_back(path);
        break;
      case FileKind::LabelImage:
        setOnce(scene.labels, path, folder, "the label image");
        break;
      case FileKind::SampleTable:
        addTable(path, folder, scene);
        break;
      default:
        break;
    }
  }
  if (image.empty())
  {
    throw FormatError(name, "has no spectral image in it",
      "one file with all channels, or one file per channel",
      "name the folder that holds the image");
  }
  scene.image = oneImage(image, folder, "the image");
  if (scene.white.empty())
  {
    scene.white = oneImage(white, folder, "the white reference");
  }
  if (scene.dark.empty())
  {
    scene.dark = oneImage(dark, folder, "the dark frame");
  }
  return scene;
}

} // namespace msi
