// The camera of the second generator: passbands of filters, of a tunable filter or of diodes, as parts that may err.
#pragma once

#include "Cases/CaseWriter.h"

#include <valarray>
#include <vector>

namespace withheld::second
{

// In steps of half a nanometre.
using Spectrum = std::valarray<double>;
constexpr double Lowest = 360.0;
constexpr double Highest = 760.0;
constexpr double Step = 0.5;
const Spectrum& wavelengths();

enum class Optics
{
  CavityFilters, // interference filters: Butterworth passbands
  TunableFilter, // cosine-squared main lobe with side lobes, wider towards the red
  Diodes         // the light is coloured: one diode a channel, skewed in wavelength
};

struct Passband
{
  double center = 550.0;
  double width = 20.0; // half maximum
  double order = 3.0;  // of a cavity filter
  double leak = 0.0;   // beyond 650 nm and below 430 nm, relative to the peak
};

enum class LampKind
{
  Halogen,
  Daylight,
  Fluorescent, // lines of mercury over phosphors
  WhiteDiode
};

struct Lamp
{
  LampKind kind = LampKind::Halogen;
  double warmth = 0.0; // shifts the balance from blue to red: a ratio in the logarithm per 100 nm
  double other = 0.0;  // part of a second lamp, daylight, in the room
  double bump = 0.0;   // a coating: loss in the logarithm around 500 nm
};

struct Camera
{
  Optics optics = Optics::CavityFilters;
  std::vector<Passband> passbands;
  Lamp lamp;
  double detectorPeak = 560.0;
  double detectorWidth = 170.0;
  double first = Lowest, last = Highest; // edges of the blocking filter
  double smear = 0.0;                    // standard deviation of a Gaussian over the passbands, nm
};

Camera drawCamera(Random& random, bool withLamp);

// Light x passband x detector of each channel.
std::vector<Spectrum> responsivities(const Camera& camera);

} // namespace withheld::second
