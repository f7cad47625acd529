// The channels of a camera or the bands of a spectrum: what the components of an array stand for.
#ifndef SpectralAxis_h
#define SpectralAxis_h

#include "Kernels/Spectra/WavelengthGrid.h"

#include <optional>
#include <string>
#include <vector>

namespace msi
{

// names: one per component, never empty ("400", "C1").
// wavelengths: nm, increasing; absent where a camera's channels are only numbered.
struct SpectralAxis
{
  std::vector<std::string> names;
  std::optional<WavelengthGrid> wavelengths;

  std::size_t size() const noexcept { return names.size(); }
};

// Shortest decimal text of a wavelength: 400, 402.5.
std::string wavelengthText(double nanometres);

SpectralAxis axisOf(const WavelengthGrid& wavelengths);

// "400 nm", "C1"
std::string nameOf(const SpectralAxis& axis, std::size_t component);

// "16 channels (400, 420, .., 700 nm)" for error messages.
std::string describe(const SpectralAxis& axis, const char* what);

// Two axes name the same channels: as many of them and, where both know wavelengths, each within
// half a nanometre. Throws std::invalid_argument that describes both sides otherwise.
void requireSameChannels(const SpectralAxis& a, const std::string& nameOfA, const SpectralAxis& b,
  const std::string& nameOfB);

// The same for the bands of reflectance spectra.
void requireSameBands(const SpectralAxis& a, const std::string& nameOfA, const SpectralAxis& b,
  const std::string& nameOfB);

} // namespace msi

#endif
