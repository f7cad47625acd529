#include "Kernels/Scenes/KubelkaMunk.h"
#include "Kernels/Scenes/Measuring.h"
#include "Kernels/Scenes/Samples.h"
#include "Kernels/Scenes/SyntheticScene.h"

#include <gtest/gtest.h>

#include <cmath>
#include <stdexcept>
#include <vector>

namespace
{
namespace scenes = msi::scenes;
using scenes::SceneOptions;
using scenes::SceneSubject;
using scenes::SyntheticScene;

msi::WavelengthGrid grid()
{
  return msi::WavelengthGrid::uniform(400.0, 700.0, 20.0);
}

SceneOptions optionsOf(SceneSubject subject, int width, int height)
{
  SceneOptions options;
  options.subject = subject;
  options.width = width;
  options.height = height;
  options.seed = 7;
  return options;
}

// Per patch the mean of its labelled pixels, N x P, and their number.
struct PatchMeans
{
  Eigen::MatrixXd mean;
  Eigen::VectorXi pixels;
};

PatchMeans meansOf(const SyntheticScene& scene)
{
  const Eigen::Index bands = scene.wavelengths().size();
  const Eigen::Index patches = scene.layout().count();
  PatchMeans result{ Eigen::MatrixXd::Zero(bands, patches), Eigen::VectorXi::Zero(patches) };
  std::vector<float> row(static_cast<std::size_t>(scene.layout().width * bands));
  for (int y = 0; y < scene.layout().height; ++y)
  {
    scene.reflectance(0, y, scene.layout().width, row.data());
    const Eigen::Map<const Eigen::MatrixXf> pixels(row.data(), bands, scene.layout().width);
    for (int x = 0; x < scene.layout().width; ++x)
    {
      if (const int label = scene.label(x, y); label > 0)
      {
        result.mean.col(label - 1) += pixels.col(x).cast<double>();
        ++result.pixels[label - 1];
      }
    }
  }
  result.mean.array().rowwise() /= result.pixels.cast<double>().transpose().array();
  return result;
}

std::string messageOf(const SceneOptions& options, const msi::WavelengthGrid& wavelengths = grid())
{
  try
  {
    SyntheticScene scene(wavelengths, options);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return "no error";
}

TEST(SyntheticScene, WithoutTextureEveryPixelOfAChartIsItsTableRow)
{
  for (const SceneSubject subject : { SceneSubject::Chart24, SceneSubject::Chart140 })
  {
    SceneOptions options = optionsOf(subject, 300, 220);
    options.texture = 0.0;
    const SyntheticScene scene(grid(), options);
    std::vector<float> pixel(static_cast<std::size_t>(grid().size()));
    for (int y = 0; y < options.height; y += 3)
    {
      for (int x = 0; x < options.width; x += 2)
      {
        if (const int label = scene.label(x, y); label > 0)
        {
          scene.reflectance(x, y, 1, pixel.data());
          for (Eigen::Index j = 0; j < grid().size(); ++j)
          {
            ASSERT_EQ(pixel[static_cast<std::size_t>(j)],
              static_cast<float>(scene.patchReflectance()(j, label - 1)));
          }
        }
      }
    }
  }
}

// R = 1 + q - sqrt(q^2 + 2 q) of the sheet, through a surface of 4 % outside, 45 % inside, of which 35 % is seen.
TEST(SyntheticScene, TheFirstPatchIsThePaperByKubelkaMunkAndSaunderson)
{
  const SyntheticScene scene(grid(), optionsOf(SceneSubject::Chart24, 300, 220));
  for (Eigen::Index j = 0; j < grid().size(); ++j)
  {
    const double q = 0.0055 + 0.12 * std::exp((380.0 - grid()[j]) / 22.0);
    const double body = 1.0 + q - std::sqrt(q * q + 2.0 * q);
    const double expected = 0.35 * 0.04 + 0.96 * 0.55 * body / (1.0 - 0.45 * body);
    EXPECT_NEAR(scene.patchReflectance()(j, 0), expected, 1e-14);
  }
}

TEST(SyntheticScene, MeanOfAPatchIsItsTableRow)
{
  const SyntheticScene chart(grid(), optionsOf(SceneSubject::Chart24, 400, 300));
  const PatchMeans means = meansOf(chart);
  EXPECT_GT(means.pixels.minCoeff(), 1500);
  for (Eigen::Index patch = 0; patch < means.mean.cols(); ++patch)
  {
    // The mottle has a standard deviation of 0.6 %; five standard errors.
    const double margin = 5.0 * 0.006 / std::sqrt(double(means.pixels[patch]));
    EXPECT_LT((means.mean.col(patch).array() / chart.patchReflectance().col(patch).array() - 1.0)
                .abs()
                .maxCoeff(),
      margin);
  }
}

TEST(SyntheticScene, MeanOfASwatchIsItsTableRowWithinTheScatterOfItsYarns)
{
  const SyntheticScene fabric(grid(), optionsOf(SceneSubject::Fabric, 900, 640));
  const PatchMeans means = meansOf(fabric);
  const Eigen::ArrayXXd ratio = means.mean.array() / fabric.patchReflectance().array() - 1.0;
  // About 25 yarns each way with a standard deviation of 2.5 %: 0.5 % a swatch; five of them, and 1 % for pixels
  // that sample a yarn's back but four times.
  EXPECT_LT(ratio.abs().maxCoeff(), 0.035);
  EXPECT_LT(std::abs(ratio.mean()), 0.01);
}

// Without relief all points see the same light: shade r (1 - p) / (1 - p r), in the limit p = 0 shade r.
TEST(SyntheticScene, FlatFabricIsTheClosedFormOfInterreflection)
{
  const Eigen::MatrixXd body = scenes::dyedFabric(grid(), 24, 7).body;
  for (const double probability : { 0.0, 0.3 })
  {
    SceneOptions options = optionsOf(SceneSubject::Fabric, 300, 220);
    options.texture = 0.0;
    options.interreflection = probability;
    const SyntheticScene scene(grid(), options);
    for (int patch = 0; patch < 24; ++patch)
    {
      const scenes::Weave weave = scenes::weaveOf(patch, 7);
      const double p = weave.meanCavity * probability / 0.16;
      const Eigen::ArrayXd r = body.col(patch).array();
      const Eigen::ArrayXd expected = 0.012 + weave.meanShade * r * (1.0 - p) / (1.0 - p * r);
      EXPECT_LT((scene.patchReflectance().col(patch).array() - expected).abs().maxCoeff(), 1e-13);
      const auto& layout = scene.layout();
      const int x = layout.left + patch % 6 * layout.pitch + 11;
      const int y = layout.top + patch / 6 * layout.pitch + 9;
      ASSERT_EQ(scene.label(x, y), patch + 1);
      std::vector<float> pixel(static_cast<std::size_t>(grid().size()));
      scene.reflectance(x, y, 1, pixel.data());
      const Eigen::Map<const Eigen::ArrayXf> seen(pixel.data(), grid().size());
      EXPECT_LT((seen.cast<double>() - expected).abs().maxCoeff(), 1e-7);
    }
  }
}

// Light that strikes again is absorbed once more: dark colours lose more of it than pale ones.
TEST(SyntheticScene, InterreflectionDeepensColours)
{
  SceneOptions options = optionsOf(SceneSubject::Fabric, 300, 220);
  options.interreflection = 0.0;
  const Eigen::MatrixXd without = SyntheticScene(grid(), options).patchReflectance();
  options.interreflection = 0.3;
  const Eigen::MatrixXd with = SyntheticScene(grid(), options).patchReflectance();
  Eigen::Index row = 0;
  Eigen::Index column = 0;
  const double high = without.maxCoeff(&row, &column);
  const double paleLoss = 1.0 - with(row, column) / high;
  const double low = without.minCoeff(&row, &column);
  const double darkLoss = 1.0 - with(row, column) / low;
  EXPECT_GT(paleLoss, 0.0);
  EXPECT_GT(darkLoss, paleLoss);
}

TEST(SyntheticScene, PatchesFillAnyPictureAndNoPieceChangesABit)
{
  for (const SceneSubject subject :
    { SceneSubject::Chart24, SceneSubject::Chart140, SceneSubject::Fabric })
  {
    for (const auto& [width, height] : { std::pair{ 300, 220 }, std::pair{ 220, 700 } })
    {
      const SyntheticScene scene(grid(), optionsOf(subject, width, height));
      EXPECT_EQ(static_cast<int>(scene.samples().size()), scene.layout().count());
      const PatchMeans means = meansOf(scene);
      EXPECT_GT(means.pixels.minCoeff(), 20);
      EXPECT_EQ(means.pixels.minCoeff(), means.pixels.maxCoeff());
    }
    const SyntheticScene scene(grid(), optionsOf(subject, 300, 220));
    const auto bands = static_cast<std::size_t>(grid().size());
    std::vector<float> row(300 * bands);
    scene.reflectance(0, 50, 300, row.data());
    std::vector<float> piece(7 * bands);
    scene.reflectance(33, 50, 7, piece.data());
    EXPECT_TRUE(
      std::equal(piece.begin(), piece.end(), row.begin() + 33 * static_cast<long>(bands)));
  }
}

TEST(SyntheticScene, TheSeedChangesDyesAndTexture)
{
  SceneOptions options = optionsOf(SceneSubject::Fabric, 300, 220);
  const Eigen::MatrixXd first = SyntheticScene(grid(), options).patchReflectance();
  EXPECT_EQ(SyntheticScene(grid(), options).patchReflectance(), first);
  options.seed = 8;
  EXPECT_GT(
    (SyntheticScene(grid(), options).patchReflectance() - first).cwiseAbs().maxCoeff(), 0.1);
}

TEST(SyntheticScene, RefusesWhatItCannotDrawAndSaysWhy)
{
  EXPECT_EQ(messageOf(optionsOf(SceneSubject::Chart140, 40, 400)),
    "the scene has 40 x 400 pixels; 14 x 10 patches need at least 87 x 63");
  EXPECT_EQ(messageOf(optionsOf(SceneSubject::Fabric, 300, 0)),
    "the scene has 300 x 0 pixels; 6 x 4 patches need at least 104 x 72");
  SceneOptions options;
  options.interreflection = 0.7;
  EXPECT_EQ(
    messageOf(options), "the scene's interreflection is 0.7; expected a value from 0 to 0.5");
  options = {};
  options.texture = std::nan("");
  EXPECT_EQ(messageOf(options), "the scene's texture is nan; expected a value from 0 to 3");
  EXPECT_EQ(messageOf({}, msi::WavelengthGrid::uniform(300.0, 700.0, 10.0)),
    "the scene's first wavelength is 300 nm; expected a value from 360 to 780");
}

}
