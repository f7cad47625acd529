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
  double divisor(const char* file, const char* part, double level) const
  {
    if (!(level > LargestRelativeLevel))
    {
      return 1.0;
    }
    if (!WhiteLevel || *WhiteLevel <= LargestRelativeLevel)
    {
      throw FormatError((std::filesystem::path(Folder) / file).string(),
        std::string(part) + " reach " + numberText(level) + ", which looks like counts",
        "values relative to white (1 = perfect white), or the counts of white as 'white_level' in "
        "capture.json",
        "divide them by the counts of the perfect white");
    }
    Notes.push_back(std::string(part) + " in " + file +
      " were in counts: divided by the white level " + numberText(*WhiteLevel));
    return *WhiteLevel;
  }

private:
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
  capture.camera.values /= counts.divisor("camera.csv", "the curves", typicalLevel(white));
  auto& dark = capture.description.dark;
  if (!dark.empty())
  {
    Eigen::Map<Eigen::VectorXd> values(dark.data(), static_cast<Eigen::Index>(dark.size()));
    values /= counts.divisor("capture.json", "the dark values", typicalLevel(values));
  }
}

} // namespace msi
