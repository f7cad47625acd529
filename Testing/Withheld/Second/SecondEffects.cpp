#include "SecondEffects.h"

#include <algorithm>
#include <cmath>

namespace withheld::second
{

namespace
{
double sign(Random& random)
{
  return chance(random, 0.5) ? 1.0 : -1.0;
}

std::vector<double> numbers(Random& random, std::size_t count, double low, double high)
{
  std::vector<double> list(count);
  for (double& value : list)
  {
    value = sign(random) * uniform(random, low, high);
  }
  return list;
}

void eachBand(World& world, const std::function<void(Passband&)>& change)
{
  std::for_each(world.camera.passbands.begin(), world.camera.passbands.end(), change);
}

// A change of the spectrum that one medium sends to the camera.
Fault onMedium(const std::string& kind, int medium, std::function<void(Spectrum&, double)> change)
{
  const auto apply = [medium, change](World& world, double size)
  {
    const auto before = world.surface;
    world.surface = [before, medium, change, size](Spectrum& r, int m)
    {
      if (before)
      {
        before(r, m);
      }
      if (m == medium)
      {
        change(r, size);
      }
    };
  };
  return { kind, false, apply };
}

Fault surfaceFault(const std::string& name, Random& random, int medium)
{
  const double s = sign(random);
  const double shape = uniform(random, 0.0, 1.0);
  if (name == "medium_gain")
  {
    return onMedium("less light at this angle", medium,
      [s](Spectrum& r, double size) { r /= 1.0 + 0.06 * s * size; });
  }
  if (name == "specular_component")
  {
    return onMedium(
      "Fresnel part", medium, [s](Spectrum& r, double size) { r += 0.02 * s * size * (1.0 - r); });
  }
  if (name == "interreflection")
  {
    // Geometric series of a groove: a part g of what leaves meets the wall again.
    return onMedium("groove", medium,
      [](Spectrum& r, double size)
      {
        const double g = std::tanh(0.15 * size);
        r = Spectrum(r * (1.0 - g) / (1.0 - g * r));
      });
  }
  if (name == "translucency")
  {
    // Diffusion length from absorption; loss at the rim of the spot.
    return onMedium("rim of the spot", medium,
      [shape](Spectrum& r, double size)
      {
        const Spectrum absorbed = (1.0 - r) * (1.0 - r) / (2.0 * r + 0.02);
        const Spectrum length =
          std::pow(wavelengths() / 600.0, 1.0 + shape) / std::sqrt(0.15 + absorbed);
        r *= 1.0 / (1.0 + 0.04 * size * length);
      });
  }
  return onMedium("whitener", medium,
    [shape](Spectrum& r, double size)
    {
      double absorbed = 0.0;
      double count = 0.0;
      for (std::size_t j = 0; j < r.size() && wavelengths()[j] < 415.0; ++j, count += 1.0)
      {
        absorbed += r[j];
      }
      const Spectrum z = (wavelengths() - 432.0 - 12.0 * shape) / 16.0;
      r += 0.1 * size * absorbed / count * std::exp(-0.5 * z * z) *
        (1.0 / (1.0 + std::exp((400.0 - wavelengths()) / 4.0)));
    });
}

Fault opticsFault(const std::string& name, Random& random)
{
  const double s = sign(random);
  const bool again = chance(random, 0.6);
  if (name == "illuminant_drift")
  {
    const int kind = integer(random, 0, 2);
    const char* kinds[] = { "warmer", "second lamp", "coating" };
    return { kinds[kind], false,
      [s, kind](World& w, double size)
      {
        w.camera.lamp.warmth += kind == 0 ? 0.05 * s * size : 0.0;
        w.camera.lamp.other += kind == 1 ? std::min(0.08 * size, 0.9) : 0.0;
        w.camera.lamp.bump += kind == 2 ? 0.08 * s * size : 0.0;
      } };
  }
  if (name == "filter_shift")
  {
    const double slope = chance(random, 0.5) ? 0.0 : uniform(random, 0.0, 1.0);
    return { slope > 0.0 ? "growing" : "constant", again,
      [s, slope](World& w, double size)
      {
        eachBand(w,
          [&](Passband& band)
          { band.center += 1.5 * s * size * (1.0 + slope * (band.center - 550.0) / 150.0); });
      } };
  }
  if (name == "filter_bandwidth")
  {
    if (chance(random, 0.5))
    {
      return { "beam of a wide cone", true,
        [](World& w, double size) { w.camera.smear += 5.0 * std::sqrt(size); } };
    }
    return { "narrower or wider", true,
      [s](World& w, double size)
      {
        eachBand(
          w, [&](Passband& band) { band.width *= std::exp(0.7 * s * std::tanh(0.3 * size)); });
      } };
  }
  return { "blocking", again, [](World& w, double size) {
            eachBand(w, [&](Passband& band) { band.leak += 0.004 * size; });
          } };
}

Fault placeFault(const std::string& name, Random& random)
{
  const double s = sign(random);
  if (name == "veiling_glare")
  {
    return { "haze", false, [](World& w, double size) { w.glare += 0.02 * size; } };
  }
  if (name == "local_stray_light")
  {
    const double power = uniform(random, 1.5, 3.0);
    return { "power of the distance", false,
      [power](World& w, double size)
      {
        w.halo += 0.04 * size;
        w.haloPower = power;
      } };
  }
  if (name == "vignetting")
  {
    const double x = uniform(random, -0.2, 0.2);
    const double y = uniform(random, -0.2, 0.2);
    return { "pupil and cosine", false,
      [x, y](World& w, double size)
      {
        const auto before = w.field;
        w.field = [before, x, y, size](double column, double row)
        {
          const double r2 = (column - x) * (column - x) + (row - y) * (row - y);
          const double cosine2 = 1.0 / (1.0 + 0.04 * size * r2);
          return (before ? before(column, row) : 1.0) * cosine2 * cosine2 *
            (1.0 - 0.01 * size * std::pow(r2, 1.5));
        };
      } };
  }
  if (name == "illumination_gradient")
  {
    const double angle = uniform(random, 0.0, 6.2832);
    const double bent = uniform(random, 0.0, 1.0);
    return { "lamp on one side", false,
      [angle, bent](World& w, double size)
      {
        const auto before = w.field;
        w.field = [before, angle, bent, size](double column, double row)
        {
          const double along = column * std::cos(angle) + row * std::sin(angle);
          return (before ? before(column, row) : 1.0) *
            std::exp(0.05 * size * (along + 0.1 * bent * along * along));
        };
      } };
  }
  const int kind = integer(random, 0, 3);
  const double place = uniform(random, 0.2, 0.8);
  const char* kinds[] = { "straight", "saturating", "step", "from a moment on" };
  return { kinds[kind], false,
    [s, kind, place](World& w, double size)
    {
      const double a = 0.05 * s * size;
      w.drift = [a, kind, place](double t)
      {
        switch (kind)
        {
          case 0:
            return std::exp(a * t);
          case 1:
            return 1.0 + a * t / (t + 0.3 * place);
          case 2:
            return t > place ? 1.0 + a : 1.0;
          default:
            return 1.0 + a * std::max(t - place, 0.0) / (1.0 - place);
        }
      };
    } };
}

Fault detectorFault(const std::string& name, Random& random, const World& world)
{
  const double s = sign(random);
  const std::size_t channels = world.gain.size();
  if (name == "dark_offset")
  {
    // Dark current grows with the exposure time, the dark frame is of another one.
    std::vector<double> time(channels, 1.0);
    if (chance(random, 0.5))
    {
      for (double& one : time)
      {
        one = around(random, 1.0, 2.0);
      }
    }
    return { "dark current", false,
      [s, time](World& w, double size)
      {
        for (std::size_t k = 0; k < time.size(); ++k)
        {
          w.dark[k] += 0.01 * s * size * time[k];
        }
      } };
  }
  if (name == "exposure_gain" || name == "channel_gain")
  {
    std::vector<double> change(channels, s);
    if (name == "channel_gain")
    {
      change = numbers(random, channels, 0.3, 1.2);
    }
    return { "gain", false,
      [change](World& w, double size)
      {
        for (std::size_t k = 0; k < change.size(); ++k)
        {
          w.gain[k] *= 1.0 + 0.05 * size * change[k];
        }
      } };
  }
  if (name == "detector_nonlinearity")
  {
    const int kind = integer(random, 0, 2);
    const char* kinds[] = { "hyperbola", "cubic", "S" };
    return { kinds[kind], false,
      [s, kind](World& w, double size)
      {
        const double a = 0.08 * s * size;
        w.curve = [a, kind](double u)
        {
          return kind == 0 ? u * (1.0 + a) / (1.0 + a * u)
            : kind == 1    ? u + a * (u - u * u * u)
                           : u + 0.6 * a * u * (1.0 - u) * (0.4 + u);
        };
      } };
  }
  if (name == "saturation")
  {
    const double knee = chance(random, 0.5) ? 0.0 : uniform(random, 0.005, 0.02);
    return { knee > 0.0 ? "rounded" : "clipped", false,
      [knee](World& w, double size)
      {
        w.ceiling = 0.97 * std::exp(-0.1 * size);
        w.knee = knee;
      } };
  }
  const double ratio = chance(random, 0.5) ? 1.0 : uniform(random, 0.0, 0.6);
  return { ratio < 1.0 ? "mostly onwards" : "both ways", false,
    [ratio](World& w, double size)
    {
      w.right += 0.03 * size;
      w.left += 0.03 * size * ratio;
    } };
}
}

const std::vector<std::string>& faultNames()
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
  static const std::vector<std::string> names{ "light that pulses", "memory of the sample before",
    "shadow", "filters that shift off the axis", "steps of the converter", "sheen of each swatch" };
  return names;
}

