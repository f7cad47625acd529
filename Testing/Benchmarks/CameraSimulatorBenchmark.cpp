// Camera simulation of a 2048 x 2048 image, 31 wavelengths to 16 channels, one thread, single precision.
//
// The memcpy beside it moves the same bytes (reflectance in, response out); CameraSimulatorPeer.py does the same
// work in NumPy. `BenchmarkCameraSimulator --results FOLDER SIDE` writes what both must agree on for a square image:
// NAME.responsivity (K x N) and NAME.response, without noise, single precision.
#include "Kernels/Camera/CameraDesign.h"
#include "Kernels/Camera/CameraSimulator.h"
#include "Kernels/Camera/Imaging/ImageSimulator.h"

#include <benchmark/benchmark.h>

#include <cstring>
#include <fstream>
#include <string>
#include <utility>
#include <vector>

namespace
{
msi::ImageExtent Extent{ 2048, 2048 };
constexpr int Wavelengths = 31;
constexpr int Channels = 16;
msi::CameraModel sixteenChannels()
{
  const auto grid = msi::WavelengthGrid::uniform(400.0, 700.0, 10.0);
  msi::CameraParts parts;
  parts.light = msi::planckianLight(grid, 2900.0);
  parts.detector = msi::siliconDetector(grid);
  for (int k = 0; k < Channels; ++k)
  {
    parts.filters.push_back({ 400.0 + 20.0 * k, 20.0 });
  }
  return msi::designCamera(grid, parts);
}

const std::vector<float>& reflectance()
{
  static const std::vector<float> values = []
  {
    std::vector<float> image(msi::wholeImage(Extent).pixels() * Wavelengths);
    for (std::size_t i = 0; i < image.size(); ++i)
    {
      image[i] = 0.05F + 0.9F * static_cast<float>((i * 2654435761U) % 1024U) / 1024.0F;
    }
    return image;
  }();
  return values;
}

const std::vector<int>& media()
{
  static const std::vector<int> values = []
  {
    std::vector<int> image(msi::wholeImage(Extent).pixels());
    for (std::size_t i = 0; i < image.size(); ++i)
    {
      image[i] = static_cast<int>(i / 1024 % 2);
    }
    return image;
  }();
  return values;
}

std::vector<float>& response()
{
  static std::vector<float> values(msi::wholeImage(Extent).pixels() * Channels);
  return values;
}

msi::CameraEffect perChannel(const char* name, const char* form, double first, double step)
{
  msi::CameraEffect effect{ name, form, "", {} };
  for (int k = 0; k < Channels; ++k)
  {
    effect.parameters.push_back(first + step * k);
  }
  return effect;
}

std::vector<msi::CameraEffect> pixelEffects()
{
  return { { "specular_component", "", "paper", { 0.02 } },
    { "translucency", "", "fabric", { 0.1, 2.0 } },
    { "fluorescence", "", "paper", { 0.05, 440.0, 18.0 } },
    { "interreflection", "", "fabric", { 0.2 } }, { "medium_gain", "", "fabric", { 0.9 } },
    { "filter_shift", "", "", { 2.0 } }, { "filter_bandwidth", "", "", { 1.2 } },
    { "filter_leak", "", "", { 0.01, 0.2, 0.0, 0.0 } }, { "illuminant_drift", "", "", { 0.05 } },
    { "illumination_gradient", "", "", { 0.05, -0.02 } },
    { "vignetting", "", "", { 0.1, 0.0, 0.0 } }, { "exposure_gain", "", "", { 1.02 } },
    perChannel("channel_gain", "", 0.98, 0.002), { "channel_crosstalk", "", "", { 0.01, 0.0 } },
    { "detector_nonlinearity", "", "", { -0.05 } }, { "dark_offset", "", "", { 0.003 } },
    { "saturation", "", "", { 0.95, 0.01 } }, { "lag", "", "", { 0.02 } },
    { "banding", "", "", { 0.01, 64.0, 0.25 } } };
}

std::vector<msi::CameraEffect> everyEffect()
{
  std::vector<msi::CameraEffect> effects = pixelEffects();
  effects.push_back({ "veiling_glare", "", "", { 0.02 } });
  effects.push_back({ "local_stray_light", "", "", { 0.05, 8.0 } });
  effects.push_back(perChannel("defocus", "per_channel", 0.3, 0.05));
  msi::CameraEffect registration = perChannel("misregistration", "", -0.8, 0.1);
  registration.parameters.resize(3 * Channels, 0.001);
  registration.parameters.resize(4 * Channels, 0.0); // the peer turns no channel
  effects.push_back(registration);
  effects.push_back({ "excess_noise", "", "", { 1.2 } });
  return effects;
}

msi::ImageSimulatorOptions withNoise(bool noisy)
{
  msi::ImageSimulatorOptions options;
  options.media = { "paper", "fabric" };
  if (noisy)
  {
    options.noise.read = 0.001;
    options.noise.shot = 0.004;
    options.noise.fixedPatternGain = 0.002;
    options.noise.fixedPatternOffset = 0.0005;
    options.noise.quantisationStep = 1.0 / 4095.0;
  }
  return options;
}

void run(const msi::ImageSimulator& simulator, msi::ImageWorkspace& workspace)
{
  msi::SceneMean mean(Channels);
  const msi::ImageWindow all = msi::wholeImage(Extent);
  if (simulator.needsSceneMean())
  {
    simulator.addToMean(reflectance().data(), media().data(), all, mean, workspace);
  }
  simulator.simulate(
    reflectance().data(), media().data(), all, all, &mean, response().data(), workspace);
}

void simulate(benchmark::State& state, std::vector<msi::CameraEffect> effects, bool noisy)
{
  const msi::ImageSimulator simulator(
    sixteenChannels(), std::move(effects), Extent, withNoise(noisy));
  msi::ImageWorkspace workspace;
  run(simulator, workspace); // the pages of the images are there, as they are for the copy
  for (auto _ : state)
  {
    run(simulator, workspace);
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(
    state.iterations() * static_cast<std::int64_t>(msi::wholeImage(Extent).pixels()));
}

void copyTheSameBytes(benchmark::State& state)
{
  std::vector<float> copyIn(reflectance().size());
  std::vector<float> copyOut(response().size());
  for (auto _ : state)
  {
    std::memcpy(copyIn.data(), reflectance().data(), copyIn.size() * sizeof(float));
    std::memcpy(copyOut.data(), response().data(), copyOut.size() * sizeof(float));
    benchmark::ClobberMemory();
  }
  state.SetItemsProcessed(
    state.iterations() * static_cast<std::int64_t>(msi::wholeImage(Extent).pixels()));
}
}

BENCHMARK(copyTheSameBytes)->Name("camera/memcpy")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulate, ideal, {}, false)->Name("camera/ideal")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulate, noise, {}, true)->Name("camera/noise")->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulate, pixel, pixelEffects(), false)
  ->Name("camera/pixel_effects")
  ->Unit(benchmark::kMillisecond);
