#include "FuzzTarget.h"

#include "Formats/Images/SpectralExrName.h"
#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

// Names of columns, channels and files; they are never refused, only not understood.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size)
{
  const std::string name = textOf(data, size);
  if (const auto nm = msi::reflectanceColumnWavelength(name, true))
  {
    require(*nm >= 100.0 && *nm <= 20000.0);
  }
  if (const auto spectral = msi::parseSpectralExrName(name))
  {
    require(spectral->nanometres > 0.0);
    const auto back =
      msi::parseSpectralExrName(msi::spectralExrName(spectral->kind, spectral->nanometres));
    require(back && back->nanometres == spectral->nanometres);
  }
  if (const auto number = msi::parseNumber(name))
  {
    const auto back = msi::parseNumber(msi::numberText(*number));
    require(back && (*back == *number || *number != *number));
  }
  msi::responseColumnNumber(name);
  msi::fileNameWavelengths(name);
  msi::wavelengthInText(name);
  require(!msi::naturalLess(name, name));
  return 0;
}
