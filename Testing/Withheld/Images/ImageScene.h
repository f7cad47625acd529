// Scenes for image pairs, as functions of the place: no pixel of them depends on a grid.
#pragma once

#include "Cases/CaseWriter.h"

#include <functional>
#include <vector>

namespace withheld
{

// A chart of patches before a textured ground, with soft edges and a few bright spots.
class ImageScene
{
public:
  ImageScene(Random& random, int width, int height, int channels);

  int width() const { return Width; }
  int height() const { return Height; }
  int channels() const { return Channels; }

  // Response to a place in pixels; pixel centers are whole numbers.
  double light(int channel, double x, double y) const;
  // 1.. for a patch, 0 beside them.
  int label(int x, int y) const;

private:
  struct Wave
  {
    double x, y, phase;
    std::vector<double> size; // one a channel
  };
  // How far a place lies within a patch: 0..1, over soft edges; the patch's number.
  int patchAt(double x, double y, double& inside) const;

  int Width, Height, Channels;
  int Columns, Rows;
  double Softness;
  std::vector<std::vector<double>> Patches; // [patch][channel]
  std::vector<double> Ground;
  std::vector<Wave> Waves;
};

// A channel of an image in finer steps than its pixels.
struct Fine
{
  static constexpr int Parts = 3;
  int width = 0, height = 0; // in parts
  std::vector<double> value;

  double& at(int i, int j)
  {
    return value[static_cast<std::size_t>(j) * static_cast<std::size_t>(width) +
      static_cast<std::size_t>(i)];
  }
  double at(int i, int j) const { return const_cast<Fine*>(this)->at(i, j); }
  // Beyond the edges the edge.
  double held(int i, int j) const;
};

using Place = std::function<void(double& x, double& y)>; // where a ray to this place comes from

Fine render(const ImageScene& scene, int channel, const Place& moved);
// Exact Gaussian; deviation in pixels.
Fine blurred(const Fine& plane, double deviation);
// Mean of the parts of each pixel.
std::vector<double> pixels(const Fine& plane);

} // namespace withheld
