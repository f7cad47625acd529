#include "ImageCase.h"

#include "ImageFaults.h"

#include <algorithm>
#include <cmath>
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

const std::vector<std::string>& axesOfImage(const std::string& effect)
{
  static const std::map<std::string, std::vector<std::string>> known = { { "banding",
                                                                           { "rows", "columns" } },
    { "channel_crosstalk", { "channel", "sample", "region" } }, { "channel_gain", { "channel" } },
    { "dark_offset", { "channel", "level" } }, { "defocus", { "edges" } },
    { "detector_nonlinearity", { "level" } }, { "exposure_gain", { "level" } },
    { "ghost_reflection", { "region", "position", "sample", "edges" } },
    { "illumination_gradient", { "position" } },
    { "lag", { "channel", "level", "sample", "region" } },
    { "local_stray_light", { "edges", "position" } }, { "misregistration", { "edges" } },
    { "saturation", { "level" } }, { "veiling_glare", { "channel", "level" } },
    { "vignetting", { "position" } } };
  return known.at(effect);
}

void write(CaseWriter& writer, const Request& request, std::uint64_t seed, std::string* name)
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
  const std::string made = writer.add(pair, key);
  if (name != nullptr)
  {
    *name = made;
  }
}
}

void writeImageCases(CaseWriter& writer, bool full, std::uint64_t seed)
{
  Random random(seed * 15485863 + 11);
  for (const std::string& name : imageFaultNames())
  {
    const std::uint64_t own = random();
    std::string twin;
    write(writer, { "single", { name }, "", false, "", "" }, own, &twin);
    if (full)
    {
      write(writer, { "single", { name }, "", false, "", "" }, random(), nullptr);
      write(writer, { "nominal", { name }, "", true, "", "" }, random(), nullptr);
      write(writer, { "removed", { name }, "", false, name, twin }, own, nullptr);
    }
  }
  for (int n = 0; n < (full ? 16 : 3); ++n)
  {
    write(writer, { "several", someOf(random, imageFaultNames(), 2), "", false, "", "" }, random(),
      nullptr);
    if (full && n % 2 == 0)
    {
      write(writer, { "nominal several", someOf(random, imageFaultNames(), 2), "", true, "", "" },
        random(), nullptr);
    }
  }
  for (int n = 0; n < (full ? 8 : 2); ++n)
  {
    write(writer, { "clean", {}, "", false, "", "" }, random(), nullptr);
  }
  for (std::size_t n = 0; n < (full ? 10 : 2); ++n)
  {
    write(writer,
      { "stranger", {}, imageStrangerNames()[n % imageStrangerNames().size()], false, "", "" },
      random(), nullptr);
  }
}

} // namespace withheld
