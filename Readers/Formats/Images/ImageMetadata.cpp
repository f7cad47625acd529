#include "Formats/Images/ImageMetadata.h"

#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace msi
{

namespace
{
std::vector<double> listOfWavelengths(const std::string& text)
{
  std::vector<double> list;
  for (std::size_t at = 0; (at = text.find_first_not_of(" ,;{}[]", at)) != std::string::npos;)
  {
    const std::size_t end = std::min(text.find_first_of(" ,;{}[]", at), text.size());
    const auto nm = reflectanceColumnWavelength(std::string_view(text).substr(at, end - at));
    if (!nm)
    {
      return {};
    }
    list.push_back(*nm);
    at = end;
  }
  return list;
}

// TIFF: samples without a meaning as colors, which OpenImageIO names R, G, B all the same.
bool isGray(const OIIO::ImageSpec& spec)
{
  constexpr int WhiteIsZero = 0;
  constexpr int BlackIsZero = 1;
  const int photometric = spec.get_int_attribute("tiff:PhotometricInterpretation", -1);
  return photometric == WhiteIsZero || photometric == BlackIsZero;
}
}

std::optional<double> metadataWavelength(const OIIO::ImageSpec& spec)
{
  for (const auto& attribute : spec.extra_attribs)
  {
    const std::string key = lowerCase(attribute.name().string());
    const std::string value = attribute.get_string();
    if (key == "wavelength" || key == "centralwavelength" || key == "central wavelength")
    {
      return reflectanceColumnWavelength(value);
    }
  }
  for (const char* key : { "ImageDescription", "tiff:PageName", "PageName", "oiio:subimagename" })
  {
    if (const auto nm = wavelengthInText(spec.get_string_attribute(key)))
    {
      return nm;
    }
  }
  return std::nullopt;
}

std::vector<double> metadataWavelengths(const OIIO::ImageSpec& spec)
{
  for (const auto& attribute : spec.extra_attribs)
  {
    const std::string key = lowerCase(attribute.name().string());
    if (key == "wavelengths" || key == "wavelength")
    {
      return listOfWavelengths(attribute.get_string());
    }
  }
  const std::string description = lowerCase(spec.get_string_attribute("ImageDescription"));
  constexpr std::string_view key = "wavelengths";
  const std::size_t at = description.find(key);
  if (at == std::string::npos)
  {
    return {};
  }
  const std::size_t begin = description.find_first_not_of("\"' :=[{(", at + key.size());
  const std::size_t end = description.find_first_not_of("0123456789. ,;nm", begin);
  return begin == std::string::npos ? std::vector<double>()
                                    : listOfWavelengths(description.substr(begin, end - begin));
}

std::string channelName(const OIIO::ImageSpec& spec, int channel)
{
  if (isGray(spec) && spec.nchannels > 1)
  {
    return "Band " + std::to_string(channel + 1);
  }
  const auto at = static_cast<std::size_t>(channel);
  return at < spec.channelnames.size() && !spec.channelnames[at].empty()
    ? spec.channelnames[at]
    : "channel" + std::to_string(channel);
}

} // namespace msi
