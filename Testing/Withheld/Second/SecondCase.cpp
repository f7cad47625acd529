#include "SecondCase.h"

#include "SecondEffects.h"

#include <algorithm>
#include <cmath>

namespace withheld
{

namespace
{
using namespace second;

struct Request
{
  std::string set;
  std::vector<std::string> effects;
  std::string stranger;
  bool imperfect = false; // the nominal camera is a little off in every channel
  std::string without, twin;
};

bool has(const std::vector<std::string>& list, const std::string& name)
{
  return std::find(list.begin(), list.end(), name) != list.end();
}

// Straight lines through values on the nodes: the sum over a node's hat.
void measureCamera(Random& random, const World& world, Capture& capture)
{
  const std::vector<Spectrum> rows = responsivities(world.camera);
  const int step = chance(random, 0.4) ? 10 : 5;
  for (int nm = 380; nm <= 730; nm += step)
  {
    capture.cameraWavelengths.push_back(nm);
    capture.camera.emplace_back();
    Spectrum hat = 1.0 - std::abs(Spectrum(wavelengths() - static_cast<double>(nm))) / step;
    hat[hat < 0.0] = 0.0;
    for (const Spectrum& row : rows)
    {
      capture.camera.back().push_back((row * hat).sum() / row.sum());
    }
  }
}

void measureSamples(Random& random, const Scene& scene, Capture& capture)
{
  const double deviation = uniform(random, 0.0, 0.0008);
  for (int nm = 380; nm <= 730; nm += 10)
  {
    capture.sampleWavelengths.push_back(nm);
  }
  for (const Swatch& swatch : scene.swatches)
  {
    Sample sample{ "medium " + std::string(1, static_cast<char>('A' + swatch.medium)),
      std::to_string(swatch.scene), swatch.x, swatch.y, swatch.order, {} };
    for (const double nm : capture.sampleWavelengths)
    {
      const auto j = static_cast<std::size_t>((nm - Lowest) / Step);
      sample.reflectance.push_back(swatch.reflectance[j] + normal(random, deviation));
    }
    capture.samples.push_back(std::move(sample));
  }
}

void read(Random& random, const Responses& truth, double factor, bool repeated, Capture& capture)
{
  // Electrons of a patch's pixels together.
  const double well = around(random, 2e4, 2.5) * around(random, 40.0, 3.0);
  capture.shot = 1.0 / std::sqrt(well);
  capture.read = around(random, 0.0007, 2.0);
  capture.repeats = repeated ? integer(random, 3, 4) : integer(random, 1, 3);
  capture.noiseKnown = repeated || capture.repeats == 1 || chance(random, 0.6);
  for (const std::vector<double>& row : truth)
  {
    for (int n = 0; n < capture.repeats; ++n)
    {
      capture.readings.push_back(row);
      for (double& u : capture.readings.back())
      {
        u += factor *
          (normal(random, capture.read) +
            normal(random, capture.shot * std::sqrt(std::max(u, 0.0))));
      }
    }
  }
}

struct Made
{
  Capture capture;
  Key key;
};

Made make(const Request& request, std::uint64_t seed)
{
  Random random(seed);
  Made made;
  Key& key = made.key;
  const std::vector<std::string> ofMedia = { "medium_gain", "specular_component", "interreflection",
    "translucency", "fluorescence" };
  const bool media = std::any_of(request.effects.begin(), request.effects.end(),
    [&ofMedia](const std::string& name) { return has(ofMedia, name); });
  const Scene scene = drawScene(random, integer(random, 120, 240), media ? 2 : 1);
  const World nominal = makeWorld(drawCamera(random, has(request.effects, "illuminant_drift")));
  const std::vector<double> white = whiteOf(nominal);
  const Responses ideal = respond(nominal, scene, white);

  std::vector<Fault> faults;
  for (const std::string& name : request.effects)
  {
    faults.push_back(drawFault(name, random, nominal, scene));
    for (const std::string& axis : axesOf(name, scene.media > 1))
    {
      key.axes.push_back(axis);
    }
  }
  if (!request.stranger.empty())
  {
    faults.push_back(drawStranger(request.stranger, random, scene));
  }
  key.set = request.set;
  key.effects = request.stranger.empty() ? request.effects : std::vector<std::string>{ "?" };
  key.without = request.without;
  key.twin = request.twin;
  World real = nominal;
  bool rewhitened = false;
  const bool noisy = has(request.effects, "excess_noise");
  for (std::size_t f = 0; f < faults.size(); ++f)
  {
    const Fault& fault = faults[f];
    key.kinds.push_back(fault.kind);
    const double target = around(random, 0.011, 2.0);
    double low = 1e-3;
    double high = 40.0;
    for (int round = 0; round < 16 && key.effects[f] != "excess_noise"; ++round)
    {
      World tried = nominal;
      fault.apply(tried, std::sqrt(low * high));
      const double rms =
        rmsDifference(respond(tried, scene, fault.rewhitened ? whiteOf(tried) : white), ideal);
      (rms < target ? low : high) = std::sqrt(low * high);
    }
    fault.apply(
      real, key.effects[f] == "excess_noise" ? uniform(random, 0.8, 2.0) : std::sqrt(low * high));
    rewhitened = rewhitened || fault.rewhitened;
  }
  key.gapRms = rmsDifference(respond(real, scene, rewhitened ? whiteOf(real) : white), ideal);
  std::vector<double> atWhite = rewhitened ? whiteOf(real) : white;
  if (request.imperfect)
  {
    World off = rewhitened ? real : nominal;
    for (std::size_t k = 0; k < real.gain.size(); ++k)
    {
      const double moved = uniform(random, -0.5, 0.5);
      real.camera.passbands[k].center += moved;
      off.camera.passbands[k].center += moved;
      real.gain[k] *= 1.0 + uniform(random, -0.007, 0.007);
      real.dark[k] += uniform(random, -0.0005, 0.0005);
    }
    atWhite = whiteOf(off);
  }
  measureCamera(random, nominal, made.capture);
  made.capture.dark.assign(nominal.gain.size(), 0.0);
  measureSamples(random, scene, made.capture);
  read(random, respond(real, scene, atWhite), real.noise, noisy, made.capture);
  return made;
}
}

void writeSecondCases(CaseWriter& writer, bool full, std::uint64_t seed)
{
  Random random(seed * 104729 + 3);
  const auto write = [&](const Request& request, std::uint64_t own)
  {
    const Made made = make(request, own);
    return writer.add(made.capture, made.key);
  };
  for (const std::string& name : faultNames())
  {
    for (int n = 0; n < (full ? 2 : 1); ++n)
    {
      const std::uint64_t own = random();
      const std::string twin = write({ "single", { name }, "", false, "", "" }, own);
      if (full)
      {
        write({ "removed", { name }, "", false, name, twin }, own);
      }
      if (full && name != "excess_noise")
      {
        write({ "nominal", { name }, "", true, "", "" }, random());
      }
    }
  }
  for (int n = 0; n < (full ? 30 : 4); ++n)
  {
    write(
      { "several", someOf(random, faultNames(), n % 3 == 2 ? 3 : 2), "", false, "", "" }, random());
    if (full)
    {
      write({ "nominal several", someOf(random, faultNames(), 2), "", true, "", "" }, random());
    }
  }
  for (int n = 0; n < (full ? 20 : 3); ++n)
  {
    write({ "clean", {}, "", false, "", "" }, random());
  }
  for (std::size_t n = 0; n < (full ? 18 : 3); ++n)
  {
    write({ "stranger", {}, strangerNames()[n % strangerNames().size()], false, "", "" }, random());
  }
}

} // namespace withheld
