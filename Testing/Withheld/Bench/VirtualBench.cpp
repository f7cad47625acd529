#include "VirtualBench.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace withheld
{

namespace
{
double light(const Lamp& lamp, double nm)
{
  const double c2 = 1.4388e7; // nm K
  const double thermal = std::pow(560.0 / nm, 5.0) * std::expm1(c2 / (560.0 * lamp.temperature)) /
    std::expm1(c2 / (nm * lamp.temperature));
  const double led = lamp.blueLed * std::exp(-std::pow((nm - 455.0) / 14.0, 2));
  const double broad = 1.0 + (lamp.phosphor - 1.0) * std::exp(-std::pow((nm - 590.0) / 75.0, 2));
  return (thermal * broad + led) * std::exp(-lamp.age * std::pow(560.0 / nm, 3.0));
}

double transmitted(const Filter& filter, double nm)
{
  const double side = nm > filter.center ? 1.0 + filter.skew : 1.0 - filter.skew;
  const double distance = std::fabs(nm - filter.center) / (0.5 * filter.width * side);
  return filter.floor +
    (filter.height - filter.floor) *
    std::exp(-std::log(2.0) * std::pow(distance, filter.steepness));
}

double efficiency(const Detector& detector, double nm)
{
  const double blue = 1.0 - detector.blueLoss * std::exp(-(nm - 380.0) / 80.0);
  const double red = 1.0 / (1.0 + std::exp((nm - detector.redCut) / 60.0));
  return blue * red;
}
}

Curve responsivityOf(const Bench& bench, std::size_t channel)
{
  Curve curve(Nanometres);
  for (int j = 0; j < Nanometres; ++j)
  {
    const double nm = FirstNanometre + j - bench.wholeShift;
    const bool blocked = nm < bench.lamp.first || nm > bench.lamp.last;
    curve[static_cast<std::size_t>(j)] = blocked ? 0.0
                                                 : light(bench.lamp, nm) *
        transmitted(bench.filters[channel], nm) * efficiency(bench.detector, nm);
  }
  return curve;
}

std::vector<double> whiteOf(const Bench& bench)
{
  std::vector<double> white;
  for (std::size_t k = 0; k < bench.filters.size(); ++k)
  {
    double sum = 0.0;
    for (const double value : responsivityOf(bench, k))
    {
      sum += value;
    }
    white.push_back(sum);
  }
  return white;
}

Responses expose(
  const Bench& bench, const std::vector<Patch>& patches, const std::vector<double>& white)
{
  const std::size_t channels = bench.filters.size();
  std::vector<Curve> responsivity;
  for (std::size_t k = 0; k < channels; ++k)
  {
    responsivity.push_back(responsivityOf(bench, k));
  }
  int last = 1;
  for (const Patch& patch : patches)
  {
    last = std::max(last, patch.order);
  }
  std::vector<std::vector<double>> u(patches.size(), std::vector<double>(channels));
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    Curve surface = patches[i].reflectance;
    const auto medium = static_cast<std::size_t>(patches[i].medium);
    if (medium < bench.surface.size() && bench.surface[medium])
    {
      bench.surface[medium](surface);
    }
    const double place = bench.field ? bench.field(patches[i].column, patches[i].row) : 1.0;
    for (std::size_t k = 0; k < channels; ++k)
    {
      double sum = 0.0;
      for (std::size_t j = 0; j < surface.size(); ++j)
      {
        sum += responsivity[k][j] * surface[j];
      }
      u[i][k] = sum / white[k] * place;
    }
  }
  if (bench.glare != 0.0)
  {
    std::map<int, std::vector<double>> mean;
    std::map<int, double> count;
    for (std::size_t i = 0; i < patches.size(); ++i)
    {
      std::vector<double>& sum = mean[patches[i].scene];
      sum.resize(channels, 0.0);
      count[patches[i].scene] += 1.0;
      for (std::size_t k = 0; k < channels; ++k)
      {
        sum[k] += u[i][k];
      }
    }
    for (std::size_t i = 0; i < patches.size(); ++i)
    {
      for (std::size_t k = 0; k < channels; ++k)
      {
        const double around = mean[patches[i].scene][k] / count[patches[i].scene];
        u[i][k] += bench.glare * (bench.glareConserves ? around - u[i][k] : around);
      }
    }
  }
  if (bench.scatter != 0.0)
  {
    // Exponential tail in patch pitches; the pitch is the smallest distance within a scene.
    const auto sharp = u;
    double pitch = 1e9;
    for (const Patch& patch : patches)
    {
      if (&patch != &patches[0] && patch.scene == patches[0].scene)
      {
        pitch =
          std::min(pitch, std::hypot(patch.column - patches[0].column, patch.row - patches[0].row));
      }
    }
    for (std::size_t i = 0; i < patches.size(); ++i)
    {
      std::vector<double> sum(channels, 0.0);
      double total = 0.0;
      for (std::size_t j = 0; j < patches.size(); ++j)
      {
        const double distance =
          std::hypot(patches[i].column - patches[j].column, patches[i].row - patches[j].row) /
          pitch;
        if (j != i && patches[i].scene == patches[j].scene && distance < 2.6)
        {
          const double weight = std::exp(-distance / bench.scatterReach);
          total += weight;
          for (std::size_t k = 0; k < channels; ++k)
          {
            sum[k] += weight * sharp[j][k];
          }
        }
      }
      for (std::size_t k = 0; k < channels && total > 0.0; ++k)
      {
        u[i][k] += bench.scatter * (sum[k] / total - sharp[i][k]);
      }
    }
  }
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    std::vector<double> v = u[i];
    if (!bench.mixing.empty())
    {
      for (std::size_t k = 0; k < channels; ++k)
      {
        v[k] = 0.0;
        for (std::size_t l = 0; l < channels; ++l)
        {
          v[k] += bench.mixing[k][l] * u[i][l];
        }
      }
    }
    const double time = static_cast<double>(patches[i].order) / last;
    for (std::size_t k = 0; k < channels; ++k)
    {
      double value = v[k] * bench.gain[k];
      if (bench.drift)
      {
        value *= bench.drift(time, static_cast<int>(k));
      }
      if (bench.curve)
      {
        value = bench.curve(value);
      }
      u[i][k] = std::min(value + bench.dark[k] * bench.exposure[k], bench.fullWell);
    }
  }
  if (bench.other)
  {
    bench.other(u, patches);
  }
  return u;
}

} // namespace withheld
