#include "PlantedEffects.h"

#include <algorithm>
#include <cmath>
#include <memory>

namespace withheld
{

namespace
{
double sign(Random& random)
{
  return chance(random, 0.5) ? 1.0 : -1.0;
}

double at(int j)
{
  return FirstNanometre + j;
}

void onMedium(Bench& bench, int medium, const SurfaceEffect& effect)
{
  bench.surface.resize(std::max(bench.surface.size(), static_cast<std::size_t>(medium) + 1));
  SurfaceEffect before = bench.surface[static_cast<std::size_t>(medium)];
  bench.surface[static_cast<std::size_t>(medium)] = [before, effect](Curve& r)
  {
    if (before)
    {
      before(r);
    }
    effect(r);
  };
}

void withField(Bench& bench, const std::function<double(double, double)>& factor)
{
  const auto before = bench.field;
  bench.field = [before, factor](double x, double y)
  { return (before ? before(x, y) : 1.0) * factor(x, y); };
}

void withDrift(Bench& bench, const std::function<double(double, int)>& factor)
{
  const auto before = bench.drift;
  bench.drift = [before, factor](double t, int k)
  { return (before ? before(t, k) : 1.0) * factor(t, k); };
}

std::vector<double> drawn(Random& random, std::size_t count, double spread)
{
  std::vector<double> values(count);
  for (double& value : values)
  {
    value = normal(random, spread);
  }
  return values;
}

PlantedEffect plantDetector(const std::string& name, Random& random, const Bench& bench)
{
  const std::size_t channels = bench.filters.size();
  PlantedEffect effect;
  effect.name = name;
  if (name == "dark_offset")
  {
    const double s = chance(random, 0.7) ? 1.0 : -1.0;
    const bool varied = chance(random, 0.5);
    const std::vector<double> spread = drawn(random, channels, varied ? 0.5 : 0.0);
    effect.kind = varied ? "dark of each channel" : "bias";
    effect.axes = { "channel", "level" };
    effect.apply = [s, spread](Bench& b, double size)
    {
      for (std::size_t k = 0; k < spread.size(); ++k)
      {
        b.dark[k] += 0.01 * s * size * std::exp(spread[k]);
      }
    };
  }
  else if (name == "exposure_gain")
  {
    const double s = sign(random);
    effect.kind = "stops";
    effect.axes = { "level" };
    effect.apply = [s](Bench& b, double size)
    {
      for (double& gain : b.gain)
      {
        gain *= std::exp2(0.06 * s * size);
      }
    };
  }
  else if (name == "channel_gain")
  {
    const std::vector<double> spread = drawn(random, channels, 0.04);
    effect.kind = "independent";
    effect.axes = { "channel" };
    effect.apply = [spread](Bench& b, double size)
    {
      for (std::size_t k = 0; k < spread.size(); ++k)
      {
        b.gain[k] *= std::exp(size * spread[k]);
      }
    };
  }
  else if (name == "detector_nonlinearity")
  {
    const double s = sign(random);
    const int kind = integer(random, 0, 3);
    effect.kind = kind == 0 ? "power"
      : kind == 1           ? "parabola"
      : kind == 2           ? "filling well"
                            : "sine";
    effect.axes = { "level" };
    effect.apply = [s, kind](Bench& b, double size)
    {
      const double a = 0.1 * s * size;
      b.curve = [a, kind](double u)
      {
        switch (kind)
        {
          case 0:
            return u > 0.0 ? std::pow(u, std::exp(a)) : u;
          case 1:
            return u + a * u * (1.0 - u);
          case 2:
            return std::fabs(a) < 1e-9 ? u : (1.0 - std::exp(-a * u)) / a;
          default:
            return u + a / 3.0 * std::sin(3.14159265 * std::min(u, 1.0));
        }
      };
    };
  }
  else if (name == "saturation")
  {
    const double level = uniform(random, 0.75, 0.95);
    effect.kind = "full well";
    effect.axes = { "level" };
    effect.apply = [level](Bench& b, double size)
    { b.fullWell = std::min(b.fullWell, std::exp(std::log(level) * size)); };
  }
  else // channel_crosstalk
  {
    const double back = 0.02;
    const double forth = chance(random, 0.6) ? 0.02 : uniform(random, 0.0, 0.01);
    const bool keepsEnds = chance(random, 0.5);
    effect.kind = forth == back ? "both sides" : "lag";
    effect.axes = { "spectral_shape" };
    effect.apply = [back, forth, channels, keepsEnds](Bench& b, double size)
    {
      b.mixing.assign(channels, std::vector<double>(channels, 0.0));
      for (std::size_t k = 0; k < channels; ++k)
      {
        const bool low = k > 0;
        const bool high = k + 1 < channels;
        b.mixing[k][k] =
          1.0 - size * ((low || !keepsEnds ? back : 0.0) + (high || !keepsEnds ? forth : 0.0));
        if (low)
        {
          b.mixing[k][k - 1] = size * back;
        }
        if (high)
        {
          b.mixing[k][k + 1] = size * forth;
        }
        if (!keepsEnds && (!low || !high))
        {
          b.mixing[k][k] += size * (low ? forth : back); // mirrored at the end
        }
      }
    };
  }
  return effect;
}

PlantedEffect plantOptics(const std::string& name, Random& random, const Bench& bench)
{
  PlantedEffect effect;
  effect.name = name;
  const double s = sign(random);
  if (name == "illuminant_drift")
  {
    // Beside a narrow diode the thermal part does not change smoothly.
    const int kind = bench.lamp.blueLed > 0.0 ? integer(random, 1, 2) : integer(random, 0, 2);
    effect.kind = kind == 0 ? "temperature" : kind == 1 ? "ageing" : "phosphor";
    effect.axes = { "channel" };
    effect.apply = [s, kind](Bench& b, double size)
    {
      if (kind == 0)
      {
        b.lamp.temperature *= std::exp(0.04 * s * size);
      }
      else if (kind == 1)
      {
        b.lamp.age += 0.05 * s * size;
      }
      else
      {
        b.lamp.phosphor *= std::exp(0.1 * s * size);
      }
    };
  }
  else if (name == "filter_shift")
  {
    const int kind = integer(random, 0, 2);
    effect.kind = kind == 0 ? "whole curve" : kind == 1 ? "oblique incidence" : "warm filters";
    effect.axes = { "spectral_shape", "channel" };
    effect.rebalance = kind != 0;
    effect.apply = [s, kind](Bench& b, double size)
    {
      if (kind == 0)
      {
        b.wholeShift += 2.0 * s * size;
        return;
      }
      for (Filter& filter : b.filters)
      {
        filter.center += kind == 1 ? -filter.center * 0.004 * size : 2.0 * s * size;
      }
    };
  }
  else if (name == "filter_bandwidth")
  {
    effect.kind = "width";
    effect.axes = { "spectral_shape" };
    effect.rebalance = true;
    effect.apply = [s](Bench& b, double size)
    {
      for (Filter& filter : b.filters)
      {
        filter.width *= std::exp(0.9 * s * std::tanh(0.25 * size));
      }
    };
  }
  else if (name == "filter_leak")
  {
    effect.kind = "blocking";
    effect.axes = { "spectral_shape", "level", "channel" };
    effect.rebalance = chance(random, 0.5);
    effect.apply = [](Bench& b, double size)
    {
      for (Filter& filter : b.filters)
      {
        filter.floor += 0.002 * size * filter.height;
      }
    };
  }
  else if (name == "veiling_glare")
  {
    const bool conserves = chance(random, 0.4);
    effect.kind = conserves ? "conserving" : "added";
    effect.axes = { "channel", "scene", "level" };
    effect.apply = [conserves](Bench& b, double size)
    {
      b.glare = 0.03 * size;
      b.glareConserves = conserves;
    };
  }
  else // local_stray_light
  {
    const double reach = uniform(random, 0.4, 1.2);
    effect.kind = "exponential tail";
    effect.axes = { "position" };
    effect.apply = [reach](Bench& b, double size)
    {
      b.scatter = 0.04 * size;
      b.scatterReach = reach;
    };
  }
  return effect;
}

PlantedEffect plantGeometry(const std::string& name, Random& random)
{
  PlantedEffect effect;
  effect.name = name;
  if (name == "vignetting")
  {
    const double x = normal(random, 0.15);
    const double y = normal(random, 0.15);
    const int kind = integer(random, 0, 1);
    effect.kind = kind == 0 ? "cosine" : "fourth order";
    effect.axes = { "position" };
    effect.apply = [x, y, kind](Bench& b, double size)
    {
      withField(b,
        [x, y, kind, size](double column, double row)
        {
          const double r2 = std::pow(column - x, 2) + std::pow(row - y, 2);
          if (kind == 0)
          {
            return std::pow(std::cos(std::atan(std::sqrt(0.03 * size * r2))), 4.0);
          }
          return 1.0 - 0.04 * size * r2 - 0.015 * size * r2 * r2;
        });
    };
  }
  else if (name == "illumination_gradient")
  {
    const double angle = uniform(random, 0.0, 6.2831853);
    effect.kind = "lamp to one side";
    effect.axes = { "position" };
    effect.apply = [angle](Bench& b, double size)
    {
      // Inverse square of the distance to a lamp that moves sideways from overhead.
      withField(b,
        [angle, size](double column, double row)
        {
          const double along = column * std::cos(angle) + row * std::sin(angle);
          const double offset = 0.12 * size;
          const double height = 3.0;
          const double flat = 1.0 / (height * height + along * along);
          const double there = std::pow(along - offset, 2);
          return 1.0 / (height * height + there) / flat * (1.0 + 0.02 * size * along);
        });
    };
  }
  else // session_drift
  {
    const double s = sign(random);
    const int kind = integer(random, 0, 3);
    const double place = uniform(random, 0.15, 0.85);
    const double constant = uniform(random, 0.1, 0.5);
    effect.kind = kind == 0 ? "slope" : kind == 1 ? "warm-up" : kind == 2 ? "step" : "cooling";
    effect.axes = { "order" };
    effect.apply = [s, kind, place, constant](Bench& b, double size)
    {
      const double a = 0.06 * s * size;
      withDrift(b,
        [a, kind, place, constant](double t, int)
        {
          switch (kind)
          {
            case 0:
              return 1.0 + a * t;
            case 1:
              return 1.0 + a * (1.0 - std::exp(-t / constant));
            case 2:
              return t > place ? 1.0 + a : 1.0;
            default:
              return 1.0 + a * std::exp(-t / constant);
          }
        });
    };
  }
  return effect;
}

// One medium that a good part of the patches have.
int someMedium(Random& random, int media, const std::vector<Patch>& patches)
{
  std::vector<int> common;
  for (int m = 0; m < media; ++m)
  {
    const auto count = std::count_if(
      patches.begin(), patches.end(), [m](const Patch& patch) { return patch.medium == m; });
    if (count * 8 >= static_cast<std::ptrdiff_t>(patches.size()))
    {
      common.push_back(m);
    }
  }
  return common[static_cast<std::size_t>(integer(random, 0, static_cast<int>(common.size()) - 1))];
}

PlantedEffect plantSurface(
  const std::string& name, Random& random, int media, const std::vector<Patch>& patches)
{
  PlantedEffect effect;
  effect.name = name;
  effect.medium = someMedium(random, media, patches);
  effect.axes = { "medium" };
  const double s = sign(random);
  const int medium = effect.medium;
  if (media == 1)
  {
    effect.axes = { "level", "channel", "spectral_shape" };
  }
  SurfaceEffect (*make)(double, double, double) = nullptr;
  double first = s;
  double second = uniform(random, 0.0, 1.0);
  if (name == "medium_gain")
  {
    effect.kind = "geometry";
    make = [](double size, double direction, double) -> SurfaceEffect
    {
      return [=](Curve& r)
      {
        for (double& value : r)
        {
          value *= std::exp(0.08 * direction * size);
        }
      };
    };
  }
  else if (name == "specular_component")
  {
    effect.kind = "gloss";
    first = chance(random, 0.5) ? 1.0 : -1.0;
    make = [](double size, double direction, double) -> SurfaceEffect
    {
      return [=](Curve& r)
      {
        const double gloss = 0.02 * direction * size;
        for (double& value : r)
        {
          value = gloss + (1.0 - std::max(gloss, 0.0)) * value;
        }
      };
    };
  }
  else if (name == "interreflection")
  {
    effect.kind = "bounces";
    make = [](double size, double, double) -> SurfaceEffect
    {
      return [=](Curve& r)
      {
        // Bounce by bounce.
        const double again = 1.0 - std::exp(-0.15 * size);
        for (double& value : r)
        {
          double leaves = 0.0;
          double inside = 1.0;
          for (int bounce = 0; bounce < 60; ++bounce)
          {
            inside *= value;
            leaves += inside * (1.0 - again);
            inside *= again;
          }
          value = leaves;
        }
      };
    };
  }
  else if (name == "translucency")
  {
    effect.kind = "lateral loss";
    make = [](double size, double, double depth) -> SurfaceEffect
    {
      return [=](Curve& r)
      {
        for (int j = 0; j < Nanometres; ++j)
        {
          double& value = r[static_cast<std::size_t>(j)];
          const double clipped = std::min(std::max(value, 0.01), 0.99);
          // Kubelka-Munk absorption over scattering; little absorption lets light travel.
          const double absorption = (1.0 - clipped) * (1.0 - clipped) / (2.0 * clipped);
          const double travels = 1.0 / (1.0 + absorption * (2.0 + 3.0 * depth));
          value *= 1.0 - 0.12 * size * travels * std::pow(at(j) / 600.0, 2.0 + 2.0 * depth);
        }
      };
    };
  }
  else // fluorescence
  {
    effect.kind = "brightener";
    make = [](double size, double, double shape) -> SurfaceEffect
    {
      return [=](Curve& r)
      {
        double excited = 0.0;
        for (int j = 0; j < 40; ++j)
        {
          excited += r[static_cast<std::size_t>(j)] / 40.0;
        }
        const double peak = 433.0 + 12.0 * shape;
        for (int j = 0; j < Nanometres; ++j)
        {
          const double x = std::log((at(j) - 380.0 + 1.0) / (peak - 380.0 + 1.0)) / 0.35;
          r[static_cast<std::size_t>(j)] += 0.08 * size * excited * std::exp(-0.5 * x * x);
        }
      };
    };
  }
  effect.apply = [make, medium, first, second](Bench& b, double size)
  { onMedium(b, medium, make(size, first, second)); };
  return effect;
}
}

const std::vector<std::string>& plantableNames()
{
  static const std::vector<std::string> names{ "dark_offset", "exposure_gain", "channel_gain",
    "illuminant_drift", "detector_nonlinearity", "saturation", "channel_crosstalk", "filter_shift",
    "filter_bandwidth", "filter_leak", "veiling_glare", "local_stray_light", "vignetting",
    "illumination_gradient", "medium_gain", "specular_component", "interreflection", "translucency",
    "fluorescence", "session_drift", "excess_noise" };
  return names;
}

const std::vector<std::string>& strangerNames()
{
  static const std::vector<std::string> names{ "flicker", "tilted swatches", "two detector halves",
    "teeth in the curve", "polarisation", "ghost image", "unmixed stray pattern" };
  return names;
}

PlantedEffect plant(const std::string& name, Random& random, const Bench& bench, int media,
  const std::vector<Patch>& patches)
{
  const auto among = [&name](std::initializer_list<const char*> names)
  { return std::find(names.begin(), names.end(), name) != names.end(); };
  if (name == "excess_noise")
  {
    PlantedEffect effect;
    effect.name = name;
    effect.kind = "noise factor";
    effect.apply = [](Bench& b, double size) { b.noiseFactor *= 1.0 + size; };
    return effect;
  }
  if (among(
        { "medium_gain", "specular_component", "interreflection", "translucency", "fluorescence" }))
  {
    return plantSurface(name, random, media, patches);
  }
  if (among({ "vignetting", "illumination_gradient", "session_drift" }))
  {
    return plantGeometry(name, random);
  }
  if (among({ "illuminant_drift", "filter_shift", "filter_bandwidth", "filter_leak",
        "veiling_glare", "local_stray_light" }))
  {
    return plantOptics(name, random, bench);
  }
  return plantDetector(name, random, bench);
}

PlantedEffect plantStranger(
  const std::string& kind, Random& random, const Bench& bench, const std::vector<Patch>& patches)
{
  PlantedEffect effect;
  effect.kind = kind;
  const std::size_t channels = bench.filters.size();
  const auto seed = random();
  using Change = std::function<double(double u, std::size_t i, std::size_t k)>;
  Change change;
  if (kind == "flicker")
  {
    effect.axes = { "order", "sample" };
    const double cycles = uniform(random, 4.0, 9.0);
    const auto count = static_cast<double>(patches.size());
    const auto order = std::make_shared<std::vector<double>>();
    for (const Patch& patch : patches)
    {
      order->push_back(patch.order / count);
    }
    change = [cycles, order](double u, std::size_t i, std::size_t)
    { return 0.04 * u * std::sin(6.2831853 * cycles * (*order)[i]); };
  }
  else if (kind == "tilted swatches")
  {
    effect.axes = { "sample" };
    Random own(seed);
    const auto gain = std::make_shared<std::vector<double>>(drawn(own, patches.size(), 0.04));
    change = [gain](double u, std::size_t i, std::size_t) { return u * (*gain)[i]; };
  }
  else if (kind == "two detector halves")
  {
    effect.axes = { "position" };
    const double edge = uniform(random, -0.4, 0.4);
    const auto right = std::make_shared<std::vector<bool>>();
    for (const Patch& patch : patches)
    {
      right->push_back(patch.column > edge && patch.row > -edge);
    }
    change = [right](double u, std::size_t i, std::size_t)
    { return (*right)[i] ? 0.3 * u * (u - 0.3) : 0.0; };
  }
  else if (kind == "teeth in the curve")
  {
    effect.axes = { "level" };
    const double teeth = uniform(random, 5.0, 9.0);
    change = [teeth](double u, std::size_t, std::size_t)
    { return 0.02 * std::sin(6.2831853 * teeth * u); };
  }
  else if (kind == "polarisation")
  {
    effect.axes = { "medium", "channel", "spectral_shape" };
    Random own(seed);
    const auto gain = std::make_shared<std::vector<std::vector<double>>>();
    for (int m = 0; m < 8; ++m)
    {
      gain->push_back(drawn(own, channels, 0.05));
    }
    const auto medium = std::make_shared<std::vector<std::size_t>>();
    for (const Patch& patch : patches)
    {
      medium->push_back(static_cast<std::size_t>(patch.medium % 8));
    }
    change = [gain, medium](double u, std::size_t i, std::size_t k)
    { return u * (*gain)[(*medium)[i]][k]; };
  }
  else if (kind == "ghost image")
  {
    effect.axes = { "position", "sample", "channel", "level" };
    effect.apply = [](Bench& b, double size)
    {
      b.other = [size](Responses& u, const std::vector<Patch>& where)
      {
        const Responses sharp = u;
        for (std::size_t i = 0; i < u.size(); ++i)
        {
          for (std::size_t j = 0; j < u.size(); ++j)
          {
            // The lens mirrors the field about its middle.
            if (where[i].scene == where[j].scene &&
              std::fabs(where[i].column + where[j].column) < 1e-6 &&
              std::fabs(where[i].row + where[j].row) < 1e-6)
            {
              for (std::size_t k = 0; k < u[i].size(); ++k)
              {
                u[i][k] += 0.04 * size * (sharp[j][k] - 0.3);
              }
            }
          }
        }
      };
    };
    return effect;
  }
  else
  {
    effect.axes = { "sample", "channel" };
    Random own(seed);
    const auto pattern = std::make_shared<Responses>();
    for (std::size_t i = 0; i < patches.size(); ++i)
    {
      pattern->push_back(drawn(own, channels, 0.01));
    }
    change = [pattern](double, std::size_t i, std::size_t k) { return (*pattern)[i][k]; };
  }
  effect.apply = [change](Bench& b, double size)
  {
    b.other = [change, size](Responses& u, const std::vector<Patch>&)
    {
      for (std::size_t i = 0; i < u.size(); ++i)
      {
        for (std::size_t k = 0; k < u[i].size(); ++k)
        {
          u[i][k] += size * change(u[i][k], i, k);
        }
      }
    };
  };
  return effect;
}

} // namespace withheld
