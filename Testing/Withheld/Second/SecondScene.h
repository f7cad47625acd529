// What the camera of the second generator looks at, and what it answers.
#pragma once

#include "SecondCamera.h"

#include <functional>

namespace withheld::second
{

struct Swatch
{
  Spectrum reflectance;
  int medium = 0, scene = 0;
  double x = 0.0, y = 0.0; // mm
  double order = 0.0;
};

struct Scene
{
  std::vector<Swatch> swatches;
  int media = 1;
  double pitch = 10.0; // mm

  // Relative to the middle of all, 1 at half of the longer side.
  double fieldX(const Swatch& swatch) const { return (swatch.x - middleX) / half; }
  double fieldY(const Swatch& swatch) const { return (swatch.y - middleY) / half; }
  double time(const Swatch& swatch) const
  {
    return swatch.order / static_cast<double>(swatches.size());
  }
  double middleX = 0.0, middleY = 0.0, half = 1.0;
};

// Papers printed in halftones, paints and dyed cloth as random curves; set out with gaps and jitter.
Scene drawScene(Random& random, int count, int fewestMedia);

using Responses = std::vector<std::vector<double>>;

// The camera and everything that may be wrong with it.
struct World
{
  Camera camera;
  std::vector<double> gain, dark; // one a channel
  std::function<void(Spectrum&, int medium)> surface;
  std::function<double(double x, double y)> field;
  double glare = 0.0; // of the scene's mean
  double halo = 0.0;  // from swatch to swatch
  double haloPower = 2.0;
  double left = 0.0, right = 0.0; // what leaks into the channel before and after
  std::function<double(double)> curve;
  double ceiling = 1e9, knee = 0.0;
  std::function<double(double time)> drift;
  std::function<void(Responses&, const Scene&)> other;
  double noise = 1.0;
};

World makeWorld(const Camera& camera);

std::vector<double> whiteOf(const World& world);

// [swatch][channel], noise-free, relative to `white`.
Responses respond(const World& world, const Scene& scene, const std::vector<double>& white);

} // namespace withheld::second
