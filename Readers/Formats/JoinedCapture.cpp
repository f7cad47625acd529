#include "Formats/Capture.h"
#include "Formats/FormatError.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <set>
#include <utility>

namespace msi
{

namespace
{
namespace fs = std::filesystem;

std::string nameOf(const Capture& capture, const std::string& folder)
{
  return capture.description.name.empty()
    ? (fs::absolute(folder) / "").lexically_normal().parent_path().filename().string()
    : capture.description.name;
}

MetadataColumn& columnOf(SampleTable& table, const std::string& name, std::size_t rows)
{
  const MetadataColumn* known = table.findMetadata(name);
  if (known == nullptr)
  {
    table.metadata.push_back({ name, std::vector<std::string>(rows) });
    return table.metadata.back();
  }
  return table.metadata[static_cast<std::size_t>(known - table.metadata.data())];
}

// Cells without a scene are of the scene that the capture is.
void nameScene(Capture& capture, const std::string& scene)
{
  const auto rows = static_cast<std::size_t>(capture.samples.sampleCount());
  for (std::string& cell : columnOf(capture.samples, "scene", rows).text)
  {
    cell = cell.empty() ? scene : cell;
  }
}

// Every column of both; cells of a table that does not have one stay empty.
void append(SampleTable& to, SampleTable& more)
{
  const auto before = static_cast<std::size_t>(to.sampleCount());
  const auto added = static_cast<std::size_t>(more.sampleCount());
  for (const MetadataColumn& column : to.metadata)
  {
    columnOf(more, column.name, added);
  }
  for (MetadataColumn& column : more.metadata)
  {
    std::vector<std::string>& text = columnOf(to, column.name, before).text;
    text.insert(text.end(), column.text.begin(), column.text.end());
  }
  const auto join = [](Eigen::MatrixXd& matrix, const Eigen::MatrixXd& right)
  {
    if (matrix.rows() != right.rows() || matrix.rows() == 0)
    {
      matrix.resize(0, 0); // one of the two has none
      return;
    }
    Eigen::MatrixXd joined(matrix.rows(), matrix.cols() + right.cols());
    joined << matrix, right;
    matrix = std::move(joined);
  };
  join(to.reflectance, more.reflectance);
  join(to.responses, more.responses);
}

void requireSameCamera(const Capture& first, const Capture& more, const std::string& folder)
{
  const auto refuse = [&](const char* file, const std::string& what, const char* expected)
  {
    throw FormatError(
      (fs::path(folder) / file).string(), what, expected, "diagnose the two captures apart");
  };
  if (first.readings.channelNames != more.readings.channelNames)
  {
    refuse("responses.csv", "names other channels than the first capture", "the same channels");
  }
  const double largest = first.camera.values.cwiseAbs().maxCoeff();
  constexpr double Same = 1e-6;
  if (first.camera.wavelengths != more.camera.wavelengths ||
    (first.camera.values - more.camera.values).cwiseAbs().maxCoeff() > Same * largest ||
    first.description.dark != more.description.dark)
  {
    refuse("camera.csv",
      "is another simulated camera than that of the first capture, or has another 'dark'",
      "the same camera, to which both captures are compared");
  }
  if (first.samples.wavelengths != more.samples.wavelengths)
  {
    refuse("samples.csv", "has other wavelengths than the first capture", "the same wavelengths");
  }
}

void append(Capture& to, Capture more, const std::string& scene)
{
  std::set<std::string> known;
  for (const std::string& name : to.samples.sampleNames())
  {
    known.insert(name);
  }
  const auto renamed = [&](const std::string& name)
  { return known.count(name) > 0 ? name + " (" + scene + ")" : name; };
  std::vector<std::string> names = more.samples.sampleNames();
  std::transform(names.begin(), names.end(), names.begin(), renamed);
  columnOf(more.samples, "sample", names.size()).text = std::move(names);
  columnOf(to.samples, "sample", static_cast<std::size_t>(to.samples.sampleCount())).text =
    to.samples.sampleNames();
  append(to.samples, more.samples);

  // Readings as a table of responses, for the same rules.
  const auto tableOf = [](RepeatedResponses& readings)
  {
    SampleTable table;
    table.metadata = std::move(readings.metadata);
    table.responses = std::move(readings.responses);
    return table;
  };
  SampleTable readings = tableOf(to.readings);
  SampleTable added = tableOf(more.readings);
  append(readings, added);
  to.readings.metadata = std::move(readings.metadata);
  to.readings.responses = std::move(readings.responses);
  std::transform(more.readings.sample.begin(), more.readings.sample.end(),
    std::back_inserter(to.readings.sample), renamed);
  to.readings.repeat.insert(
    to.readings.repeat.end(), more.readings.repeat.begin(), more.readings.repeat.end());
  for (std::string& note : more.description.notes)
  {
    to.description.notes.push_back(scene + ": " + std::move(note));
  }
}
}

Capture readCaptures(const std::vector<std::string>& folders)
{
  for (std::size_t f = 1; f < folders.size(); ++f)
  {
    std::error_code error; // of folders that are not there: they are read below, which says so
    const auto same = std::find_if(folders.begin(), folders.begin() + f,
      [&](const std::string& other)
      { return std::filesystem::equivalent(other, folders[f], error); });
    if (same != folders.begin() + f)
    {
      throw FormatError(folders[f], "is the same capture as " + *same,
        "another capture of the same camera", "name each capture once");
    }
  }
  Capture joined = readCapture(folders.front());
  std::set<std::string> scenes{ nameOf(joined, folders.front()) };
  if (folders.size() > 1)
  {
    nameScene(joined, *scenes.begin());
  }
  for (std::size_t f = 1; f < folders.size(); ++f)
  {
    Capture more = readCapture(folders[f]);
    requireSameCamera(joined, more, folders[f]);
    std::string scene = nameOf(more, folders[f]);
    if (!scenes.insert(scene).second)
    {
      scene += " " + std::to_string(f + 1);
      scenes.insert(scene);
    }
    nameScene(more, scene);
    append(joined, std::move(more), scene);
  }
  return joined;
}

} // namespace msi
