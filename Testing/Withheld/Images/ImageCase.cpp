#include "ImageCase.h"

#include "ImageFaults.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <map>

namespace withheld
{

namespace
{
struct Request
{
  std::string set;
  std::vector<std::string> effects;
  std::string stranger;
  bool imperfect =
    false; // gains, offsets, places and colors of the simulated image are a little off
  std::string without, twin;
};

// Each channel's pixels become the mean of their 3 x 3 neighbours.
void shareWithNeighbours(const ImagePair& pair, std::vector<float>& noise)
{
  const std::vector<float> own = noise;
  const auto at = [&pair](int x, int y, int k)
  {
    const auto column = static_cast<std::size_t>(std::clamp(x, 0, pair.width - 1));
    const auto row = static_cast<std::size_t>(std::clamp(y, 0, pair.height - 1));
    const auto pixel = row * static_cast<std::size_t>(pair.width) + column;
    return pixel * static_cast<std::size_t>(pair.channels) + static_cast<std::size_t>(k);
  };
  for (int i = 0; i < static_cast<int>(noise.size()); ++i)
  {
    const int k = i % pair.channels;
    const int x = i / pair.channels % pair.width;
    const int y = i / pair.channels / pair.width;
    float sum = 0.0F;
    for (const int down : { -1, 0, 1 })
    {
      for (const int right : { -1, 0, 1 })
      {
        sum += own[at(x + right, y + down, k)];
      }
    }
    noise[static_cast<std::size_t>(i)] = sum / 9.0F;
  }
}

// As demosaicing leaves noise, and as spectra measured pixel by pixel bring it into a simulation.
void addNoiseOfDevelopment(ImagePair& pair, Random& random)
{
  const double shared = withheld::around(random, 0.006, 1.5);
  const double simulated = withheld::around(random, 0.003, 1.5);
  std::vector<float> noise(pair.real.size());
  for (std::size_t i = 0; i < noise.size(); ++i)
  {
    noise[i] = static_cast<float>(normal(random, 3.0 * shared));
    pair.simulated[i] += static_cast<float>(normal(random, simulated));
  }
  shareWithNeighbours(pair, noise);
  std::transform(
    pair.real.begin(), pair.real.end(), noise.begin(), pair.real.begin(), std::plus<>());
}

const std::vector<std::string>& axesOfImage(const std::string& effect)
{
  static const std::map<std::string, std::vector<std::string>> known = { { "banding",
                                                                           { "rows", "columns" } },
    { "channel_crosstalk", { "channel", "sample", "region" } }, { "channel_gain", { "channel" } },
    { "dark_offset", { "channel", "level" } }, { "defocus", { "edges" } },
    { "detector_nonlinearity", { "level" } }, { "distortion", { "edges" } },
    { "exposure_gain", { "level" } },
    { "ghost_reflection", { "region", "position", "sample", "edges" } },
    { "illuminant_drift", { "channel" } }, { "illumination_gradient", { "position" } },
    { "lag", { "channel", "level", "sample", "region" } },
    { "local_stray_light", { "edges", "position" } }, { "misregistration", { "edges" } },
    { "saturation", { "level" } }, { "veiling_glare", { "channel", "level" } },
    { "vignetting", { "position" } } };
  return known.at(effect);
}

// One value of 500 from a hot or dead pixel, and thirty highlights of some fifteen pixels.
void addSpots(ImagePair& pair, Random& random)
{
  for (float& value : pair.real)
  {
    const double which = withheld::uniform(random, 0.0, 1.0);
    value = which < 0.001 ? 0.0F : which > 0.999 ? 1.0F : value;
  }
  for (int n = 0; n < 30; ++n)
  {
    const double x = withheld::uniform(random, 0.0, pair.width);
    const double y = withheld::uniform(random, 0.0, pair.height);
    for (std::size_t i = 0; i < pair.real.size(); ++i)
    {
      const int pixel = static_cast<int>(i) / pair.channels;
      if (std::hypot(pixel % pair.width - x, pixel / pair.width - y) < 2.2)
      {
        pair.real[i] = std::max(pair.real[i], 0.95F);
      }
    }
  }
}

// What happens to a pair once it is captured; may be null.
using Spoil = void (*)(ImagePair&, Random&);

void writeCase(
  CaseWriter& writer, Spoil spoil, const Request& request, std::uint64_t seed, std::string* name)
{
  Random random(seed);
  const ImageScene scene(
    random, integer(random, 140, 170), integer(random, 112, 136), integer(random, 3, 5));
  const ImageFaults nominal = noFaults(scene.channels());
  const Planes simulated = expose(scene, nominal);
  Key key;
  key.set = request.set;
  key.effects = request.stranger.empty() ? request.effects : std::vector<std::string>{ "?" };
  key.without = request.without;
  key.twin = request.twin;
  std::vector<ImageFault> faults;
  for (const std::string& effect : request.effects)
  {
    faults.push_back(drawImageFault(effect, random, scene));
    const std::vector<std::string>& axes = axesOfImage(effect);
    key.axes.insert(key.axes.end(), axes.begin(), axes.end());
  }
  if (!request.stranger.empty())
  {
    faults.push_back(drawImageStranger(request.stranger, random, scene));
  }
  ImageFaults real = nominal;
  for (const ImageFault& fault : faults)
  {
    key.kinds.push_back(fault.kind);
    const double target = around(random, 0.012, 1.7);
    double low = 0.05;
    double high = 8.0;
    for (int round = 0; round < 5; ++round)
    {
      ImageFaults tried = nominal;
      fault.apply(tried, std::sqrt(low * high));
      (rmsDifference(expose(scene, tried), simulated) < target ? low : high) =
        std::sqrt(low * high);
    }
    fault.apply(real, std::sqrt(low * high));
  }
  key.gapRms = rmsDifference(expose(scene, real), simulated);
  std::vector<double> color(64 * static_cast<std::size_t>(scene.channels()), 1.0);
  if (request.imperfect)
  {
    for (int k = 0; k < scene.channels(); ++k)
    {
      real.gain[static_cast<std::size_t>(k)] *= 1.0 + normal(random, 0.004);
      real.offset[static_cast<std::size_t>(k)] += normal(random, 0.0004);
    }
    for (double& one : color)
    {
      one += normal(random, 0.006);
    }
  }
  const Planes truth = expose(scene, real);
  ImagePair pair{ scene.width(), scene.height(), scene.channels(), {}, {}, {} };
  const double read = around(random, 0.0015, 2.0);
  const double shot = around(random, 0.004, 2.0);
  const bool labelled = chance(random, 0.6);
  for (std::size_t i = 0; i < truth[0].size(); ++i)
  {
    const int label =
      scene.label(static_cast<int>(i) % scene.width(), static_cast<int>(i) / scene.width());
    if (labelled)
    {
      pair.labels.push_back(label);
    }
    for (std::size_t k = 0; k < truth.size(); ++k)
    {
      const double u = truth[k][i];
      pair.real.push_back(static_cast<float>(
        u + normal(random, std::sqrt(read * read + shot * shot * std::max(u, 0.0)))));
      pair.simulated.push_back(static_cast<float>(
        simulated[k][i] * color[static_cast<std::size_t>(label % 64) * truth.size() + k]));
    }
  }
  if (spoil != nullptr)
  {
    spoil(pair, random);
  }
  const std::string made = writer.add(pair, key);
  if (name != nullptr)
  {
    *name = made;
  }
}

void writeCases(CaseWriter& writer, Spoil spoil, bool full, std::uint64_t seed)
{
  const auto write = [&](const Request& request, std::uint64_t own, std::string* name)
  { writeCase(writer, spoil, request, own, name); };
  Random random(seed * 15485863 + 11);
  for (const std::string& name : imageFaultNames())
  {
    const std::uint64_t own = random();
    std::string twin;
    write({ "single", { name }, "", false, "", "" }, own, &twin);
    if (full)
    {
      write({ "single", { name }, "", false, "", "" }, random(), nullptr);
      write({ "nominal", { name }, "", true, "", "" }, random(), nullptr);
      write({ "removed", { name }, "", false, name, twin }, own, nullptr);
    }
  }
  for (int n = 0; n < (full ? 16 : 3); ++n)
  {
    write(
      { "several", someOf(random, imageFaultNames(), 2), "", false, "", "" }, random(), nullptr);
    if (full && n % 2 == 0)
    {
      write({ "nominal several", someOf(random, imageFaultNames(), 2), "", true, "", "" }, random(),
        nullptr);
    }
  }
  for (int n = 0; n < (full ? 8 : 2); ++n)
  {
    write({ "clean", {}, "", false, "", "" }, random(), nullptr);
  }
  for (std::size_t n = 0; n < (full ? 10 : 2); ++n)
  {
    write({ "stranger", {}, imageStrangerNames()[n % imageStrangerNames().size()], false, "", "" },
      random(), nullptr);
  }
}
}

void writeImageCases(CaseWriter& writer, bool full, std::uint64_t seed)
{
  writeCases(writer, nullptr, full, seed);
}

void writeDevelopedImageCases(CaseWriter& writer, bool full, std::uint64_t seed)
{
  writeCases(writer, addNoiseOfDevelopment, full, seed);
}

void writeSpottedImageCases(CaseWriter& writer, bool full, std::uint64_t seed)
{
  writeCases(writer, addSpots, full, seed);
}

} // namespace withheld
