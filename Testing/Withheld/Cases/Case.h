// One withheld case: what the camera answered, what the model says, and, apart, what was planted. What all generators
// share, and all that they share.
#pragma once

#include <string>
#include <vector>

namespace withheld
{

struct Sample
{
  std::string medium, scene;
  double x = 0.0, y = 0.0;
  double order = 0.0;
  std::vector<double> reflectance; // as measured, at Capture::sampleWavelengths
};

// A table of samples, its camera and its readings.
struct Capture
{
  std::vector<double> cameraWavelengths;
  std::vector<std::vector<double>> camera; // [wavelength][channel]
  std::vector<double> sampleWavelengths;
  std::vector<Sample> samples;
  std::vector<std::vector<double>> readings; // [reading][channel], sample after sample
  int repeats = 1;                           // of each sample
  bool noiseKnown = true;
  double read = 0.0, shot = 0.0; // variance of a reading: read^2 + shot^2 u
  std::vector<double> dark;      // one a channel
};

// A real and a simulated image of the same scene.
struct ImagePair
{
  int width = 0, height = 0, channels = 0;
  std::vector<float> real, simulated; // pixel after pixel, all channels of a pixel together
  std::vector<int> labels;            // one a pixel, 0: none; may be empty
};

// What only the scorer may see.
struct Key
{
  std::string set;                  // single, several, clean, stranger, removed, nominal, ...
  std::vector<std::string> effects; // empty: clean; "?" for one that the library does not have
  std::vector<std::string> kinds;   // what was planted, in words
  std::vector<std::string> axes;    // acceptable first axes of `where`
  double gapRms = 0.0;              // noise-free
  double bestShrink = 1.0;          // of a simulator that has the effect but this nominal camera
  std::string without;              // an effect that may not be blamed
  std::string twin;                 // of a removed effect: the same capture with the whole library
};

} // namespace withheld
