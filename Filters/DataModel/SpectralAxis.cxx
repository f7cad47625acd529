#include "SpectralAxis.h"

#include <charconv>
#include <sstream>
#include <stdexcept>

namespace msi
{

namespace
{
constexpr double SameWavelength = 0.5; // nm

bool sameAxis(const SpectralAxis& a, const SpectralAxis& b)
{
  if (a.size() != b.size())
  {
    return false;
  }
  return !a.wavelengths || !b.wavelengths ||
    (a.wavelengths->vector() - b.wavelengths->vector()).cwiseAbs().maxCoeff() <= SameWavelength;
}
}

std::string wavelengthText(double nanometres)
{
  char text[32];
  const auto end = std::to_chars(text, text + sizeof(text), nanometres);
  return std::string(text, end.ptr);
}

SpectralAxis axisOf(const WavelengthGrid& wavelengths)
{
  SpectralAxis axis{ {}, wavelengths };
  for (const double wavelength : wavelengths.values())
  {
    axis.names.push_back(wavelengthText(wavelength));
  }
  return axis;
}

std::string describe(const SpectralAxis& axis, const char* what)
{
  constexpr std::size_t ShownAtStart = 2;
  std::ostringstream text;
  text << axis.size() << ' ' << what << " (";
  for (std::size_t i = 0; i < axis.size(); ++i)
  {
    if (i == ShownAtStart && axis.size() > ShownAtStart + 2)
    {
      text << ", ..";
      i = axis.size() - 1;
    }
    text << (i > 0 ? ", " : "") << axis.names[i];
  }
  text << (axis.wavelengths ? " nm)" : ")");
  return text.str();
}

std::string nameOf(const SpectralAxis& axis, std::size_t component)
{
  return axis.names[component] + (axis.wavelengths ? " nm" : "");
}

void requireSameChannels(const SpectralAxis& a, const std::string& nameOfA, const SpectralAxis& b,
  const std::string& nameOfB)
{
  if (!sameAxis(a, b))
  {
    throw std::invalid_argument(nameOfA + " has " + describe(a, "channels") + ", but " + nameOfB +
      " has " + describe(b, "channels") +
      "; both must come from the same camera with the same channels");
  }
}

void requireSameBands(const SpectralAxis& a, const std::string& nameOfA, const SpectralAxis& b,
  const std::string& nameOfB)
{
  if (!sameAxis(a, b))
  {
    throw std::invalid_argument(nameOfA + " has " + describe(a, "bands") + ", but " + nameOfB +
      " has " + describe(b, "bands") + "; resample one of them first");
  }
}

} // namespace msi
