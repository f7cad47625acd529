// One withheld case: what the camera answered, what the model says, and, apart, what was planted.
#pragma once

#include "VirtualBench.h"

#include <cstdint>
#include <string>
#include <vector>

namespace withheld
{

struct CaseRequest
{
  std::uint64_t seed = 1;
  std::vector<std::string> effects; // names to plant; none: a clean capture
  std::string stranger;             // a kind that the library does not have
  double strength = 1.0;
  int samples = 200;
  bool nominalErrors = false; // every gain 0.4 %, center 0.3 nm, dark 0.0003 off
};

// What goes into the capture's folder.
struct CaseCapture
{
  std::vector<double> cameraWavelengths;
  std::vector<std::vector<double>> camera; // [wavelength][channel]
  std::vector<double> sampleWavelengths;
  std::vector<std::vector<double>> reflectance; // [sample][wavelength]
  std::vector<Patch> patches;                   // medium, scene, place, order
  std::vector<std::string> media;
  std::vector<std::vector<double>> readings; // [reading][channel], sample after sample
  int repeats = 1;
  bool noiseKnown = true;
  double read = 0.0, shot = 0.0;
  std::vector<double> dark; // one a channel
};

// What only the scorer may see.
struct CaseKey
{
  std::vector<std::string> effects; // empty: clean; "?" for a stranger
  std::vector<std::string> kinds;
  std::vector<std::vector<std::string>> axes; // acceptable, one list an effect
  double gapRms = 0.0;                        // noise-free
  double bestShrink = 1.0; // of a simulator that has the effect but this camera.csv
};

struct WithheldCase
{
  CaseCapture capture;
  CaseKey key;
};

// Real spectra come from the folder in MULTISPECTRAL_DATA where it is set.
WithheldCase makeCase(const CaseRequest& request);

} // namespace withheld