BENCHMARK_CAPTURE(simulate, all, everyEffect(), true)
  ->Name("camera/all_effects_and_noise")
  ->Unit(benchmark::kMillisecond);

namespace
{
void write(const std::string& file, const void* values, std::size_t bytes)
{
  std::ofstream(file, std::ios::binary)
    .write(static_cast<const char*>(values), static_cast<std::streamsize>(bytes));
}

void writeResults(const std::string& folder, int side)
{
  Extent = { side, side };
  const std::vector<std::pair<const char*, std::vector<msi::CameraEffect>>> jobs = {
    { "ideal", {} }, { "pixel_effects", pixelEffects() }, { "all_effects", everyEffect() }
  };
  for (const auto& [name, effects] : jobs)
  {
    msi::ImageWorkspace workspace;
    run(msi::ImageSimulator(sixteenChannels(), effects, Extent, withNoise(false)), workspace);
    const msi::CameraSimulator camera(sixteenChannels(), effects);
    const Eigen::MatrixXf responsivity = camera.effectiveResponsivity().transpose().cast<float>();
    write(folder + "/" + name + ".responsivity", responsivity.data(),
      static_cast<std::size_t>(responsivity.size()) * sizeof(float));
    write(folder + "/" + name + ".response", response().data(), response().size() * sizeof(float));
  }
}
}

int main(int argc, char** argv)
{
  if (argc == 4 && std::string(argv[1]) == "--results")
  {
    writeResults(argv[2], std::stoi(argv[3]));
    return 0;
  }
  benchmark::Initialize(&argc, argv);
  benchmark::RunSpecifiedBenchmarks();
  return 0;
}