Fault drawFault(const std::string& name, Random& random, const World& world, const Scene& scene)
{
  const auto among = [&name](std::initializer_list<const char*> names)
  { return std::find(names.begin(), names.end(), name) != names.end(); };
  if (name == "excess_noise")
  {
    return { "noise", false, [](World& w, double size) { w.noise *= 1.0 + size; } };
  }
  if (among(
        { "medium_gain", "specular_component", "interreflection", "translucency", "fluorescence" }))
  {
    return surfaceFault(name, random, integer(random, 0, scene.media - 1));
  }
  if (among({ "illuminant_drift", "filter_shift", "filter_bandwidth", "filter_leak" }))
  {
    return opticsFault(name, random);
  }
  if (among({ "veiling_glare", "local_stray_light", "vignetting", "illumination_gradient",
        "session_drift" }))
  {
    return placeFault(name, random);
  }
  return detectorFault(name, random, world);
}

Fault drawStranger(const std::string& name, Random& random, const Scene& scene)
{
  using Change = std::function<double(const Responses& u, std::size_t i, std::size_t k)>;
  Change change;
  const std::vector<Swatch> swatches = scene.swatches;
  if (name == "light that pulses")
  {
    const double cycles = uniform(random, 5.0, 12.0);
    change = [=](const Responses& u, std::size_t i, std::size_t k)
    {
      const double phase = cycles * swatches[i].order / static_cast<double>(swatches.size());
      return 0.05 * u[i][k] * (phase - std::floor(phase) < 0.5 ? 1.0 : -1.0);
    };
  }
  else if (name == "memory of the sample before")
  {
    std::vector<std::size_t> at(swatches.size());
    for (std::size_t i = 0; i < swatches.size(); ++i)
    {
      at[static_cast<std::size_t>(swatches[i].order) - 1] = i;
    }
    change = [=](const Responses& u, std::size_t i, std::size_t k)
    {
      const auto place = static_cast<std::size_t>(swatches[i].order) - 1;
      return place > 0 ? 0.05 * (u[at[place - 1]][k] - u[i][k]) : 0.0;
    };
  }
  else if (name == "shadow")
  {
    const double x = uniform(random, -0.7, 0.7);
    const double y = uniform(random, -0.5, 0.5);
    change = [=](const Responses& u, std::size_t i, std::size_t k)
    {
      const double r = std::hypot(scene.fieldX(swatches[i]) - x, scene.fieldY(swatches[i]) - y);
      return -0.15 * u[i][k] / (1.0 + std::exp((r - 0.3) / 0.03));
    };
  }
  else if (name == "filters that shift off the axis")
  {
    // Each channel sees less of what its neighbour towards the red has, with the square of the field.
    change = [=](const Responses& u, std::size_t i, std::size_t k)
    {
      const double r2 =
        std::pow(scene.fieldX(swatches[i]), 2) + std::pow(scene.fieldY(swatches[i]), 2);
      const std::size_t next = std::min(k + 1, u[i].size() - 1);
      const std::size_t last = k > 0 ? k - 1 : 0;
      return 0.1 * r2 * (u[i][last] - u[i][next]);
    };
  }
  else if (name == "steps of the converter")
  {
    change = [](const Responses& u, std::size_t i, std::size_t k)
    {
      const double place = 18.0 * std::max(u[i][k], 0.0);
      return 0.05 * (place - std::floor(place) - 0.5);
    };
  }
  else
  {
    const std::vector<double> sheen = numbers(random, swatches.size(), 0.0, 0.02);
    change = [=](const Responses&, std::size_t i, std::size_t) { return sheen[i]; };
  }
  return { name, false,
    [change](World& w, double size)
    {
      w.other = [change, size](Responses& u, const Scene&)
      {
        const Responses before = u;
        for (std::size_t i = 0; i < u.size(); ++i)
        {
          for (std::size_t k = 0; k < u[i].size(); ++k)
          {
            u[i][k] += size * change(before, i, k);
          }
        }
      };
    } };
}

} // namespace withheld::second
