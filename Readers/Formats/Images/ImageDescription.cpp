#include "Formats/Images/ImageDescription.h"

#include <stdexcept>
#include <string>

namespace msi
{

void requireConsistent(const SpectralImageInfo& info)
{
  if (info.width < 1 || info.height < 1 || info.bands() < 1)
  {
    throw std::invalid_argument("an image of " + std::to_string(info.width) + " x " +
      std::to_string(info.height) + " pixels and " + std::to_string(info.bands()) +
      " bands cannot be written; expected at least one of each");
  }
  const auto require = [&info](std::size_t count, const char* list)
  {
    if (count != 0 && count != info.bandNames.size())
    {
      throw std::invalid_argument(std::string(list) + " has " + std::to_string(count) +
        " values; expected " + std::to_string(info.bands()) + ", one for each band");
    }
  };
  require(info.wavelengths.size(), "the wavelength list");
  require(info.fwhm.size(), "the bandwidth list");
  require(info.goodBands.size(), "the good band list");
  for (const int band : info.displayBands)
  {
    if (band < 0 || band >= info.bands())
    {
      throw std::invalid_argument("display band " + std::to_string(band) +
        " is not within the image of " + std::to_string(info.bands()) + " bands");
    }
  }
}

} // namespace msi
