#include "Formats/Capture.h"

#include "Formats/CaptureAlignment.h"
#include "Formats/FormatError.h"
#include "Formats/Storage/WholeFile.h"
#include "Formats/Tables/SampleColumns.h"
#include "Formats/Text/DelimitedText.h"
#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <filesystem>
#include <map>
#include <set>
#include <system_error>
#include <utility>

namespace msi
{

namespace
{
namespace fs = std::filesystem;

// The number of each reading within its sample, in the order of the file.
std::vector<int> countedRepeats(const std::vector<std::string>& samples)
{
  std::map<std::string, int> count;
  std::vector<int> repeat;
  repeat.reserve(samples.size());
  std::transform(samples.begin(), samples.end(), std::back_inserter(repeat),
    [&count](const std::string& sample) { return ++count[sample]; });
  return repeat;
}

std::vector<int> repeatsOf(
  const MetadataColumn* column, const std::vector<std::string>& samples, const TextTable& table)
{
  if (column == nullptr)
  {
    return countedRepeats(samples);
  }
  std::vector<int> repeat;
  std::set<std::pair<std::string, int>> seen;
  for (std::size_t i = 0; i < samples.size(); ++i)
  {
    const auto number = parseInteger(column->text[i]);
    const FilePlace place = table.place(table.rows[i + 1][0]);
    if (!number || *number < 0)
    {
      throw FormatError(place, "repeat is '" + column->text[i] + "'", "a whole number from 0 up",
        "number the readings of each sample");
    }
    if (!seen.emplace(samples[i], *number).second)
    {
      throw FormatError(place,
        "sample '" + samples[i] + "' has repeat " + std::to_string(*number) + " a second time",
        "another number for each reading of a sample", "correct the number or remove the row");
    }
    repeat.push_back(*number);
  }
  return repeat;
}

// camera.csv and responses.csv name the same channels, or at least as many.
void requireSameChannels(const Capture& capture, const std::string& folder)
{
  const std::size_t camera = capture.camera.names.size();
  const std::size_t real = capture.readings.channelNames.size();
  if (camera != real)
  {
    throw FormatError((fs::path(folder) / "responses.csv").string(),
      "has " + std::to_string(real) + " channels", std::to_string(camera) + ", as camera.csv has",
      "give both the same channels");
  }
}

void spreadDark(Capture& capture, const std::string& folder)
{
  std::vector<double>& dark = capture.description.dark;
  const std::size_t channels = capture.camera.names.size();
  if (dark.size() == 1)
  {
    dark.assign(channels, dark[0]);
  }
  if (!dark.empty() && dark.size() != channels)
  {
    throw FormatError((fs::path(folder) / "capture.json").string(),
      "'dark' has " + std::to_string(dark.size()) + " values",
      "one, or " + std::to_string(channels) + " as camera.csv has channels", "correct the list");
  }
}

void requireKnownSamples(const Capture& capture, const std::string& folder)
{
  const auto names = capture.samples.sampleNames();
  std::set<std::string> known;
  for (const std::string& name : names)
  {
    if (!known.insert(name).second)
    {
      throw FormatError((fs::path(folder) / "samples.csv").string(),
        "sample '" + name + "' stands in it twice", "each sample once", "rename one of them");
    }
  }
  for (const std::string& name : capture.readings.sample)
  {
    if (known.count(name) == 0)
    {
      throw FormatError((fs::path(folder) / "responses.csv").string(),
        "sample '" + name + "' is not in samples.csv", "a reflectance for every reading",
        "add the sample to samples.csv or remove its readings");
    }
  }
}

std::vector<std::string> filesIn(const fs::path& folder)
{
  std::vector<std::string> files;
  std::error_code error;
  for (fs::directory_iterator at(folder, error), end; !error && at != end; at.increment(error))
  {
    if (at->path().filename().string().front() != '.')
    {
      files.push_back(at->path().string());
    }
  }
  std::sort(files.begin(), files.end(),
    [](const std::string& a, const std::string& b) { return naturalLess(a, b); });
  return files;
}
}

Curves readCameraCurves(const std::string& path)
{
  Curves camera = readCurves(path);
  if (!camera.wavelengths.step() && camera.wavelengths.size() > 1)
  {
    const auto& nm = camera.wavelengths.values();
    std::size_t odd = 2;
    while (odd + 1 < nm.size() && std::abs((nm[odd] - nm[odd - 1]) - (nm[1] - nm[0])) <= 1e-6)
    {
      ++odd;
    }
    throw FormatError(path,
      "the wavelengths step by " + numberText(nm[1] - nm[0]) + " nm at first and by " +
        numberText(nm[odd] - nm[odd - 1]) + " nm before " + numberText(nm[odd]) + " nm",
      "a uniform grid", "interpolate the curves");
  }
  return camera;
}

RepeatedResponses readRepeatedResponses(const std::string& path)
{
  const TextTable text =
    parseDelimitedText(path, readTextFile(path, "a table with sample, repeat and responses"));
  SampleTable table = samplesFromText(text, ReflectanceUnit::Factor);
  const MetadataColumn* sample = table.findMetadata("sample");
  if (!table.hasResponses() || sample == nullptr)
  {
    throw FormatError(text.place(text.rows[0][0]),
      sample == nullptr ? "there is no column 'sample'" : "there are no columns C1, C2, ...",
      "the columns sample, repeat, C1, C2, ...", "rename the columns");
  }
  RepeatedResponses readings;
  readings.sample = sample->text;
  readings.repeat = repeatsOf(table.findMetadata("repeat"), readings.sample, text);
  readings.channelNames = std::move(table.channelNames);
  readings.responses = std::move(table.responses);
  for (MetadataColumn& column : table.metadata)
  {
    const std::string name = lowerCase(column.name);
    if (name != "sample" && name != "repeat")
    {
      readings.metadata.push_back(std::move(column));
    }
  }
  return readings;
}

Capture readCapture(const std::string& folder)
{
  std::error_code error;
  if (!fs::is_directory(folder, error))
  {
    throw FormatError(folder, "is no folder",
      "a folder with capture.json, camera.csv, samples.csv and responses.csv",
      "name the folder of the capture");
  }
  const fs::path root(folder);
  const std::string samplesPath = (root / "samples.csv").string();
  Capture capture{ readCaptureDescription((root / "capture.json").string()),
    readCameraCurves((root / "camera.csv").string()), readSampleTable(samplesPath),
    readRepeatedResponses((root / "responses.csv").string()), filesIn(root / "images") };
  if (!capture.samples.hasReflectance())
  {
    throw FormatError(samplesPath, "has no reflectance", "columns R400, R410, ...",
      "add the measured reflectance of the samples");
  }
  requireSameChannels(capture, folder);
  spreadDark(capture, folder);
  requireKnownSamples(capture, folder);
  alignChannels(capture);
  alignUnits(capture, folder);
  return capture;
}

} // namespace msi
