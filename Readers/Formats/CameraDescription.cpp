#include "Formats/CameraDescription.h"

#include "Formats/Capture.h"
#include "Formats/Curves.h"
#include "Formats/FormatError.h"
#include "Formats/Storage/AtomicFile.h"
#include "Formats/Storage/WholeFile.h"
#include "Formats/Text/JsonText.h"
#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <array>
#include <filesystem>
#include <stdexcept>
#include <string_view>
#include <utility>

namespace msi
{

namespace
{
namespace fs = std::filesystem;
using Json = JsonText::Json;

bool isJson(const std::string& path)
{
  return lowerCase(fs::path(path).extension().string()) == ".json";
}

CameraModel modelOf(Curves curves, const Eigen::VectorXd& dark)
{
  return { std::move(curves.wavelengths), curves.values.transpose(), dark,
    std::move(curves.names) };
}

Eigen::VectorXd darkOf(const JsonText& reader, const Json& json, std::size_t channels)
{
  std::vector<double> dark = reader.channelNumbers(json, "dark");
  if (dark.size() <= 1)
  {
    dark.assign(channels, dark.empty() ? 0.0 : dark[0]);
  }
  if (dark.size() != channels)
  {
    throw FormatError(reader.placeOfKey("dark"),
      "'dark' has " + std::to_string(dark.size()) + " values",
      "one, or " + std::to_string(channels) + " as the curves have channels", "correct the list");
  }
  return Eigen::Map<const Eigen::VectorXd>(dark.data(), static_cast<Eigen::Index>(dark.size()));
}

std::optional<CameraNoise> noiseOf(const JsonText& reader, const Json& json)
{
  const Json* noise = JsonText::find(json, "noise");
  if (noise == nullptr)
  {
    return std::nullopt;
  }
  reader.requireType(noise->is_object(), "noise", "an object with read and shot, or null");
  const auto value = [&](const char* key) { return reader.numberFromZero(*noise, key); };
  return CameraNoise{ reader.deviation(*noise, "read").value_or(0.0),
    reader.deviation(*noise, "shot").value_or(0.0), value("fixed_pattern_gain").value_or(0.0),
    value("fixed_pattern_offset").value_or(0.0), value("quantisation_step").value_or(0.0) };
}

void noteUnknownKeys(const std::string& path, const Json& json, std::vector<std::string>& notes)
{
  static constexpr std::array<std::string_view, 6> Known = { "camera", "dark", "white_level",
    "noise", "white_after_effects", "effects" };
  for (const auto& [key, value] : json.items())
  {
    if (std::find(Known.begin(), Known.end(), key) == Known.end())
    {
      notes.push_back(fs::path(path).filename().string() + ": key '" + key + "' was left unread");
    }
  }
}

// A description names its curves beside it or below it: one that came from elsewhere must not have other files read.
std::string curvesPath(const JsonText& reader, const std::string& path, const Json& json)
{
  const fs::path file(path);
  const auto name = reader.text(json, "camera");
  if (!name)
  {
    return fs::path(file).replace_extension(".csv").string();
  }
  const fs::path curves(*name);
  const bool leaves = std::find(curves.begin(), curves.end(), "..") != curves.end();
  reader.requireType(
    !name->empty() && name->find('\0') == std::string::npos && !curves.is_absolute() && !leaves,
    "camera", "the name of a file beside this one, or in a folder below");
  return (file.parent_path() / curves).string();
}

CameraDescription parseDescription(const std::string& path, const std::string& text)
{
  const JsonText reader(path, text);
  const Json json = reader.parse();
  if (!json.is_object())
  {
    throw FormatError(path, std::string("holds ") + json.type_name(),
      "an object with camera, dark, noise and effects", "see Formats.md");
  }
  Curves curves = readCameraCurves(curvesPath(reader, path, json));
  std::vector<std::string> notes = std::move(curves.notes);
  const Eigen::VectorXd dark = darkOf(reader, json, curves.names.size());
  CameraDescription description{ modelOf(std::move(curves), dark) };
  description.notes = std::move(notes);
  description.whiteLevel = reader.number(json, "white_level").value_or(1.0);
  reader.requireType(description.whiteLevel > 0.0, "white_level", "a number above 0");
  description.noise = noiseOf(reader, json);
  description.whiteAfterEffects = reader.truth(json, "white_after_effects").value_or(false);
  if (JsonText::find(json, "effects") != nullptr)
  {
    description.effects = parseEffectList(path, text, description.camera.channels());
  }
  noteUnknownKeys(path, json, description.notes);
  return description;
}
}

CameraDescription readCameraDescription(const std::string& path)
{
  if (isJson(path))
  {
    return parseDescription(path, readTextFile(path, "a camera description (JSON)"));
  }
  Curves curves = readCameraCurves(path);
  std::vector<std::string> notes = std::move(curves.notes);
  const Eigen::VectorXd dark = Eigen::VectorXd::Zero(curves.values.cols());
  CameraDescription description{ modelOf(std::move(curves), dark) };
  description.notes = std::move(notes);
  return description;
}

void writeCameraDescription(const std::string& path, const CameraDescription& description)
{
  if (!isJson(path))
  {
    throw std::invalid_argument(
      "the camera is to be written to '" + path + "'; expected a name that ends in .json");
  }
  const CameraModel& camera = description.camera;
  const fs::path curves = fs::path(path).replace_extension(".csv");
  nlohmann::ordered_json json;
  json["camera"] = curves.filename().string();
  json["dark"] = std::vector<double>(camera.dark().begin(), camera.dark().end());
  json["white_level"] = description.whiteLevel;
  if (const auto& noise = description.noise)
  {
    json["noise"] = { { "read", noise->read }, { "shot", noise->shot },
      { "fixed_pattern_gain", noise->fixedPatternGain },
      { "fixed_pattern_offset", noise->fixedPatternOffset },
      { "quantisation_step", noise->quantisationStep } };
  }
  else
  {
    json["noise"] = nullptr;
  }
  json["white_after_effects"] = description.whiteAfterEffects;
  json["effects"] =
    nlohmann::ordered_json::parse(effectListText(description.effects, camera.channels()));

  writeCurves(curves.string(),
    { camera.wavelengths(), camera.channels(), camera.responsivity().transpose(), {} });
  AtomicFile file(path);
  file.append(json.dump(2, ' ', false, nlohmann::ordered_json::error_handler_t::replace) + "\n");
  file.commit();
}

} // namespace msi
