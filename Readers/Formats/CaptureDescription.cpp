#include "Formats/Capture.h"

#include "Formats/FormatError.h"
#include "Formats/Storage/WholeFile.h"
#include "Formats/Text/JsonText.h"

namespace msi
{

namespace
{
void noteUnknownKeys(const JsonText::Json& json, CaptureDescription& capture)
{
  for (const auto& [key, value] : json.items())
  {
    if (key != "name" && key != "white_level" && key != "dark" && key != "noise")
    {
      capture.notes.push_back("capture.json: key '" + key + "' was left unread");
    }
  }
}
}

CaptureDescription parseCaptureDescription(const std::string& file, const std::string& text)
{
  const JsonText reader(file, text);
  const JsonText::Json json = reader.parse();
  if (!json.is_object())
  {
    throw FormatError(file, std::string("holds ") + json.type_name(),
      "an object with name, white_level, dark and noise", "see Formats.md");
  }
  CaptureDescription capture;
  capture.name = reader.text(json, "name").value_or("");
  capture.whiteLevel = reader.number(json, "white_level");
  reader.requireType(
    !capture.whiteLevel || *capture.whiteLevel > 0.0, "white_level", "a number above 0");
  capture.dark = reader.channelNumbers(json, "dark");
  if (const JsonText::Json* noise = JsonText::find(json, "noise"))
  {
    reader.requireType(noise->is_object(), "noise", "an object with read and shot, or null");
    capture.noise = { reader.deviation(*noise, "read"), reader.deviation(*noise, "shot") };
  }
  noteUnknownKeys(json, capture);
  return capture;
}

CaptureDescription readCaptureDescription(const std::string& path)
{
  return parseCaptureDescription(path, readTextFile(path, "a capture description (JSON)"));
}

} // namespace msi
