// Channel names of spectral OpenEXR.
#pragma once

#include <optional>
#include <string>
#include <string_view>

namespace msi
{

inline constexpr double SpeedOfLight = 299792458.0; // m/s, that is nm GHz

struct SpectralExrName
{
  char kind;         // 'T' reflective or transmissive, 'S' emissive
  int stokes;        // 0..3 of S0..S3; 0 for T
  double nanometres; // wavelength, or that of the frequency
  bool reradiating;  // bispectral: a second wavelength follows
};

// T.400,0nm  S0.400,0nm  S0.4,0E2nm  S1.0,5um  T.749,48THz; nothing for any other name.
// Source: A. Fichet, R. Pacanowski, A. Wilkie, "An OpenEXR Layout for Spectral Images", JCGT 10(3),
//         2021, section 4.
std::optional<SpectralExrName> parseSpectralExrName(std::string_view name);

// The attribute that says, as "responses", that T channels are no reflectance but camera responses.
inline constexpr const char* QuantityAttribute = "multispectralQuantity";

// The name of a channel at a wavelength, with the shortest decimals: T.400nm, S0.400,5nm.
std::string spectralExrName(char kind, double nanometres);

} // namespace msi
