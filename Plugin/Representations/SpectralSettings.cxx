#include "SpectralSettings.h"

#include "vtkSMSettings.h"

#include <sstream>
#include <string>
#include <vector>

namespace msi
{

namespace
{
constexpr const char* Gray = "[0.8, 0.8, 0.8]";
// ParaView's own settings have priority 0 and more.
constexpr double BelowTheUsers = -1.0;

// Names that leave no doubt: without these, ParaView asks whether its own readers shall read a channel or a chart. Three
// texts each: patterns, description, reader.
constexpr const char* ReadersByName =
  R"json({"settings": {"RepresentedArrayListSettings": {"ReaderDetails": [
"*nm.tif *nm.tiff *nm.png *nm.exr", "Spectral image (one file per channel)", "SpectralImageReader",
"labels.png labels.tif labels.tiff", "Label image", "LabelImageReader",
"*chart*.csv patches.csv *swatches*.csv tuning.csv calibration.csv", "Sample table", "SampleTableReader",
"camera.csv camera.json", "Camera", "CameraReader",
"capture.json", "Capture", "CaptureReader"]}}})json";

// ParaView drops all but letters and digits from the name of an array.
std::string keyOf(const std::string& arrayName)
{
  std::string key;
  for (const char c : arrayName)
  {
    if ((c >= '0' && c <= '9') || (c >= 'A' && c <= 'Z') || (c >= 'a' && c <= 'z') || c == '_' ||
      c == '-' || c == '.')
    {
      key += c;
    }
  }
  return key;
}

std::vector<std::string> illuminants()
{
  std::vector<std::string> names{ "A", "D50", "D65" };
  for (int i = 1; i <= 12; ++i)
  {
    names.push_back("F" + std::to_string(i));
    names.push_back("FL" + std::to_string(i));
  }
  for (int i = 1; i <= 5; ++i)
  {
    names.push_back("LED-B" + std::to_string(i));
  }
  return names;
}

class Settings
{
public:
  void preset(const std::string& array, const char* name)
  {
    Presets << (Presets.tellp() > 0 ? "," : "") << '"' << keyOf(array) << "\": \"" << name << '"';
  }
  void map(const std::string& array, const std::string& properties)
  {
    Maps << (Maps.tellp() > 0 ? "," : "") << '"' << keyOf(array)
         << "\": {\"PVLookupTable\": {\"NanColor\": " << Gray << (properties.empty() ? "" : ", ")
         << properties << "}}";
  }
  std::string text() const
  {
    return "{\"standard_presets\": {" + Presets.str() + "}, \"array_lookup_tables\": {" +
      Maps.str() + "}}";
  }

private:
  std::ostringstream Presets;
  std::ostringstream Maps;
};
}

void registerSettings()
{
  // Viridis (S. van der Walt and N. Smith, CC0) at 0, 1/4, 1/2, 3/4 and 1.
  const std::string differences = "\"RGBPoints\": [0, 0.267004, 0.004874, 0.329415, "
                                  "1, 0.229739, 0.322361, 0.545706, "
                                  "2, 0.127568, 0.566949, 0.550556, "
                                  "3, 0.369214, 0.788888, 0.382914, "
                                  "5, 0.993248, 0.906157, 0.143936], "
                                  "\"ColorSpace\": 2, \"ScalarRangeInitialized\": 1, "
                                  "\"AutomaticRescaleRangeMode\": -1";
  const std::string oneBand = "\"VectorMode\": 1, \"VectorComponent\": 0";
  Settings settings;
  for (const auto& illuminant : illuminants())
  {
    settings.map("dE00 " + illuminant, differences);
  }
  settings.preset("rms", "Viridis (matplotlib)");
  settings.map("rms", "");
  for (const char* array : { "Reflectance", "Responses", "Uncertainty" })
  {
    settings.preset(array, "Viridis (matplotlib)");
    settings.map(array, oneBand);
  }
  settings.preset("Difference", "Cool to Warm");
  settings.map("Difference", oneBand + ", \"AutomaticRescaleRangeMode\": -1");
  settings.map("Label", "");
  vtkSMSettings::GetInstance()->AddCollectionFromString(settings.text(), BelowTheUsers);
  vtkSMSettings::GetInstance()->AddCollectionFromString(ReadersByName, BelowTheUsers);
}

} // namespace msi
