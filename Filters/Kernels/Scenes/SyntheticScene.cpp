#include "Kernels/Scenes/SyntheticScene.h"

#include "Kernels/Numerics/CounterRandom.h"
#include "Kernels/Scenes/KubelkaMunk.h"
#include "Kernels/Scenes/Measuring.h"
#include "Kernels/Scenes/Samples.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <cmath>

namespace msi::scenes
{

namespace
{
constexpr std::uint32_t MottleStream = 51;
constexpr double Mottle = 0.006; // relative standard deviation of paper from pixel to pixel

// What weaveOf() gives on average.
constexpr double UsualYarnWidth = 4.4;
constexpr double UsualInterreflection = Weave{}.meanCavity;

constexpr int SwatchColumns = 6;
constexpr int SwatchRows = 4;

void requireRange(
  const char* name, double value, double lowest, double highest, const char* unit = "")
{
  if (!(value >= lowest && value <= highest))
  {
    reject("the scene's ", name, " is ", value, unit, "; expected a value from ", lowest, " to ",
      highest);
  }
}

// The largest pitch that puts columns x rows patches and a frame of a quarter patch into the picture.
int pitchFor(int columns, int rows, int least, const SceneOptions& options)
{
  const int pitch =
    std::min(2 * options.width / (2 * columns + 1), 2 * options.height / (2 * rows + 1));
  if (pitch < least)
  {
    reject("the scene has ", options.width, " x ", options.height, " pixels; ", columns, " x ",
      rows, " patches need at least ", (least * (2 * columns + 1) + 1) / 2, " x ",
      (least * (2 * rows + 1) + 1) / 2);
  }
  return pitch;
}

PatchLayout centered(PatchLayout layout, const SceneOptions& options)
{
  layout.width = options.width;
  layout.height = options.height;
  layout.left = (options.width - (layout.columns - 1) * layout.pitch - layout.patchWidth) / 2;
  layout.top = (options.height - (layout.rows - 1) * layout.pitch - layout.patchHeight) / 2;
  return layout;
}

PatchLayout layoutOf(const SceneOptions& options)
{
  if (options.subject == SceneSubject::Fabric)
  {
    constexpr int Least = 16;
    const int pitch = pitchFor(SwatchColumns, SwatchRows, Least, options);
    return centered(
      { SwatchColumns, SwatchRows, 0, 0, pitch, 34 * pitch / 42, 38 * pitch / 42, 0, 0 }, options);
  }
  constexpr int Least = 6;
  const int patches = options.subject == SceneSubject::Chart24 ? 24 : 140;
  const PatchLayout usual = chartLayout(patches);
  return centered(
    chartLayout(patches, pitchFor(usual.columns, usual.rows, Least, options)), options);
}

const SceneOptions& checked(const SceneOptions& options, const WavelengthGrid& wavelengths)
{
  constexpr double Shortest = 360.0;
  constexpr double Longest = 780.0;
  requireRange("texture", options.texture, 0.0, 3.0);
  requireRange("interreflection", options.interreflection, 0.0, 0.5);
  requireRange("yarn width", options.yarnWidth, 2.0, 64.0, " pixels");
  requireRange("first wavelength", wavelengths.front(), Shortest, Longest, " nm");
  requireRange("last wavelength", wavelengths.back(), Shortest, Longest, " nm");
  return options;
}
}

SyntheticScene::SyntheticScene(const WavelengthGrid& wavelengths, const SceneOptions& options)
  : Wavelengths(wavelengths)
  , Layout(layoutOf(checked(options, wavelengths)))
  , Inside(std::max(2, Layout.pitch / 16))
  , Seed(options.seed)
  , Texture(options.texture)
{
  PatchMeans.resize(wavelengths.size(), Layout.count());
  if (options.subject == SceneSubject::Fabric)
  {
    Swatches swatches = dyedFabric(wavelengths, Layout.count(), Seed);
    Samples = std::move(swatches.name);
    WeaveChange change;
    change.yarnWidth = options.yarnWidth / UsualYarnWidth;
    change.texture = options.texture;
    change.cavity = options.interreflection / UsualInterreflection;
    Book.emplace(Layout, std::move(swatches.body), tartanYarns(wavelengths), Seed, change);
    for (Eigen::Index patch = 0; patch < PatchMeans.cols(); ++patch)
    {
      PatchMeans.col(patch) = Book->meanSeen(static_cast<int>(patch) + 1);
    }
    return;
  }
  Swatches chart = printedChart(wavelengths, Layout.count(), Seed);
  Samples = std::move(chart.name);
  for (Eigen::Index patch = 0; patch < PatchMeans.cols(); ++patch)
  {
    PatchMeans.col(patch) = paperTowardsCamera(chart.body.col(patch).array());
  }
  // Between the two darkest greys.
  const Eigen::Index black = Layout.count() == 24 ? 5 : 13;
  Frame = 0.5 * (PatchMeans.col(black - 1) + PatchMeans.col(black));
}

int SyntheticScene::label(int x, int y) const noexcept
{
  const PatchLayout::Place place = Layout.placeOf(x, y);
  return place.border >= Inside ? place.patch : 0;
}

void SyntheticScene::reflectance(int x, int y, int count, float* values) const
{
  const CounterRandom mottle(Seed, MottleStream);
  const Eigen::Index bands = Wavelengths.size();
  for (int i = 0; i < count; ++i, values += bands)
  {
    Eigen::Map<Eigen::ArrayXf> pixel(values, bands);
    if (Book)
    {
      pixel = Book->seen(x + i, y).cast<float>();
      continue;
    }
    const int patch = Layout.placeOf(x + i, y).patch;
    double factor = 1.0;
    if (Texture > 0.0)
    {
      const auto place = (static_cast<std::uint64_t>(static_cast<std::uint32_t>(y)) << 32) |
        static_cast<std::uint32_t>(x + i);
      factor += Texture * Mottle * mottle.normal(place);
    }
    pixel = (factor * (patch > 0 ? PatchMeans.col(patch - 1).array() : Frame)).cast<float>();
  }
}

} // namespace msi::scenes
