#include "SecondCamera.h"

#include <algorithm>
#include <cmath>

namespace withheld::second
{

const Spectrum& wavelengths()
{
  static const Spectrum grid = []
  {
    Spectrum nm(static_cast<std::size_t>((Highest - Lowest) / Step) + 1);
    for (std::size_t j = 0; j < nm.size(); ++j)
    {
      nm[j] = Lowest + Step * static_cast<double>(j);
    }
    return nm;
  }();
  return grid;
}

namespace
{
Spectrum bell(double center, double deviation)
{
  const Spectrum z = (wavelengths() - center) / deviation;
  return std::exp(-0.5 * z * z);
}

// Rises to one and falls again with these deviations to the left and right.
Spectrum skewed(double center, double left, double right)
{
  Spectrum shape = bell(center, right);
  const Spectrum steep = bell(center, left);
  for (std::size_t j = 0; j < shape.size(); ++j)
  {
    shape[j] = wavelengths()[j] < center ? steep[j] : shape[j];
  }
  return shape;
}

Spectrum daylight()
{
  const Spectrum x = (wavelengths() - 560.0) / 100.0;
  return 1.0 - 0.06 * x - 0.03 * x * x + 0.05 * bell(460.0, 8.0) - 0.06 * bell(430.0, 6.0);
}

Spectrum lightOf(const Lamp& lamp)
{
  const Spectrum x = (wavelengths() - 560.0) / 100.0;
  Spectrum light;
  switch (lamp.kind)
  {
    case LampKind::Halogen: // with a filter against heat
      light = std::exp(1.1 * x - 0.12 * x * x) / (1.0 + std::exp((wavelengths() - 715.0) / 14.0));
      break;
    case LampKind::Daylight:
      light = daylight();
      break;
    case LampKind::Fluorescent:
      light = 0.35 * skewed(545.0, 60.0, 70.0) + 0.3 * bell(611.0, 5.0) + 0.12 * bell(490.0, 12.0) +
        0.25 * bell(404.7, 1.5) + 0.6 * bell(435.8, 1.5) + 0.8 * bell(546.1, 1.5) +
        0.2 * bell(578.0, 2.0) + 0.04;
      break;
    case LampKind::WhiteDiode:
      light = 0.9 * skewed(452.0, 9.0, 12.0) + skewed(560.0, 42.0, 62.0) + 0.01;
      break;
  }
  light = (1.0 - lamp.other) * light + lamp.other * daylight();
  return light * std::exp(lamp.warmth * x - lamp.bump * bell(500.0, 45.0));
}

Spectrum transmitted(const Camera& camera, const Passband& band)
{
  const Spectrum z = 2.0 * (wavelengths() - band.center) / band.width;
  Spectrum t(z.size());
  for (std::size_t j = 0; j < z.size(); ++j)
  {
    const double nm = wavelengths()[j];
    switch (camera.optics)
    {
      case Optics::CavityFilters:
        t[j] = 1.0 / (1.0 + std::pow(std::fabs(z[j]), 2.0 * band.order));
        break;
      case Optics::TunableFilter:
      {
        const double phase = 1.39156 * z[j] * band.center / nm; // half of its maximum at 1.39
        const double lobe = std::fabs(phase) < 1e-9 ? 1.0 : std::sin(phase) / phase;
        t[j] = lobe * lobe;
        break;
      }
      case Optics::Diodes:
        t[j] = std::exp(-0.6931 * z[j] * z[j] * (z[j] > 0.0 ? 0.75 : 1.3));
        break;
    }
    t[j] += band.leak *
      (1.0 / (1.0 + std::exp((650.0 - nm) / 8.0)) + 1.0 / (1.0 + std::exp((nm - 430.0) / 8.0)));
  }
  if (camera.smear > 0.0)
  {
    const auto reach = static_cast<int>(4.0 * camera.smear / Step);
    Spectrum sum(0.0, t.size());
    double total = 0.0;
    for (int shift = -reach; shift <= reach; ++shift)
    {
      const double weight = std::exp(-0.5 * std::pow(shift * Step / camera.smear, 2));
      sum += weight * t.shift(shift);
      total += weight;
    }
    t = sum / total;
  }
  return t;
}
}

Camera drawCamera(Random& random, bool withLamp)
{
  Camera camera;
  const int kind = integer(random, 0, withLamp ? 2 : 4);
  camera.optics = kind < 2 ? Optics::CavityFilters
    : kind == 2            ? Optics::TunableFilter
                           : Optics::Diodes;
  const int lamp = integer(random, 0, 5);
  camera.lamp.kind = lamp < 2 ? LampKind::Halogen
    : lamp < 4                ? LampKind::Daylight
    : lamp == 4               ? LampKind::Fluorescent
                              : LampKind::WhiteDiode;
  camera.lamp.warmth = normal(random, 0.15);
  camera.detectorPeak = uniform(random, 500.0, 650.0);
  camera.detectorWidth = uniform(random, 130.0, 220.0);
  camera.first = uniform(random, 382.0, 400.0);
  camera.last = uniform(random, 700.0, 730.0);
  const int channels = integer(random, 5, 14);
  const double spacing = 270.0 / channels;
  for (int k = 0; k < channels; ++k)
  {
    Passband band;
    band.center = 412.0 + spacing * (k + uniform(random, 0.35, 0.65));
    band.order = uniform(random, 1.5, 4.0);
    band.width = camera.optics == Optics::CavityFilters ? around(random, 0.8 * spacing, 1.4)
      : camera.optics == Optics::TunableFilter
      ? std::max(30.0 * std::pow(band.center / 550.0, 2), 8.0)
      : around(random, 24.0, 1.3);
    band.width = std::max(band.width, 9.0);
    camera.passbands.push_back(band);
  }
  return camera;
}

std::vector<Spectrum> responsivities(const Camera& camera)
{
  const bool diodes = camera.optics == Optics::Diodes;
  const Spectrum x = (wavelengths() - camera.detectorPeak) / camera.detectorWidth;
  Spectrum common = 1.0 / (1.0 + x * x);
  if (!diodes)
  {
    common *= lightOf(camera.lamp);
  }
  for (std::size_t j = 0; j < common.size(); ++j)
  {
    const double nm = wavelengths()[j];
    common[j] = nm < camera.first || nm > camera.last ? 0.0 : common[j];
  }
  std::vector<Spectrum> channels;
  for (const Passband& band : camera.passbands)
  {
    channels.emplace_back(common * transmitted(camera, band));
  }
  return channels;
}

} // namespace withheld::second
