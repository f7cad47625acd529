// Writes the embedded demo data: GenerateDemoData <Data folder>.
//
// Everything is computed from the seeds below; the same build gives the same bytes.
#include "DemoCamera.h"
#include "DemoCapture.h"
#include "Files.h"
#include "Kernels/Scenes/Measuring.h"
#include "Kernels/Scenes/SampleBook.h"
#include "Kernels/Scenes/Samples.h"

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraNoise.h"

#include <cmath>
#include <cstdio>
#include <exception>
#include <filesystem>
#include <fstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{
namespace scenes = msi::scenes;

constexpr int ChartPatches = 140;
constexpr int FabricSamples = 120;
constexpr std::uint64_t ChartSeed = 1401;
constexpr std::uint64_t FabricSeed = 1207;
constexpr std::uint64_t BookSeed = 2404;
constexpr scenes::PatchLayout BookLayout{ 6, 4, 6, 13, 42, 34, 38, 256, 192 };

// 12-bit camera: dark level and the counts of a perfect white in the middle of the field.
constexpr double DarkCounts = 96.0;
constexpr double WhiteCounts = 3200.0;
constexpr double FullScale = 4095.0;

Eigen::MatrixXd responses(const Eigen::MatrixXd& seen, std::uint64_t seed)
{
  Eigen::MatrixXd response = msi::cameraResponse(scenes::demoCamera())(seen);
  msi::NoiseGenerator{ scenes::patchNoise(), seed }(response, 0);
  return response;
}

void writeSamples(const std::filesystem::path& file, const scenes::Swatches& swatches,
  const char* medium, const Eigen::MatrixXd& reflectance, const Eigen::MatrixXd& response)
{
  const auto channels = msi::WavelengthGrid::uniform(400.0, 700.0, 20.0);
  scenes::writeTable(file,
    { { "sample", swatches.name },
      { "medium", std::vector<std::string>(swatches.name.size(), medium) } },
    { { scenes::wavelengthNames("R", scenes::reportGrid()), reflectance, 4 },
      { scenes::wavelengthNames("C", channels), response, 5 } });
}

scenes::CountImage counts(const Eigen::MatrixXd& signal, Eigen::Index channel)
{
  scenes::CountImage image(BookLayout.height, BookLayout.width);
  for (Eigen::Index y = 0; y < image.rows(); ++y)
  {
    for (Eigen::Index x = 0; x < image.cols(); ++x)
    {
      const double value = DarkCounts + WhiteCounts * signal(channel, y * image.cols() + x);
      image(y, x) =
        static_cast<std::uint16_t>(std::lround(std::fmin(std::fmax(value, 0.0), FullScale)));
    }
  }
  return image;
}

void writeChannels(const std::filesystem::path& folder, const msi::CameraModel& camera,
  const Eigen::MatrixXd& signal)
{
  std::filesystem::create_directories(folder);
  for (Eigen::Index k = 0; k < camera.channelCount(); ++k)
  {
    const std::string& name = camera.channels()[static_cast<std::size_t>(k)];
    scenes::writeTiff(folder / ("channel_" + name + ".tif"), counts(signal, k));
  }
}

// Light on the sample book relative to the middle of the field: lamp to the left, vignetting lens.
double light(int x, int y) noexcept
{
  const double u = (x - 0.5 * BookLayout.width) / (0.5 * BookLayout.width);
  const double v = (y - 0.5 * BookLayout.height) / (0.5 * BookLayout.width);
  return (1.0 - 0.07 * u + 0.02 * v) * (1.0 - 0.06 * (u * u + v * v));
}

