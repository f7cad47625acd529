// A virtual optical bench for withheld cases: light, filters, detector, surfaces and everything that may be
// wrong with them, in steps of one nanometre. Shares no code with the project's simulator.
#pragma once

#include "Cases/CaseWriter.h"

#include <functional>
#include <string>
#include <vector>

namespace withheld
{

using Curve = std::vector<double>; // one value a nanometre, FirstNanometre .. LastNanometre
using Responses = std::vector<std::vector<double>>; // of each patch, of each channel
constexpr int FirstNanometre = 380;
constexpr int LastNanometre = 730;
constexpr int Nanometres = LastNanometre - FirstNanometre + 1;

struct Filter
{
  double center = 550.0;
  double width = 20.0;    // full width at half maximum
  double steepness = 2.0; // 2 Gaussian, larger nearer to a box
  double skew = 0.0;      // wider on the long side
  double height = 0.7;
  double floor = 0.0; // transmittance outside
};

struct Lamp
{
  double temperature = 2900.0; // K
  int first = 380, last = 730; // nm, where the blocking filters let light through
  double blueLed = 0.0;        // a narrow blue peak beside the thermal light
  double phosphor = 1.0;       // factor on the broad middle of the spectrum
  double age = 0.0;            // loss that grows toward short waves
};

struct Detector
{
  double blueLoss = 0.5;
  double redCut = 900.0;
};

struct Patch
{
  Curve reflectance; // as a perfect spectrophotometer sees it
  int medium = 0;
  int scene = 0;
  double column = 0.0, row = 0.0;
  int order = 0;
};

// What happens to light that leaves a patch, by medium.
using SurfaceEffect = std::function<void(Curve&)>;

struct Bench
{
  Lamp lamp;
  std::vector<Filter> filters;
  Detector detector;
  std::vector<double> gain;     // one a channel
  std::vector<double> dark;     // one a channel
  std::vector<double> exposure; // relative exposure times, for dark current

  std::vector<SurfaceEffect> surface;          // one a medium; may be empty
  double wholeShift = 0.0;                     // nm, moves lamp x filter x detector together
  std::vector<std::vector<double>> mixing;     // channels x channels; empty: none
  std::function<double(double, double)> field; // factor at column, row in -1..1
  double glare = 0.0;                          // of the scene's mean
  bool glareConserves = false;
  double scatter = 0.0;                // local
  double scatterReach = 1.0;           // in patch pitches
  std::function<double(double)> curve; // of the detector
  double fullWell = 1e9;
  std::function<double(double, int)> drift; // factor at time 0..1 in a channel
  // For effects that no library has: changes the finished response; (responses[patch][channel], patches).
  std::function<void(Responses&, const std::vector<Patch>&)> other;
  double noiseFactor = 1.0;
};

// Responsivity of channel k per nanometre, not normalised.
Curve responsivityOf(const Bench& bench, std::size_t channel);

// White response per channel; what a response is divided by.
std::vector<double> whiteOf(const Bench& bench);

// Noise-free responses [patch][channel] relative to `white`.
Responses expose(
  const Bench& bench, const std::vector<Patch>& patches, const std::vector<double>& white);

} // namespace withheld
