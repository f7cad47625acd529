#include "Formats/Images/EnviHeader.h"

#include "Formats/Text/NumberText.h"

#include <cstddef>
#include <stdexcept>
#include <string_view>

namespace msi
{

namespace
{
int typeCode(SampleType type)
{
  switch (type)
  {
    case SampleType::UInt8:
      return 1;
    case SampleType::Int16:
      return 2;
    case SampleType::Int32:
      return 3;
    case SampleType::Float32:
      return 4;
    case SampleType::Float64:
      return 5;
    case SampleType::UInt16:
      return 12;
    case SampleType::UInt32:
      return 13;
    case SampleType::Int64:
      return 14;
    case SampleType::UInt64:
      return 15;
    case SampleType::Int8:
      break;
  }
  throw std::invalid_argument(
    "ENVI has no sample type int8; expected uint8, int16 or another type");
}

// Text that cannot end the value it stands in. No blank stands for a brace or comma: "450{nm" would become a wavelength.
std::string plain(std::string text, bool inList)
{
  constexpr std::string_view Ending = "{}\n\r,";
  constexpr std::string_view Harmless = "()  ;";
  for (char& c : text)
  {
    const std::size_t at = Ending.find(c);
    if (at != std::string_view::npos && (c != ',' || inList))
    {
      c = Harmless[at];
    }
  }
  return text;
}

template <typename Values, typename ToText>
void appendList(std::string& text, const char* key, const Values& values, ToText toText)
{
  if (values.empty())
  {
    return;
  }
  text += std::string(key) + " = {";
  for (std::size_t i = 0; i < values.size(); ++i)
  {
    text += (i > 0 ? (i % 8 == 0 ? ",\n " : ", ") : "") + toText(values[i]);
  }
  text += "}\n";
}
}

std::string enviHeaderText(const EnviHeader& header)
{
  const SpectralImageInfo& info = header.info;
  std::string text = "ENVI\n";
  const auto line = [&text](const char* key, const std::string& value)
  { text += std::string(key) + " = " + value + "\n"; };
  // What stays true whatever became of the samples.
  for (const char* key : { "description", "sensor type", "acquisition date", "acquisition time" })
  {
    const auto found = info.metadata.find(key);
    if (found != info.metadata.end())
    {
      const bool isLong = key == std::string_view("description");
      line(key, (isLong ? "{" : "") + plain(found->second, false) + (isLong ? "}" : ""));
    }
  }
  line("samples", std::to_string(info.width));
  line("lines", std::to_string(info.height));
  line("bands", std::to_string(info.bands()));
  line("header offset", std::to_string(header.headerOffset));
  line("file type", "ENVI Standard");
  line("data type", std::to_string(typeCode(header.type)));
  line("interleave",
    header.interleave == Interleave::BSQ     ? "bsq"
      : header.interleave == Interleave::BIL ? "bil"
                                             : "bip");
  line("byte order", header.byteOrder == ByteOrder::Big ? "1" : "0");
  if (info.ignoreValue)
  {
    line("data ignore value", numberText(*info.ignoreValue));
  }
  if (info.reflectanceScale != 1.0 || info.quantity == "reflectance")
  {
    line("reflectance scale factor", numberText(info.reflectanceScale));
  }
  const auto number = [](double value) { return numberText(value); };
  if (!info.wavelengths.empty())
  {
    line("wavelength units", "Nanometers");
    appendList(text, "wavelength", info.wavelengths, number);
    appendList(text, "fwhm", info.fwhm, number);
  }
  appendList(text, "bbl", info.goodBands, [](bool good) { return std::string(good ? "1" : "0"); });
  appendList(
    text, "band names", info.bandNames, [](const std::string& name) { return plain(name, true); });
  appendList(
    text, "default bands", info.displayBands, [](int band) { return std::to_string(band + 1); });
  return text;
}

} // namespace msi
