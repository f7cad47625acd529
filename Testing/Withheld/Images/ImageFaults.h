// What goes wrong with an image, in the order of the optics; each fault of its own formula.
#pragma once

#include "ImageScene.h"

#include <string>

namespace withheld
{

using Planes = std::vector<std::vector<double>>; // [channel][pixel]

// What happens to the light on its way into the image's pixels.
struct ImageFaults
{
  std::vector<Place> moved;                               // one a channel, may be empty
  std::vector<double> blur;                               // pixels, one a channel
  double tail = 0.0;                                      // part of the light in a broad tail
  double tailRadius = 12.0;                               // pixels
  std::function<double(int k, double x, double y)> field; // factor; -1..1
  double glare = 0.0;                                     // of the mean
  double ghost = 0.0;                                     // of the light at the opposite place
  double before = 0.0; // of the channel before stays in the detector
  double mixed = 0.0;  // with both neighbours, taken from the channel itself
  std::function<double(int k, int x, int y)> stripes; // factor
  std::vector<double> gain, offset;
  std::function<double(int k, double x, double y)> window; // added; -1..1
  std::function<double(int k, double u)> curve;
  std::vector<double> well;
  double bend = 0.0; // power with which a well fills up before its end; 0: at once
  std::function<void(Planes&, const ImageScene&)> other;
};

struct ImageFault
{
  std::string kind;
  std::function<void(ImageFaults&, double size)> apply;
};

const std::vector<std::string>& imageFaultNames(); // as in the project's effect library
const std::vector<std::string>& imageStrangerNames();

ImageFaults noFaults(int channels);
ImageFault drawImageFault(const std::string& name, Random& random, const ImageScene& scene);
ImageFault drawImageStranger(const std::string& name, Random& random, const ImageScene& scene);

// Noise-free.
Planes expose(const ImageScene& scene, const ImageFaults& faults);

} // namespace withheld
