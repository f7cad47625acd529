#include "ImageScene.h"

#include <algorithm>
#include <cmath>

namespace withheld
{

ImageScene::ImageScene(Random& random, int width, int height, int channels)
  : Width(width)
  , Height(height)
  , Channels(channels)
  , Columns(integer(random, 5, 8))
  , Rows(integer(random, 4, 6))
  , Softness(uniform(random, 0.3, 0.9))
{
  const auto spectrum = [&](double low, double high)
  {
    std::vector<double> values;
    const double level = uniform(random, low, high);
    const double slope = normal(random, 0.6);
    const double bend = normal(random, 0.5);
    for (int k = 0; k < channels; ++k)
    {
      const double x = 2.0 * k / std::max(channels - 1, 1) - 1.0;
      const double z = std::log(level / (1.0 - level)) + slope * x + bend * (x * x - 0.4);
      values.push_back(0.02 + 0.9 / (1.0 + std::exp(-z)));
    }
    return values;
  };
  for (int p = 0; p < Columns * Rows; ++p)
  {
    Patches.push_back(spectrum(0.05, 0.92));
  }
  Ground = spectrum(0.15, 0.6);
  for (int w = 0; w < 6; ++w)
  {
    const double period = around(random, 14.0, 3.0);
    const double angle = uniform(random, 0.0, 6.2832);
    Wave wave{ 6.2832 / period * std::cos(angle), 6.2832 / period * std::sin(angle),
      uniform(random, 0.0, 6.2832), {} };
    for (int k = 0; k < channels; ++k)
    {
      wave.size.push_back(0.03 * uniform(random, 0.3, 1.0));
    }
    Waves.push_back(std::move(wave));
  }
}

int ImageScene::patchAt(double x, double y, double& inside) const
{
  const double pitchX = static_cast<double>(Width) / Columns;
  const double pitchY = static_cast<double>(Height) / Rows;
  const int column = std::clamp(static_cast<int>((x + 0.5) / pitchX), 0, Columns - 1);
  const int row = std::clamp(static_cast<int>((y + 0.5) / pitchY), 0, Rows - 1);
  const double fromX = 0.38 * pitchX - std::fabs(x + 0.5 - (column + 0.5) * pitchX);
  const double fromY = 0.36 * pitchY - std::fabs(y + 0.5 - (row + 0.5) * pitchY);
  const auto soft = [this](double distance) { return 0.5 + 0.5 * std::tanh(distance / Softness); };
  inside = soft(fromX) * soft(fromY);
  return row * Columns + column;
}

double ImageScene::light(int channel, double x, double y) const
{
  const auto k = static_cast<std::size_t>(channel);
  double inside = 0.0;
  const double patch = Patches[static_cast<std::size_t>(patchAt(x, y, inside))][k];
  double texture = 1.0;
  for (const Wave& wave : Waves)
  {
    texture += wave.size[k] * std::sin(wave.x * x + wave.y * y + wave.phase);
  }
  return texture * (Ground[k] + inside * (patch - Ground[k]));
}

int ImageScene::label(int x, int y) const
{
  double inside = 0.0;
  const int patch = patchAt(x, y, inside);
  return inside > 0.95 ? patch + 1 : 0;
}

double Fine::held(int i, int j) const
{
  return at(std::clamp(i, 0, width - 1), std::clamp(j, 0, height - 1));
}

Fine render(const ImageScene& scene, int channel, const Place& moved)
{
  Fine plane{ scene.width() * Fine::Parts, scene.height() * Fine::Parts, {} };
  plane.value.resize(
    static_cast<std::size_t>(plane.width) * static_cast<std::size_t>(plane.height));
  for (int j = 0; j < plane.height; ++j)
  {
    for (int i = 0; i < plane.width; ++i)
    {
      double x = (i + 0.5) / Fine::Parts - 0.5;
      double y = (j + 0.5) / Fine::Parts - 0.5;
      if (moved)
      {
        moved(x, y);
      }
      plane.at(i, j) = scene.light(channel, x, y);
    }
  }
  return plane;
}

Fine blurred(const Fine& plane, double deviation)
{
  const double parts = deviation * Fine::Parts;
  const int reach = static_cast<int>(std::ceil(4.0 * parts));
  std::vector<double> weights;
  double sum = 0.0;
  for (int d = -reach; d <= reach; ++d)
  {
    weights.push_back(std::exp(-0.5 * d * d / (parts * parts)));
    sum += weights.back();
  }
  const auto along = [&](const Fine& from, int dx, int dy)
  {
    Fine to = from;
    for (int j = 0; j < from.height; ++j)
    {
      for (int i = 0; i < from.width; ++i)
      {
        double value = 0.0;
        for (int d = -reach; d <= reach; ++d)
        {
          value += weights[static_cast<std::size_t>(d + reach)] * from.held(i + d * dx, j + d * dy);
        }
        to.at(i, j) = value / sum;
      }
    }
    return to;
  };
  return parts > 0.05 ? along(along(plane, 1, 0), 0, 1) : plane;
}

std::vector<double> pixels(const Fine& plane)
{
  const int width = plane.width / Fine::Parts;
  const int height = plane.height / Fine::Parts;
  std::vector<double> mean(static_cast<std::size_t>(width) * static_cast<std::size_t>(height), 0.0);
  for (int j = 0; j < plane.height; ++j)
  {
    for (int i = 0; i < plane.width; ++i)
    {
      mean[static_cast<std::size_t>(j / Fine::Parts) * static_cast<std::size_t>(width) +
        static_cast<std::size_t>(i / Fine::Parts)] += plane.at(i, j) / (Fine::Parts * Fine::Parts);
    }
  }
  return mean;
}

} // namespace withheld
