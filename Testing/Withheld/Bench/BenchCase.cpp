#include "BenchCase.h"

#include "PlantedEffects.h"
#include "Swatches.h"

#include <algorithm>
#include <cmath>
#include <numeric>
#include <set>

namespace withheld
{

namespace
{
struct CaseRequest
{
  std::uint64_t seed = 1;
  std::vector<std::string> effects; // names to plant; none: a clean capture
  std::string stranger;             // a kind that the library does not have
  double strength = 1.0;
  int samples = 200;
  bool nominalErrors = false; // every gain 0.4 %, center 0.3 nm, dark 0.0003 off
};

struct BenchCase
{
  Capture capture;
  Key key;
};

Bench drawBench(Random& random)
{
  Bench bench;
  const int channels = integer(random, 6, 16);
  bench.lamp.temperature = uniform(random, 2600.0, 6500.0);
  bench.lamp.blueLed = chance(random, 0.25) ? uniform(random, 0.3, 1.5) : 0.0;
  bench.detector.blueLoss = uniform(random, 0.2, 0.8);
  bench.detector.redCut = uniform(random, 700.0, 950.0);
  if (chance(random, 0.5))
  {
    bench.lamp.first = 400;
    bench.lamp.last = 700;
  }
  const double spacing = 280.0 / (channels - 1);
  const double width = std::max(uniform(random, 0.6, 1.6) * spacing, 10.0);
  const double steepness = chance(random, 0.5) ? 2.0 : uniform(random, 2.5, 6.0);
  for (int k = 0; k < channels; ++k)
  {
    Filter filter;
    filter.center = 411.0 + spacing * k * 0.987 + normal(random, 1.5);
    filter.width = width * std::exp(normal(random, 0.08));
    filter.steepness = steepness;
    filter.skew = normal(random, 0.05);
    filter.height = uniform(random, 0.4, 0.9);
    bench.filters.push_back(filter);
  }
  bench.gain.assign(bench.filters.size(), 1.0);
  bench.dark.assign(bench.filters.size(), 0.0);
  bench.exposure.assign(bench.filters.size(), 1.0);
  if (chance(random, 0.3))
  {
    for (double& dark : bench.dark)
    {
      dark = uniform(random, 0.0, 0.01);
    }
  }
  return bench;
}

void drawPatches(Random& random, const CaseRequest& request, bool mediumMatters, int fewestMedia,
  std::vector<Patch>& patches, std::vector<std::string>& media)
{
  const int mediaCount = mediumMatters ? (chance(random, 0.85) ? integer(random, 2, 4) : 1)
                                       : integer(random, fewestMedia, 3);
  std::vector<SwatchBook> books;
  std::vector<SwatchBook> real = realSwatches();
  std::shuffle(real.begin(), real.end(), random);
  for (int m = 0; m < mediaCount; ++m)
  {
    if (!real.empty() && chance(random, 0.5))
    {
      books.push_back(real.back());
      real.pop_back();
      std::shuffle(books.back().reflectance.begin(), books.back().reflectance.end(), random);
    }
    else
    {
      books.push_back(drawSwatches(random, "drawn-" + std::to_string(m + 1), request.samples));
    }
    media.push_back(books.back().name);
  }
  const int scenes = chance(random, 0.4) ? integer(random, 2, 3) : 1;
  const bool sceneIsMedium = scenes > 1 && mediaCount > 1 && chance(random, 0.5);
  const int perScene = (request.samples + scenes - 1) / scenes;
  const int columns =
    std::max(2, static_cast<int>(std::lround(std::sqrt(perScene * uniform(random, 0.8, 1.9)))));
  const int rows = (perScene + columns - 1) / columns;
  for (int i = 0; i < request.samples; ++i)
  {
    Patch patch;
    const int place = i % perScene;
    patch.scene = i / perScene;
    patch.medium =
      sceneIsMedium ? std::min(patch.scene, mediaCount - 1) : integer(random, 0, mediaCount - 1);
    const auto& book = books[static_cast<std::size_t>(patch.medium)].reflectance;
    patch.reflectance = book[static_cast<std::size_t>(i) % book.size()];
    const double half = 0.5 * std::max(columns - 1, rows - 1);
    patch.column = (place % columns - 0.5 * (columns - 1)) / half;
    patch.row = (place / columns - 0.5 * (rows - 1)) / half;
    patches.push_back(std::move(patch));
  }
  std::vector<int> order(patches.size());
  std::iota(order.begin(), order.end(), 1);
  if (chance(random, 0.6))
  {
    std::shuffle(order.begin(), order.end(), random);
  }
  for (std::size_t i = 0; i < patches.size(); ++i)
  {
    patches[i].order = order[i];
  }
}

// camera.csv: its mean through a slit around each wavelength or, where the curve is smooth on the grid, its value
// there; scaled to the white.
void measureCamera(Random& random, const Bench& bench, Capture& capture)
{
  const int step = chance(random, 0.5) ? 5 : 10;
  double narrowest = 1e9;
  for (const Filter& filter : bench.filters)
  {
    narrowest = std::min(narrowest, filter.width / std::max(filter.steepness - 1.0, 1.0));
  }
  const bool around = narrowest < 2.0 * step || chance(random, 0.5);
  const int first = bench.lamp.first;
  const int last = bench.lamp.last;
  for (int nm = first; nm <= last; nm += step)
  {
    capture.cameraWavelengths.push_back(nm);
    capture.camera.emplace_back(bench.filters.size(), 0.0);
  }
  for (std::size_t k = 0; k < bench.filters.size(); ++k)
  {
    const Curve fine = responsivityOf(bench, k);
    double sum = 0.0;
    for (std::size_t w = 0; w < capture.camera.size(); ++w)
    {
      const int center = static_cast<int>(capture.cameraWavelengths[w]) - FirstNanometre;
      double value = 0.0;
      if (!around)
      {
        value = fine[static_cast<std::size_t>(center)];
      }
      // A triangular slit as wide as the step; beyond the ends everything counts for the end.
      for (int j = 0; j < Nanometres && around; ++j)
      {
        const bool beyond =
          (w == 0 && j < center) || (w + 1 == capture.camera.size() && j > center);
        const double slit = beyond ? 1.0 : std::max(0.0, 1.0 - std::fabs(j - center) / step);
        value += slit * fine[static_cast<std::size_t>(j)];
      }
      capture.camera[w][k] = value;
      sum += value;
    }
    for (auto& row : capture.camera)
    {
      row[k] = std::max(row[k] / sum, 0.0);
    }
  }
}

Responses modelResponses(const Capture& capture, const std::vector<Patch>& patches)
{
  Responses u;
  for (const Patch& patch : patches)
  {
    u.emplace_back(capture.dark);
    for (std::size_t w = 0; w < capture.camera.size(); ++w)
    {
      const auto j = static_cast<std::size_t>(capture.cameraWavelengths[w] - FirstNanometre);
      for (std::size_t k = 0; k < u.back().size(); ++k)
      {
        u.back()[k] += capture.camera[w][k] * patch.reflectance[j];
      }
    }
  }
  return u;
}

Bench errBy(const Bench& nominal, const PlantedEffect& effect, double size)
{
  Bench bench = nominal;
  effect.apply(bench, size);
  return bench;
}

BenchCase makeCase(const CaseRequest& request)
{
  Random random(request.seed * 7919 + 17);
  BenchCase result;
  Capture& capture = result.capture;
  std::vector<Patch> patches;
  std::vector<std::string> media;
  Bench nominal = drawBench(random);
  const auto& surfaces = { "medium_gain", "specular_component", "interreflection", "translucency",
    "fluorescence" };
  const bool mediumMatters = std::any_of(request.effects.begin(), request.effects.end(),
    [&surfaces](const std::string& name)
    { return std::find(surfaces.begin(), surfaces.end(), name) != surfaces.end(); });
  // In one medium polarisation is a gain of each channel, which the library has.
  const int fewestMedia = request.stranger == "polarisation" ? 2 : 1;
  drawPatches(random, request, mediumMatters, fewestMedia, patches, media);
  const std::vector<double> white = whiteOf(nominal);
  measureCamera(random, nominal, capture);
  capture.dark = nominal.dark;
  const Responses ideal = expose(nominal, patches, white);

  std::vector<PlantedEffect> planted;
  for (const std::string& name : request.effects)
  {
    planted.push_back(plant(name, random, nominal, static_cast<int>(media.size()), patches));
  }
  if (!request.stranger.empty())
  {
    planted.push_back(plantStranger(request.stranger, random, nominal, patches));
  }
  Bench real = nominal;
  bool rebalance = false;
  for (const PlantedEffect& effect : planted)
  {
    // The size at which the effect alone makes a gap of the drawn strength.
    const double target = request.strength * uniform(random, 0.006, 0.02);
    double size = 1.0;
    if (effect.name != "excess_noise")
    {
      double low = 1e-3;
      double high = 30.0;
      for (int round = 0; round < 14; ++round)
      {
        size = std::sqrt(low * high);
        const Bench tried = errBy(nominal, effect, size);
        const double rms =
          rmsDifference(expose(tried, patches, effect.rebalance ? whiteOf(tried) : white), ideal);
        (rms < target ? low : high) = size;
      }
    }
    effect.apply(real, effect.name == "excess_noise" ? request.strength : size);
    rebalance = rebalance || effect.rebalance;
    result.key.effects.push_back(effect.name.empty() ? "?" : effect.name);
    result.key.kinds.push_back(effect.kind);
    result.key.axes.insert(result.key.axes.end(), effect.axes.begin(), effect.axes.end());
  }
  const Responses beforeErrors = expose(real, patches, rebalance ? whiteOf(real) : white);
  if (request.nominalErrors)
  {
    for (std::size_t k = 0; k < real.filters.size(); ++k)
    {
      real.gain[k] *= 1.0 + normal(random, 0.004);
      real.filters[k].center += normal(random, 0.3);
      real.dark[k] += normal(random, 0.0003);
    }
  }
  // The white was taken with the real camera, or long ago with the nominal lamp.
  Bench atWhite = rebalance ? real : nominal;
  for (std::size_t k = 0; k < real.filters.size() && request.nominalErrors; ++k)
  {
    atWhite.filters[k].center = real.filters[k].center;
  }
  const Responses truth = expose(real, patches, whiteOf(atWhite));
  result.key.gapRms = rmsDifference(beforeErrors, ideal);
  const double coarse = rmsDifference(modelResponses(capture, patches), ideal);
  result.key.bestShrink =
    result.key.gapRms > 0.0 ? std::max(0.0, 1.0 - coarse / result.key.gapRms) : 1.0;

  // The spectrophotometer.
  const int firstNm = nominal.lamp.first;
  const int lastNm = nominal.lamp.last;
  const double scatter = uniform(random, 0.0, 0.0006);
  for (int nm = firstNm; nm <= lastNm; nm += 10)
  {
    capture.sampleWavelengths.push_back(nm);
  }
  for (const Patch& patch : patches)
  {
    Sample sample{ media[static_cast<std::size_t>(patch.medium)],
      "scene" + std::to_string(patch.scene + 1), 100.0 + 80.0 * patch.column,
      80.0 + 80.0 * patch.row, static_cast<double>(patch.order), {} };
    for (const double nm : capture.sampleWavelengths)
    {
      sample.reflectance.push_back(
        patch.reflectance[static_cast<std::size_t>(nm - FirstNanometre)] + normal(random, scatter));
    }
    capture.samples.push_back(std::move(sample));
  }
  // The readings.
  capture.read = uniform(random, 0.0004, 0.0015);
  capture.shot = uniform(random, 0.0005, 0.003);
  capture.repeats = integer(random, 1, 5);
  const bool noisy = std::find(result.key.effects.begin(), result.key.effects.end(),
                       "excess_noise") != result.key.effects.end();
  capture.noiseKnown = noisy || chance(random, 0.7) || capture.repeats == 1;
  if (noisy)
  {
    capture.repeats = std::max(capture.repeats, 3);
  }
  for (std::size_t i = 0; i < truth.size(); ++i)
  {
    for (int n = 0; n < capture.repeats; ++n)
    {
      capture.readings.push_back(truth[i]);
      for (double& u : capture.readings.back())
      {
        const double deviation =
          std::sqrt(capture.read * capture.read + capture.shot * capture.shot * std::max(u, 0.0));
        u += normal(random, real.noiseFactor * deviation);
        u = std::round(u * 65535.0) / 65535.0;
      }
    }
  }
  return result;
}

struct Plan
{
  std::string set; // single, several, clean, stranger, removed, ...
  CaseRequest request;
  std::string without;
  int twin = -1; // the plan with the same capture and the whole library
};

std::vector<std::string> someEffects(Random& random, int count)
{
  std::set<std::string> chosen;
  while (static_cast<int>(chosen.size()) < count)
  {
    const auto& names = plantableNames();
    chosen.insert(
      names[static_cast<std::size_t>(integer(random, 0, static_cast<int>(names.size()) - 1))]);
  }
  return { chosen.begin(), chosen.end() };
}

std::vector<Plan> plans(bool full, std::uint64_t seed)
{
  Random random(seed);
  std::vector<Plan> list;
  const auto add = [&](const std::string& set, CaseRequest request, const std::string& without = {})
  {
    request.seed = random();
    list.push_back({ set, std::move(request), without });
  };
  const auto singles =
    [&](const std::string& set, int each, double strength, int samples, bool errors)
  {
    for (const std::string& name : plantableNames())
    {
      for (int n = 0; n < each && (!errors || name != "excess_noise"); ++n)
      {
        CaseRequest request;
        request.effects = { name };
        request.strength = strength;
        request.samples = samples;
        request.nominalErrors = errors;
        add(set, request);
      }
    }
  };
  singles("single", full ? 4 : 1, 1.0, 200, false);
  for (int n = 0; n < (full ? 40 : 4); ++n)
  {
    CaseRequest request;
    request.effects = someEffects(random, n % 3 == 2 ? 3 : 2);
    add("several", request);
  }
  for (int n = 0; n < (full ? 40 : 6); ++n)
  {
    add("clean", CaseRequest{});
  }
  for (int n = 0; n < (full ? 21 : 3); ++n)
  {
    CaseRequest request;
    request.stranger = strangerNames()[static_cast<std::size_t>(n) % strangerNames().size()];
    add("stranger", request);
  }
  // The first single cases again, without what was planted.
  const int each = full ? 4 : 1;
  for (std::size_t e = 0; e < plantableNames().size(); ++e)
  {
    for (int n = 0; n < (full ? 2 : (e % 4 == 1 ? 1 : 0)); ++n)
    {
      const int twin = static_cast<int>(e) * each + n;
      list.push_back(
        { "removed", list[static_cast<std::size_t>(twin)].request, plantableNames()[e], twin });
    }
  }
  singles("nominal", full ? 2 : 0, 1.0, 200, true);
  for (int n = 0; n < (full ? 20 : 0); ++n)
  {
    CaseRequest request;
    request.effects = someEffects(random, 2);
    request.nominalErrors = true;
    add("nominal several", request);
  }
  singles("third", full ? 2 : 0, 1.0 / 3.0, 200, false);
  singles("few", full ? 2 : 0, 1.0, 44, false);
  return list;
}
}

void writeBenchCases(CaseWriter& writer, bool full, std::uint64_t seed)
{
  std::vector<std::string> names;
  for (const Plan& plan : plans(full, seed))
  {
    BenchCase made = makeCase(plan.request);
    made.key.set = plan.set;
    made.key.without = plan.without;
    made.key.twin = plan.twin < 0 ? "" : names[static_cast<std::size_t>(plan.twin)];
    names.push_back(writer.add(made.capture, made.key));
  }
}

} // namespace withheld
