#include "Formats/Images/ImageMetadata.h"

#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <cstddef>
#include <string_view>

namespace msi
{

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
    if (key != "wavelengths" && key != "wavelength")
    {
      continue;
    }
    std::vector<double> list;
    const std::string text = attribute.get_string();
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
  return {};
}

std::string channelName(const OIIO::ImageSpec& spec, int channel)
{
  const auto at = static_cast<std::size_t>(channel);
  return at < spec.channelnames.size() && !spec.channelnames[at].empty()
    ? spec.channelnames[at]
    : "channel" + std::to_string(channel);
}

} // namespace msi
