#include "RealCase.h"

#include "RealFaults.h"
#include "RealSamples.h"

#include <algorithm>
#include <cmath>
#include <numeric>

namespace withheld
{

namespace
{
struct Request
{
  std::string set;
  std::vector<std::string> effects;
  std::string stranger;
  std::string without, twin;
};

RealSamples drawSamples(Random& random, Source source, bool severalMedia)
{
  if (source == Source::Chart)
  {
    return chart(random);
  }
  const int which = severalMedia ? 2 : integer(random, 0, 2);
  std::vector<std::string> media = { "paper", "cotton" };
  if (which < 2)
  {
    media = { media[static_cast<std::size_t>(which)] };
  }
  RealSamples real = fittedHalf(random, media, source);
  // Nothing is told of place and time: set out at random.
  const Eigen::Index S = real.reflectance.cols();
  const auto columns =
    static_cast<Eigen::Index>(std::ceil(std::sqrt(1.3 * static_cast<double>(S))));
  real.x.resize(S);
  real.y.resize(S);
  for (Eigen::Index i = 0; i < S; ++i)
  {
    real.x[i] = static_cast<double>(i % columns);
    real.y[i] = static_cast<double>(i / columns);
  }
  return real;
}

double rms(const Eigen::MatrixXd& gap)
{
  return std::sqrt(gap.squaredNorm() / static_cast<double>(gap.size()));
}

void spoil(Eigen::MatrixXd& reading, Random& random)
{
  for (double& u : reading.reshaped())
  {
    const double which = uniform(random, 0.0, 1.0);
    u = which < 0.002 ? 0.0 : which > 0.998 ? 1.0 : std::round(u * 200.0) / 200.0;
  }
}

std::string write(
  CaseWriter& writer, Source source, bool careless, const Request& request, std::uint64_t seed)
{
  Random random(seed);
  const auto needs = [&request](std::initializer_list<const char*> names)
  {
    return std::any_of(request.effects.begin(), request.effects.end(),
      [&names](const std::string& one)
      { return std::find(names.begin(), names.end(), one) != names.end(); });
  };
  const bool media = needs(
    { "medium_gain", "specular_component", "interreflection", "translucency", "fluorescence" });
  const RealSamples real = drawSamples(random, source, media);
  const Eigen::Index S = real.reflectance.cols();
  std::vector<double> order(static_cast<std::size_t>(S));
  std::iota(order.begin(), order.end(), 1.0);
  std::shuffle(order.begin(), order.end(), random);

  const RealSite site(real, order);
  Key key;
  key.set = request.set;
  key.effects = request.stranger.empty() ? request.effects : std::vector<std::string>{ "?" };
  key.without = request.without;
  key.twin = request.twin;
  std::vector<RealFault> faults;
  for (const std::string& name : request.effects)
  {
    faults.push_back(drawRealFault(name, random, site));
    for (const std::string& axis : axesOf(name, media))
    {
      key.axes.push_back(axis);
    }
  }
  if (!request.stranger.empty())
  {
    faults.push_back(drawRealStranger(request.stranger, random, site));
  }
  std::vector<double> sizes;
  for (const RealFault& fault : faults)
  {
    key.kinds.push_back(fault.kind);
    const double target = around(random, source == Source::Chart ? 0.03 : 0.014, 1.6);
    double low = 1e-3;
    double high = 30.0;
    for (int round = 0; round < 16; ++round)
    {
      const double size = std::sqrt(low * high);
      (rms(fault.apply(real.answers[0], size) - real.answers[0]) < target ? low : high) = size;
    }
    sizes.push_back(std::sqrt(low * high));
  }
  // In the order of the light's way.
  std::vector<std::size_t> way(faults.size());
  std::iota(way.begin(), way.end(), 0);
  std::stable_sort(way.begin(), way.end(),
    [&faults](std::size_t a, std::size_t b) { return faults[a].stage < faults[b].stage; });
  std::vector<Eigen::MatrixXd> readings;
  for (const Eigen::MatrixXd& answer : real.answers)
  {
    Eigen::MatrixXd u = answer;
    for (const std::size_t f : way)
    {
      u = faults[f].apply(u, sizes[f]);
    }
    readings.push_back(u);
  }
  const double base = rms(real.answers[0] - real.simulated());
  key.gapRms = rms(readings[0] - real.simulated());
  key.bestShrink = faults.empty() ? 1.0 : std::max(0.0, 1.0 - base / key.gapRms);

  Capture capture;
  capture.noiseKnown = false;
  const bool noisy = needs({ "excess_noise" });
  if (source != Source::Chart && (noisy || chance(random, 0.5)))
  {
    // Camera noise of a known model, on repeats.
    capture.noiseKnown = true;
    capture.read = around(random, 0.0007, 1.5);
    capture.shot = around(random, 0.0012, 1.5);
    const Eigen::MatrixXd truth = readings[0];
    readings.assign(3, truth);
    const double factor = noisy ? uniform(random, 2.0, 3.0) : 1.0;
    for (Eigen::MatrixXd& reading : readings)
    {
      for (double& u : reading.reshaped())
      {
        u += normal(random,
          factor *
            std::sqrt(
              capture.read * capture.read + capture.shot * capture.shot * std::max(u, 0.0)));
      }
    }
  }
  if (careless)
  {
    const int last = static_cast<int>(S) - 1;
    const int first = integer(random, 0, last);
    const int second = integer(random, 0, last);
    for (Eigen::MatrixXd& reading : readings)
    {
      spoil(reading, random);
      reading.col(first).swap(reading.col(second)); // labels exchanged
    }
  }
  capture.repeats = static_cast<int>(readings.size());
  capture.cameraWavelengths = real.cameraWavelengths;
  for (Eigen::Index w = 0; w < real.camera.cols(); ++w)
  {
    capture.camera.emplace_back(real.camera.col(w).begin(), real.camera.col(w).end());
  }
  capture.sampleWavelengths = real.wavelengths;
  capture.dark.assign(real.dark.begin(), real.dark.end());
  for (Eigen::Index i = 0; i < S; ++i)
  {
    capture.samples.push_back({ real.medium[static_cast<std::size_t>(i)], "one", real.x[i],
      real.y[i], order[static_cast<std::size_t>(i)],
      std::vector<double>(real.reflectance.col(i).begin(), real.reflectance.col(i).end()) });
    for (const Eigen::MatrixXd& reading : readings)
    {
      capture.readings.emplace_back(reading.col(i).begin(), reading.col(i).end());
    }
  }
  return writer.add(capture, key);
}

void writeCases(
  CaseWriter& writer, Source source, bool full, std::uint64_t seed, bool careless = false)
{
  if (!haveRealSamples())
  {
    return;
  }
  Random random(seed * 32452843 + static_cast<std::uint64_t>(source));
  std::vector<std::string> names = realFaultNames();
  if (source == Source::Chart)
  {
    // One medium, and its readings are no repeats of one pixel.
    const auto media = std::find(names.begin(), names.end(), "medium_gain");
    names.erase(media, names.end());
  }
  for (const std::string& name : names)
  {
    for (int n = 0; n < (full ? 2 : 1); ++n)
    {
      const std::uint64_t own = random();
      const std::string twin =
        write(writer, source, careless, { "single", { name }, "", "", "" }, own);
      if (full && n == 0)
      {
        write(writer, source, careless, { "removed", { name }, "", name, twin }, own);
      }
    }
  }
  for (int n = 0; n < (full ? 16 : 3); ++n)
  {
    write(writer, source, careless, { "several", someOf(random, names, 2), "", "", "" }, random());
  }
  for (int n = 0; n < (full ? 8 : 2); ++n)
  {
    write(writer, source, careless, { "clean", {}, "", "", "" }, random());
  }
  for (std::size_t n = 0; n < (full ? 10 : 2); ++n)
  {
    write(writer, source, careless,
      { "stranger", {}, realStrangerNames()[n % realStrangerNames().size()], "", "" }, random());
  }
}
}

void writeRawCases(CaseWriter& writer, bool full, std::uint64_t seed)
{
  writeCases(writer, Source::Raw, full, seed);
}

void writeLinearisedCases(CaseWriter& writer, bool full, std::uint64_t seed)
{
  writeCases(writer, Source::Linearised, full, seed);
}

void writeCarelessCases(CaseWriter& writer, bool full, std::uint64_t seed)
{
  writeCases(writer, Source::Linearised, full, seed, true);
}

void writeRidgeCases(CaseWriter& writer, bool full, std::uint64_t seed)
{
  writeCases(writer, Source::Ridge, full, seed);
}

void writeChartCases(CaseWriter& writer, bool full, std::uint64_t seed)
{
  writeCases(writer, Source::Chart, full, seed);
}

} // namespace withheld