void writeSampleBook(const std::filesystem::path& folder)
{
  const msi::WavelengthGrid grid = scenes::sceneGrid();
  scenes::Swatches swatches = scenes::dyedFabric(grid, BookLayout.count(), BookSeed);
  const scenes::SampleBook book(BookLayout, swatches.body, scenes::tartanYarns(grid), BookSeed);

  const msi::CameraModel camera = scenes::demoCamera();
  const msi::AffineTransform respond = msi::cameraResponse(camera);
  constexpr Eigen::Index Pixels = Eigen::Index{ BookLayout.width } * BookLayout.height;
  Eigen::MatrixXd picture(camera.channelCount(), Pixels);
  Eigen::MatrixXd white(camera.channelCount(), Pixels);
  for (int y = 0; y < BookLayout.height; ++y)
  {
    for (int x = 0; x < BookLayout.width; ++x)
    {
      const Eigen::Index pixel = Eigen::Index{ y } * BookLayout.width + x;
      const Eigen::ArrayXd seen = book.seen(x, y);
      respond.apply(seen.data(), picture.col(pixel).data(), 1);
      picture.col(pixel) *= light(x, y);
      white.col(pixel).setConstant(light(x, y));
    }
  }
  Eigen::MatrixXd dark = Eigen::MatrixXd::Zero(camera.channelCount(), Pixels);

  // White and dark are means of many frames: the pattern of the detector remains, little else.
  msi::CameraNoise averaged = scenes::pixelNoise();
  averaged.read /= 8.0;
  averaged.shot /= 8.0;
  msi::NoiseGenerator{ scenes::pixelNoise(), BookSeed }(picture, 0, 0);
  msi::NoiseGenerator{ averaged, BookSeed }(white, 0, 1);
  msi::NoiseGenerator{ averaged, BookSeed }(dark, 0, 2);
  writeChannels(folder, camera, picture);
  writeChannels(folder / "white", camera, white);
  writeChannels(folder / "dark", camera, dark);

  scenes::writePng(folder / "labels.png", BookLayout.labels(2));
  std::vector<std::string> names;
  std::vector<std::string> labels;
  for (int i = 1; i <= BookLayout.count(); ++i)
  {
    labels.push_back(std::to_string(i));
    names.push_back((i < 10 ? "swatch-0" : "swatch-") + labels.back());
  }
  scenes::writeTable(folder / "patches.csv",
    { { "sample", names }, { "label", labels },
      { "medium", std::vector<std::string>(names.size(), "fabric") } },
    { { scenes::wavelengthNames("R", scenes::reportGrid()),
      scenes::measuredFabric(swatches.body, BookSeed), 4 } });
}

std::vector<std::string> numberTexts(const Eigen::VectorXd& values)
{
  std::vector<std::string> texts;
  for (const double value : values)
  {
    texts.push_back(std::to_string(std::lround(value)));
  }
  return texts;
}

void writeCapture(const std::filesystem::path& folder, const scenes::DemoCapture& capture)
{
  std::filesystem::create_directories(folder);
  const msi::CameraModel& camera = capture.camera;
  std::vector<std::string> channels;
  for (Eigen::Index k = 0; k < camera.channelCount(); ++k)
  {
    channels.push_back("C" + std::to_string(k + 1));
  }
  scenes::writeTable(folder / "camera.csv",
    { { "wavelength", numberTexts(camera.wavelengths().vector()) } },
    { { channels, camera.responsivity(), 7 } });
  scenes::writeTable(folder / "samples.csv",
    { { "sample", capture.sample }, { "medium", capture.medium }, { "x", numberTexts(capture.x) },
      { "y", numberTexts(capture.y) }, { "order", numberTexts(capture.order) } },
    { { scenes::wavelengthNames("R", capture.wavelengths), capture.reflectance, 4 } });
  scenes::writeTable(folder / "responses.csv",
    { { "sample", capture.readingSample }, { "repeat", capture.readingRepeat } },
    { { channels, capture.readings, 5 } });
  std::ofstream json(folder / "capture.json", std::ios::binary);
  json << "{\n  \"name\": \"Synthetic demo: a filter-wheel camera that warms up\",\n"
          "  \"white_level\": 1,\n  \"dark\": 0,\n  \"noise\": {\"read\": "
       << capture.noise.read << ", \"shot\": " << capture.noise.shot << "}\n}\n";
  if (!json.flush())
  {
    throw std::runtime_error("cannot write " + (folder / "capture.json").string());
  }
}

void generate(const std::filesystem::path& data)
{
  const msi::WavelengthGrid grid = scenes::sceneGrid();
  std::filesystem::create_directories(data / "Samples");
  const auto chart = scenes::printedChart(grid, ChartPatches, ChartSeed);
  writeSamples(data / "Samples" / "demo-chart.csv", chart, "paper",
    scenes::measuredPaper(chart.body, ChartSeed),
    responses(scenes::seenPaper(chart.body, ChartSeed), ChartSeed));
  const auto fabric = scenes::dyedFabric(grid, FabricSamples, FabricSeed);
  writeSamples(data / "Samples" / "demo-fabric.csv", fabric, "fabric",
    scenes::measuredFabric(fabric.body, FabricSeed),
    responses(scenes::seenFabric(fabric.body, FabricSeed), FabricSeed));
  writeSampleBook(data / "Images" / "demo-fabric");
  writeCapture(data / "Captures" / "demo-warm-camera", scenes::demoCapture());
}
}

int main(int argc, char** argv)
{
  if (argc != 2)
  {
    std::fputs("usage: GenerateDemoData <Data folder>\n", stderr);
    return 2;
  }
  try
  {
    generate(argv[1]);
  }
  catch (const std::exception& error)
  {
    std::fprintf(stderr, "GenerateDemoData: %s\n", error.what());
    return 1;
  }
  return 0;
}
