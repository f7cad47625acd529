#include "Formats/CaptureAlignment.h"

#include "Formats/FormatError.h"
#include "Formats/Text/NumberText.h"

#include "Kernels/Spectra/PossibleValues.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <iterator>

namespace msi
{

namespace
{
// The place of each name in `order`; empty where the names differ.
std::vector<Eigen::Index> placesIn(
  const std::vector<std::string>& names, const std::vector<std::string>& order)
{
  std::vector<Eigen::Index> places;
  for (const std::string& name : order)
  {
    const auto at = std::find_if(names.begin(), names.end(),
      [&name](const std::string& other) { return lowerCase(other) == lowerCase(name); });
    if (at == names.end())
    {
      return {};
    }
    places.push_back(std::distance(names.begin(), at));
  }
  return places;
}

// Levels that a capture in counts has at the least and at most, relative to white.
constexpr double DarkestLevel = 0.01;
constexpr double BrightestLevel = 10.0;

class Counts
{
public:
  Counts(Capture& capture, std::string folder)
    : Notes(capture.description.notes)
    , WhiteLevel(capture.description.whiteLevel)
    , Folder(std::move(folder))
  {
  }

  // 1, or what to divide by.
  double divisor(const std::string& file, const std::string& part, double level) const
  {
    if (!(level > LargestRelativeLevel))
    {
      return 1.0;
    }
    const double white = whiteLevel(file, part, level);
    if (level < DarkestLevel * white)
    {
      throw FormatError(pathOf(file), part + " reach " + numberText(level),
        "values up to 2, relative to white, or counts for the 'white_level' in capture.json, " +
          numberText(white),
        "correct 'white_level': the counts of the perfect white, or 1 for values relative to it");
    }
    return divided(file, part, white);
  }
  // Of the dark values, which may be a few counts.
  double divisorOfDark(bool curvesInCounts, double level) const
  {
    const char* file = "capture.json";
    const char* part = "the dark values";
    return level > LargestRelativeLevel || (curvesInCounts && level > 0.0)
      ? divided(file, part, whiteLevel(file, part, level))
      : 1.0;
  }

private:
  std::string pathOf(const std::string& file) const
  {
    return (std::filesystem::path(Folder) / file).string();
  }
  double whiteLevel(const std::string& file, const std::string& part, double level) const
  {
    if (!WhiteLevel || level > BrightestLevel * *WhiteLevel)
    {
      throw FormatError(pathOf(file),
        part + " reach " + numberText(level) + ", which looks like counts",
        "values relative to white (1 = perfect white), or the counts of white as 'white_level' in "
        "capture.json",
        "divide them by the counts of the perfect white");
    }
    return *WhiteLevel;
  }
  double divided(const std::string& file, const std::string& part, double white) const
  {
    if (white != 1.0)
    {
      Notes.push_back(
        part + " in " + file + " were in counts: divided by the white level " + numberText(white));
    }
    return white;
  }

  std::vector<std::string>& Notes;
  std::optional<double> WhiteLevel;
  std::string Folder;
};
}

void alignChannels(Capture& capture)
{
  const auto places = placesIn(capture.camera.names, capture.readings.channelNames);
  if (places.empty() || std::is_sorted(places.begin(), places.end()))
  {
    return;
  }
  capture.camera.values = capture.camera.values(Eigen::all, places).eval();
  auto& dark = capture.description.dark;
  const std::vector<std::string> names = capture.camera.names;
  const std::vector<double> values = dark;
  for (std::size_t k = 0; k < places.size(); ++k)
  {
    const auto from = static_cast<std::size_t>(places[k]);
    capture.camera.names[k] = names[from];
    if (!values.empty())
    {
      dark[k] = values[from];
    }
  }
  capture.description.notes.emplace_back(
    "camera.csv and responses.csv order the channels differently: matched by name");
}

void alignUnits(Capture& capture, const std::string& folder)
{
  const Counts counts(capture, folder);
  capture.readings.responses /=
    counts.divisor("responses.csv", "the responses", typicalLevel(capture.readings.responses));
  const Eigen::MatrixXd white = capture.camera.values.colwise().sum().transpose();
  const double ofCurves = counts.divisor("camera.csv", "the curves", typicalLevel(white));
  capture.camera.values /= ofCurves;
  auto& dark = capture.description.dark;
  if (!dark.empty())
  {
    Eigen::Map<Eigen::VectorXd> values(dark.data(), static_cast<Eigen::Index>(dark.size()));
    values /= counts.divisorOfDark(ofCurves > 1.0, typicalLevel(values));
  }
}

} // namespace msi
