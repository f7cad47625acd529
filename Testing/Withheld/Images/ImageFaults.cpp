#include "ImageFaults.h"

#include <algorithm>
#include <cmath>
#include <map>
#include <numeric>

namespace withheld
{

namespace
{
double sign(Random& random)
{
  return chance(random, 0.5) ? 1.0 : -1.0;
}

using Maker = ImageFault (*)(Random&, int channels, int width, int height);

// sizes: of each channel.
ImageFault field(const std::string& kind, const std::vector<double>& sizes,
  const std::function<double(double x, double y, double size)>& factor)
{
  return { kind,
    [=](ImageFaults& f, double size)
    {
      const auto before = f.field;
      f.field = [=](int k, double x, double y)
      {
        return (before ? before(k, x, y) : 1.0) *
          factor(x, y, size * sizes[static_cast<std::size_t>(k)]);
      };
    } };
}

// Where the light of a place on the detector comes from: of all channels alike.
ImageFault moved(
  const std::string& kind, const std::function<void(double& x, double& y, double size)>& place)
{
  return { kind,
    [place](ImageFaults& f, double size)
    {
      for (Place& one : f.moved)
      {
        const Place before = one;
        one = [before, place, size](double& x, double& y)
        {
          if (before)
          {
            before(x, y);
          }
          place(x, y, size);
        };
      }
    } };
}

std::vector<double> around(Random& random, int count, double spread)
{
  std::vector<double> values;
  for (int k = 0; k < count; ++k)
  {
    values.push_back(normal(random, spread));
  }
  return values;
}

// 1 for every channel, or in half of the cases different from channel to channel.
std::vector<double> ofChannels(Random& random, int channels, double spread)
{
  std::vector<double> values = around(random, channels, chance(random, 0.5) ? spread : 0.0);
  for (double& value : values)
  {
    value = std::exp(value);
  }
  return values;
}

// Alphabetical. Sizes are such that 1 is clearly visible.
const std::map<std::string, Maker>& makers()
{
  static const std::map<std::string, Maker> known = {
    { "banding",
      [](Random& random, int channels, int, int) -> ImageFault
      {
        const bool rows = chance(random, 0.5);
        const double period = withheld::around(random, 14.0, 2.0);
        const int kind = integer(random, 0, 2);
        const std::vector<double> phase = around(random, channels, kind == 2 ? 0.0 : 1.0);
        const char* kinds[] = { "sine", "square", "sawtooth" };
        return { kinds[kind],
          [=](ImageFaults& f, double size)
          {
            f.stripes = [=](int k, int x, int y)
            {
              const double t = (rows ? y : x) / period + phase[static_cast<std::size_t>(k)];
              const double part = t - std::floor(t);
              return 1.0 +
                0.04 * size *
                (kind == 0      ? std::sin(6.2832 * part)
                    : kind == 1 ? (part < 0.5 ? 1.0 : -1.0)
                                : 2.0 * part - 1.0);
            };
          } };
      } },
    { "channel_crosstalk",
      [](Random&, int, int, int) -> ImageFault {
        return { "both sides", [](ImageFaults& f, double size) { f.mixed = 0.06 * size; } };
      } },
    { "channel_gain",
      [](Random& random, int channels, int, int) -> ImageFault
      {
        const std::vector<double> spread = around(random, channels, 0.05);
        return { "independent",
          [spread](ImageFaults& f, double size)
          {
            for (std::size_t k = 0; k < spread.size(); ++k)
            {
              f.gain[k] *= std::exp(size * spread[k]);
            }
          } };
      } },
    { "dark_offset",
      [](Random& random, int channels, int, int) -> ImageFault
      {
        const double s = sign(random);
        const std::vector<double> part = ofChannels(random, channels, 0.5);
        if (chance(random, 1.0 / 3.0))
        {
          const double angle = uniform(random, 0.0, 6.2832);
          return { "window",
            [=](ImageFaults& f, double size)
            {
              f.window = [=](int k, double x, double y)
              {
                return 0.012 * size * part[static_cast<std::size_t>(k)] *
                  std::exp(0.8 * (x * std::cos(angle) + y * std::sin(angle)));
              };
            } };
        }
        return { "pedestal",
          [s, part](ImageFaults& f, double size)
          {
            for (std::size_t k = 0; k < part.size(); ++k)
            {
              f.offset[k] += 0.012 * s * size * part[k];
            }
          } };
      } },
    { "defocus",
      [](Random& random, int channels, int, int) -> ImageFault
      {
        const std::vector<double> part = ofChannels(random, channels, 0.3);
        return { "Gaussian",
          [part](ImageFaults& f, double size)
          {
            for (std::size_t k = 0; k < part.size(); ++k)
            {
              f.blur[k] += std::sqrt(size) * part[k];
            }
          } };
      } },
    { "detector_nonlinearity",
      [](Random& random, int channels, int, int) -> ImageFault
      {
        const double s = sign(random);
        const int kind = integer(random, 0, 2);
        const char* kinds[] = { "logarithm", "parabola", "S" };
        const std::vector<double> exposure = ofChannels(random, channels, 0.5);
        return { kinds[kind],
          [=](ImageFaults& f, double size)
          {
            f.curve = [=](int k, double u)
            {
              const double a = 0.12 * s * size * exposure[static_cast<std::size_t>(k)];
              return kind == 0
                ? std::log1p(a * u) / (std::fabs(a) < 1e-9 ? 1.0 : a) * (1.0 + 0.5 * a)
                : kind == 1 ? u + a * u * (1.0 - u)
                            : u - 0.2 * a * std::sin(6.2832 * u) * u;
            };
          } };
      } },
    { "distortion",
      [](Random& random, int, int width, int height) -> ImageFault
      {
        const double middleX = 0.5 * width;
        const double middleY = 0.5 * height;
        const double half = std::max(middleX, middleY);
        if (chance(random, 0.5))
        {
          const double s = sign(random);
          return moved("division model of a lens",
            [=](double& x, double& y, double size)
            {
              const double a = (x - middleX) / half;
              const double b = (y - middleY) / half;
              const double division = 1.0 + 0.01 * s * size * (a * a + b * b);
              x = middleX + half * a / division;
              y = middleY + half * b / division;
            });
        }
        // The scene's plane leans away from the camera, 3 half widths before it.
        const double lean = 0.04 * sign(random);
        const double axis = uniform(random, 0.0, 6.2832);
        return moved("leaning plane",
          [=](double& x, double& y, double size)
          {
            const double a = (x - middleX) / half;
            const double b = (y - middleY) / half;
            const double along = a * std::cos(axis) + b * std::sin(axis);
            const double across = b * std::cos(axis) - a * std::sin(axis);
            // The view ray through (along, across, 3) meets the plane.
            const double scale = 1.0 / (1.0 - along / 3.0 * std::tan(lean * size));
            const double u = along * scale / std::cos(lean * size);
            const double v = across * scale;
            x = middleX + half * (u * std::cos(axis) - v * std::sin(axis));
            y = middleY + half * (u * std::sin(axis) + v * std::cos(axis));
          });
      } },
    { "exposure_gain",
      [](Random& random, int, int, int) -> ImageFault
      {
        const double s = sign(random);
        return { "stops",
          [s](ImageFaults& f, double size)
          {
            for (double& gain : f.gain)
            {
              gain *= std::exp2(0.07 * s * size);
            }
          } };
      } },
    { "ghost_reflection",
      [](Random&, int, int, int) -> ImageFault
      {
        return { "mirrored at the center",
          [](ImageFaults& f, double size) { f.ghost += 0.05 * size; } };
      } },
    { "illuminant_drift",
      [](Random& random, int channels, int, int) -> ImageFault
      {
        const double before = withheld::around(random, 4000.0, 1.5);
        const double after = before * (1.0 + 0.2 * sign(random));
        std::vector<double> change;
        for (int k = 0; k < channels; ++k)
        {
          const double micrometers = 0.44 + 0.22 * k / (channels - 1);
          const auto dark = [=](double temperature)
          { return std::log(std::expm1(14388.0 / (micrometers * temperature))); };
          change.push_back(dark(before) - dark(after));
        }
        const double middle = change[change.size() / 2];
        return { "blackbodies",
          [=](ImageFaults& f, double size)
          {
            for (std::size_t k = 0; k < change.size(); ++k)
            {
              f.gain[k] *= std::exp(size * (change[k] - middle));
            }
          } };
      } },
    { "illumination_gradient",
      [](Random& random, int channels, int, int) -> ImageFault
      {
        const double angle = uniform(random, 0.0, 6.2832);
        return field("lamp to one side", ofChannels(random, channels, 0.5),
          [angle](double x, double y, double size)
          {
            const double along = x * std::cos(angle) + y * std::sin(angle);
            const double offset = 0.15 * size;
            return std::pow((9.0 + along * along) / (9.0 + std::pow(along - offset, 2)), 1.5) *
              (1.0 + 0.02 * size * along);
          });
      } },
    { "lag",
      [](Random&, int, int, int) -> ImageFault {
        return { "charge that stays", [](ImageFaults& f, double size) { f.before = 0.04 * size; } };
      } },
    { "local_stray_light",
      [](Random& random, int, int, int) -> ImageFault
      {
        const double radius = withheld::around(random, 12.0, 2.0);
        return { "Lorentzian tail",
          [radius](ImageFaults& f, double size)
          {
            f.tail = std::min(0.06 * size, 0.6);
            f.tailRadius = radius;
          } };
      } },
    { "misregistration",
      [](Random& random, int channels, int width, int height) -> ImageFault
      {
        const std::vector<double> right = around(random, channels, 0.7);
        const std::vector<double> down = around(random, channels, 0.7);
        const std::vector<double> turn =
          around(random, channels, chance(random, 0.5) ? 0.003 : 0.0);
        const std::vector<double> larger =
          around(random, channels, chance(random, 0.5) ? 0.004 : 0.0);
        return { "wedge of each filter",
          [=](ImageFaults& f, double size)
          {
            for (std::size_t k = 0; k < right.size(); ++k)
            {
              const double cosine = std::cos(size * turn[k]) / (1.0 + size * larger[k]);
              const double sine = std::sin(size * turn[k]) / (1.0 + size * larger[k]);
              const double dx = size * right[k];
              const double dy = size * down[k];
              const Place distorted = f.moved[k];
              f.moved[k] = [=](double& x, double& y)
              {
                const double a = x - dx - 0.5 * width;
                const double b = y - dy - 0.5 * height;
                x = 0.5 * width + cosine * a + sine * b;
                y = 0.5 * height - sine * a + cosine * b;
                if (distorted)
                {
                  distorted(x, y);
                }
              };
            }
          } };
      } },
    { "saturation",
      [](Random& random, int channels, int, int) -> ImageFault
      {
        const std::vector<double> part = ofChannels(random, channels, 0.1);
        const double bend = chance(random, 0.5) ? uniform(random, 5.0, 15.0) : 0.0;
        return { bend > 0.0 ? "well that fills up" : "full well",
          [=](ImageFaults& f, double size)
          {
            f.bend = bend;
            for (std::size_t k = 0; k < part.size(); ++k)
            {
              f.well[k] = 0.93 * part[k] * std::exp(-0.15 * size);
            }
          } };
      } },
    { "veiling_glare",
      [](Random&, int, int, int) -> ImageFault {
        return { "haze", [](ImageFaults& f, double size) { f.glare += 0.04 * size; } };
      } },
    { "vignetting",
      [](Random& random, int channels, int, int) -> ImageFault
      {
        const double cx = normal(random, 0.1);
        const double cy = normal(random, 0.1);
        const bool clipped = chance(random, 0.5);
        return field(clipped ? "pupil" : "cosine", ofChannels(random, channels, 0.3),
          [=](double x, double y, double size)
          {
            const double r2 = std::pow(x - cx, 2) + std::pow(y - cy, 2);
            return clipped ? 1.0 - 0.06 * size * std::pow(r2, 1.7)
                           : 1.0 / std::pow(1.0 + 0.04 * size * r2, 2);
          });
      } },
  };
  return known;
}
}

const std::vector<std::string>& imageFaultNames()
{
  static const std::vector<std::string> names = []
  {
    std::vector<std::string> list;
    for (const auto& one : makers())
    {
      list.push_back(one.first);
    }
    return list;
  }();
  return names;
}

const std::vector<std::string>& imageStrangerNames()
{
  static const std::vector<std::string> names{ "dust", "sharpening", "wrong colors of patches",
    "two amplifiers" };
  return names;
}

ImageFaults noFaults(int channels)
{
  ImageFaults faults;
  const auto K = static_cast<std::size_t>(channels);
  faults.moved.resize(K);
  faults.blur.assign(K, 0.0);
  faults.gain.assign(K, 1.0);
  faults.offset.assign(K, 0.0);
  faults.well.assign(K, 1e9);
  return faults;
}

ImageFault drawImageFault(const std::string& name, Random& random, const ImageScene& scene)
{
  return makers().at(name)(random, scene.channels(), scene.width(), scene.height());
}

ImageFault drawImageStranger(const std::string& name, Random& random, const ImageScene& scene)
{
  const int width = scene.width();
  const int height = scene.height();
  if (name == "sharpening")
  {
    return { name,
      [](ImageFaults& f, double size)
      {
        f.other = [size](Planes& planes, const ImageScene& where)
        {
          for (std::vector<double>& plane : planes)
          {
            const std::vector<double> soft =
              blurred({ where.width(), where.height(), plane }, 1.0 / Fine::Parts).value;
            for (std::size_t i = 0; i < plane.size(); ++i)
            {
              plane[i] += 0.5 * size * (plane[i] - soft[i]);
            }
          }
        };
      } };
  }
  struct Spot
  {
    double x, y, radius;
  };
  std::vector<Spot> spots;
  std::vector<double> colors;
  for (int s = 0; s < 60; ++s)
  {
    spots.push_back({ uniform(random, 0.0, width), uniform(random, 0.0, height),
      withheld::around(random, 7.0, 2.0) });
  }
  for (int i = 0; i < 64 * scene.channels(); ++i)
  {
    colors.push_back(normal(random, 0.05));
  }
  const double border = uniform(random, 0.35, 0.65) * width;
  const auto change = [=](double u, int k, int x, int y)
  {
    if (name == "dust")
    {
      double shade = 0.0;
      for (std::size_t s = 0; s < 14; ++s)
      {
        const double r = std::hypot(x - spots[s].x, y - spots[s].y) / spots[s].radius;
        shade += 1.0 / (1.0 + std::exp(6.0 * (r - 1.0)));
      }
      return -0.15 * u * shade;
    }
    if (name == "two amplifiers")
    {
      return x > border ? 0.25 * u * (u - 0.35) : 0.0;
    }
    const int label = scene.label(x, y);
    return label > 0 ? u * colors[static_cast<std::size_t>(label % 64 * scene.channels() + k)]
                     : 0.0;
  };
  return { name,
    [change](ImageFaults& f, double size)
    {
      f.other = [change, size](Planes& planes, const ImageScene& where)
      {
        for (std::size_t k = 0; k < planes.size(); ++k)
        {
          for (int y = 0; y < where.height(); ++y)
          {
            for (int x = 0; x < where.width(); ++x)
            {
              const auto i = static_cast<std::size_t>(y) * static_cast<std::size_t>(where.width()) +
                static_cast<std::size_t>(x);
              planes[k][i] += size * change(planes[k][i], static_cast<int>(k), x, y);
            }
          }
        }
      };
    } };
}

namespace
{
// Of a well of this size, whose electrons find less and less room; at once full where there is no bend.
double filled(double u, double well, double bend)
{
  return bend > 0.0 && u > 0.0 ? well * std::pow(-std::expm1(-std::pow(u / well, bend)), 1.0 / bend)
                               : std::min(u, well);
}
}

Planes expose(const ImageScene& scene, const ImageFaults& faults)
{
  const double half = 0.5 * (std::max(scene.width(), scene.height()) - 1);
  Planes planes;
  for (int k = 0; k < scene.channels(); ++k)
  {
    const auto at = static_cast<std::size_t>(k);
    Fine fine = render(scene, k, faults.moved[at]);
    for (int j = 0; j < fine.height && faults.field; ++j)
    {
      for (int i = 0; i < fine.width; ++i)
      {
        const double x = (i + 0.5) / Fine::Parts - 0.5 - 0.5 * (scene.width() - 1);
        const double y = (j + 0.5) / Fine::Parts - 0.5 - 0.5 * (scene.height() - 1);
        fine.at(i, j) *= faults.field(k, x / half, y / half);
      }
    }
    std::vector<double> u = pixels(blurred(fine, faults.blur[at]));
    if (faults.tail > 0.0)
    {
      // Three Gaussians on the pixels make the tail.
      Fine coarse{ scene.width(), scene.height(), u };
      std::vector<double> sum(u.size(), 0.0);
      for (const double part : { 0.4, 1.0, 2.0 })
      {
        const Fine wide = blurred(coarse, part * faults.tailRadius / Fine::Parts);
        for (std::size_t i = 0; i < u.size(); ++i)
        {
          sum[i] += wide.value[i] / 3.0;
        }
      }
      for (std::size_t i = 0; i < u.size(); ++i)
      {
        u[i] += faults.tail * (sum[i] - u[i]);
      }
    }
    const std::vector<double> direct = u;
    for (std::size_t i = 0; i < u.size(); ++i)
    {
      u[i] += faults.ghost * direct[u.size() - 1 - i];
    }
    const double mean = std::accumulate(u.begin(), u.end(), 0.0) / static_cast<double>(u.size());
    for (double& value : u)
    {
      value += faults.glare * mean;
    }
    planes.push_back(std::move(u));
  }
  const Planes light = planes;
  for (std::size_t k = 0; k < planes.size(); ++k)
  {
    for (std::size_t i = 0; i < planes[k].size(); ++i)
    {
      const auto width = static_cast<std::size_t>(scene.width());
      double u = light[k][i];
      const bool first = k == 0;
      const bool last = k + 1 == planes.size();
      u += first ? 0.0 : (faults.before + 0.5 * faults.mixed) * light[k - 1][i];
      u += last ? 0.0 : 0.5 * faults.mixed * light[k + 1][i];
      u -= (first || last ? 0.5 : 1.0) * faults.mixed * light[k][i];
      if (faults.stripes)
      {
        u *= faults.stripes(
          static_cast<int>(k), static_cast<int>(i % width), static_cast<int>(i / width));
      }
      u *= faults.gain[k];
      u = faults.curve ? faults.curve(static_cast<int>(k), u) : u;
      if (faults.window)
      {
        const double x = static_cast<double>(i % width) - 0.5 * (scene.width() - 1);
        const double y = static_cast<double>(i / width) - 0.5 * (scene.height() - 1);
        u += faults.window(static_cast<int>(k), x / half, y / half);
      }
      planes[k][i] = filled(u + faults.offset[k], faults.well[k], faults.bend);
    }
  }
  if (faults.other)
  {
    faults.other(planes, scene);
  }
  return planes;
}

} // namespace withheld
