#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraTestData.h"
#include "Kernels/Camera/Imaging/ImageSimulator.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace
{
using msi::CameraEffect;
using msi::ImageExtent;
using msi::ImageSimulator;
using msi::ImageWindow;
using msi::test::messageOf;
using msi::test::sevenChannels;
using msi::test::visibleGrid;

constexpr ImageExtent Extent{ 97, 53 };
constexpr int Wavelengths = 31;
constexpr int Channels = 7;

// Edges and gradients in every band.
std::vector<float> reflectanceOf(const ImageWindow& window)
{
  std::vector<float> values;
  for (int y = window.y; y < window.y + window.height; ++y)
  {
    for (int x = window.x; x < window.x + window.width; ++x)
    {
      const bool bright = (x / 7 + y / 5) % 2 == 0;
      for (int j = 0; j < Wavelengths; ++j)
      {
        values.push_back(static_cast<float>(
          (bright ? 0.7 : 0.1) + 0.002 * x - 0.001 * y + 0.05 * std::sin(0.3 * j)));
      }
    }
  }
  return values;
}

std::vector<int> mediaOf(const ImageWindow& window)
{
  std::vector<int> values;
  for (int y = window.y; y < window.y + window.height; ++y)
  {
    for (int x = window.x; x < window.x + window.width; ++x)
    {
      values.push_back(x % 3 - 1); // none, paper, fabric
    }
  }
  return values;
}

std::vector<float> simulateWindow(const ImageSimulator& simulator, const ImageWindow& window,
  const msi::SceneMean* mean, int surplus = 0)
{
  const ImageWindow available = msi::grown(window, simulator.halo() + surplus, Extent);
  std::vector<float> response(window.pixels() * Channels);
  msi::ImageWorkspace workspace;
  simulator.simulate(reflectanceOf(available).data(), mediaOf(available).data(), available, window,
    mean, response.data(), workspace);
  return response;
}

msi::SceneMean meanOf(const ImageSimulator& simulator)
{
  msi::SceneMean mean(Channels);
  msi::ImageWorkspace workspace;
  const ImageWindow all = msi::wholeImage(Extent);
  simulator.addToMean(reflectanceOf(all).data(), mediaOf(all).data(), all, mean, workspace);
  return mean;
}

std::vector<float> simulateAll(
  std::vector<CameraEffect> effects, msi::ImageSimulatorOptions options = {})
{
  options.media = { "paper", "fabric" };
  const ImageSimulator simulator(sevenChannels(), std::move(effects), Extent, options);
  const msi::SceneMean mean = meanOf(simulator);
  return simulateWindow(simulator, msi::wholeImage(Extent), &mean);
}

float at(const std::vector<float>& image, int x, int y, int channel)
{
  return image[static_cast<std::size_t>((y * Extent.width + x) * Channels + channel)];
}

CameraEffect perChannel(const char* name, const char* form, double first, double step, int rest = 0)
{
  CameraEffect effect{ name, form, "", {} };
  for (int k = 0; k < Channels; ++k)
  {
    effect.parameters.push_back(first + step * k);
  }
  effect.parameters.resize(static_cast<std::size_t>(Channels + rest), 0.0);
  return effect;
}

CameraEffect misregistration(bool turned = false)
{
  CameraEffect effect = msi::neutralEffect("misregistration", sevenChannels().channels());
  for (std::size_t k = 0; k < Channels; ++k)
  {
    effect.parameters[k] = 0.3 * static_cast<double>(k) - 0.8;
    effect.parameters[Channels + k] = 0.5 - 0.2 * static_cast<double>(k);
    effect.parameters[2 * Channels + k] = 0.002 * static_cast<double>(k);
    effect.parameters[3 * Channels + k] = turned ? 0.2 * static_cast<double>(k) - 0.5 : 0.0;
  }
  return effect;
}

std::vector<CameraEffect> everything()
{
  return { { "specular_component", "", "paper", { 0.02 } },
    { "interreflection", "", "fabric", { 0.2 } }, { "translucency", "", "fabric", { 0.1, 2.0 } },
    { "fluorescence", "", "paper", { 0.05, 440.0, 18.0 } },
    { "medium_gain", "", "fabric", { 0.9 } }, { "filter_shift", "", "", { 2.0 } },
    { "filter_bandwidth", "", "", { 1.2 } }, { "filter_leak", "", "", { 0.01, 0.2, 0.0, 0.0 } },
    { "illuminant_drift", "", "", { 0.05 } }, { "illumination_gradient", "", "", { 0.05, -0.02 } },
    { "vignetting", "", "", { 0.1, 0.0, 0.0 } }, { "veiling_glare", "", "", { 0.02 } },
    { "local_stray_light", "", "", { 0.1, 2.0 } }, { "exposure_gain", "", "", { 1.02 } },
    perChannel("channel_gain", "", 0.98, 0.01), { "channel_crosstalk", "", "", { 0.01, 0.0 } },
    { "detector_nonlinearity", "gamma", "", { 1.05 } }, { "dark_offset", "", "", { 0.003 } },
    { "saturation", "", "", { 0.9, 0.02 } }, { "excess_noise", "", "", { 1.5 } }, misregistration(),
    perChannel("defocus", "per_channel", 0.0, 0.2), { "lag", "", "", { 0.02 } },
    { "banding", "", "", { 0.02, 11.0, 0.25 } } };
}

msi::ImageSimulatorOptions noisy()
{
  msi::ImageSimulatorOptions options;
  options.noise.read = 0.001;
  options.noise.shot = 0.004;
  options.noise.fixedPatternGain = 0.002;
  options.noise.fixedPatternOffset = 0.0005;
  options.noise.quantisationStep = 1.0 / 4095.0;
  options.media = { "paper", "fabric" };
  return options;
}

TEST(ImageSimulator, WithoutEffectsIsTheIdealCameraInSinglePrecision)
{
  const std::vector<float> reflectance = reflectanceOf(msi::wholeImage(Extent));
  std::vector<float> expected(msi::wholeImage(Extent).pixels() * Channels);
  msi::cameraResponse(sevenChannels())
    .apply(reflectance.data(), expected.data(), Extent.width * Extent.height);
  EXPECT_EQ(simulateAll({}), expected);
}

TEST(ImageSimulator, NeutralEffectsChangeNoBit)
{
  const std::vector<float> ideal = simulateAll({});
  for (const msi::EffectDefinition& effect : msi::effectLibrary())
  {
    if (effect.need != msi::EffectNeed::Order)
    {
      EXPECT_EQ(simulateAll({ msi::neutralEffect(effect.name, sevenChannels().channels(), {},
                  effect.need == msi::EffectNeed::Medium ? "fabric" : "") }),
        ideal)
        << effect.name;
    }
  }
}

TEST(ImageSimulator, EveryPieceGivesTheSameBytes)
{
  const ImageSimulator simulator(sevenChannels(), everything(), Extent, noisy());
  EXPECT_GT(simulator.halo(), 8);
  const msi::SceneMean mean = meanOf(simulator);
  const std::vector<float> whole = simulateWindow(simulator, msi::wholeImage(Extent), &mean);
  for (const ImageWindow& window : { ImageWindow{ 0, 0, 97, 20 }, ImageWindow{ 0, 20, 97, 33 },
         ImageWindow{ 31, 7, 1, 1 }, ImageWindow{ 40, 11, 57, 29 } })
  {
    for (const int surplus : { 0, 5 })
    {
      const std::vector<float> piece = simulateWindow(simulator, window, &mean, surplus);
      std::size_t different = 0;
      for (int y = 0; y < window.height; ++y)
      {
        for (int x = 0; x < window.width; ++x)
        {
          for (int k = 0; k < Channels; ++k)
          {
            const float here =
              piece[static_cast<std::size_t>((y * window.width + x) * Channels + k)];
            different += here == at(whole, window.x + x, window.y + y, k) ? 0 : 1;
          }
        }
      }
      EXPECT_EQ(different, 0U) << window.x << " " << window.y << " surplus " << surplus;
    }
  }
}

// The same effects on a table whose samples lie where the pixels lie.
TEST(ImageSimulator, AgreesWithTheSimulatorOfTables)
{
  const ImageWindow all = msi::wholeImage(Extent);
  const std::vector<float> reflectance = reflectanceOf(all);
  const std::vector<int> media = mediaOf(all);
  const auto pixels = static_cast<Eigen::Index>(all.pixels());
  msi::SceneSamples samples;
  samples.reflectance =
    Eigen::Map<const Eigen::MatrixXf>(reflectance.data(), Wavelengths, pixels).cast<double>();
  samples.x.resize(pixels);
  samples.y.resize(pixels);
  for (Eigen::Index i = 0; i < pixels; ++i)
  {
    samples.x[i] = static_cast<double>(i % Extent.width);
    samples.y[i] = static_cast<double>(i / Extent.width);
    const int medium = media[static_cast<std::size_t>(i)];
    samples.medium.push_back(medium < 0 ? "none" : medium == 0 ? "paper" : "fabric");
  }
  std::vector<CameraEffect> effects;
  for (const CameraEffect& effect : everything())
  {
    const msi::EffectStage stage = msi::findEffect(effect.name)->stage;
    if (stage != msi::EffectStage::Image && stage != msi::EffectStage::Noise &&
      effect.name != "local_stray_light")
    {
      effects.push_back(effect);
    }
  }
  const Eigen::MatrixXd table =
    msi::CameraSimulator(sevenChannels(), effects).respond({ visibleGrid(), samples });
  const std::vector<float> image = simulateAll(effects);
  const Eigen::Map<const Eigen::MatrixXf> seen(image.data(), Channels, pixels);
  EXPECT_LT((seen.cast<double>() - table).cwiseAbs().maxCoeff(), 3e-6);
}

// An even scene has neither edges nor a surround of its own: what spreads or moves light changes nothing, and the image
// answers as a sample of that reflectance on a table does.
TEST(ImageSimulator, AnEvenSceneAnswersAsItsSampleOnATable)
{
  const ImageWindow all = msi::wholeImage(Extent);
  Eigen::VectorXf reflectance(Wavelengths);
  for (int j = 0; j < Wavelengths; ++j)
  {
    reflectance[j] = static_cast<float>(0.4 + 0.3 * std::sin(0.2 * j));
  }
  const Eigen::MatrixXf pixels = reflectance.replicate(1, static_cast<Eigen::Index>(all.pixels()));
  const std::vector<int> media(all.pixels(), 1);
  std::vector<CameraEffect> effects;
  std::vector<CameraEffect> onTable;
  for (const CameraEffect& effect : everything())
  {
    const msi::EffectDefinition& definition = *msi::findEffect(effect.name);
    const bool overField = effect.name == "vignetting" || effect.name == "illumination_gradient";
    if (overField || effect.name == "lag" || effect.name == "banding")
    {
      continue;
    }
    effects.push_back(effect);
    if (definition.stage != msi::EffectStage::Image && effect.name != "local_stray_light")
    {
      onTable.push_back(effect);
    }
  }
  msi::ImageSimulatorOptions options;
  options.media = { "paper", "fabric" };
  const ImageSimulator simulator(sevenChannels(), effects, Extent, options);
  EXPECT_GT(simulator.halo(), 8);
  msi::SceneMean mean(Channels);
  msi::ImageWorkspace workspace;
  simulator.addToMean(pixels.data(), media.data(), all, mean, workspace);
  std::vector<float> response(all.pixels() * Channels);
  simulator.simulate(pixels.data(), media.data(), all, all, &mean, response.data(), workspace);

  msi::SceneSamples sample;
  sample.reflectance = reflectance.cast<double>();
  sample.medium = { "fabric" };
  const Eigen::MatrixXd table =
    msi::CameraSimulator(sevenChannels(), onTable).respond({ visibleGrid(), sample });
  const Eigen::Map<const Eigen::MatrixXf> seen(response.data(), Channels, pixels.cols());
  EXPECT_LT((seen.cast<double>().colwise() - table.col(0)).cwiseAbs().maxCoeff(), 3e-6);
}

// Effects on the detector are told the place of a pixel, too.
TEST(ImageSimulator, AnOffsetMayLeanOverTheField)
{
  const std::vector<float> before = simulateAll({});
  CameraEffect offset{ "dark_offset", "plane", "", std::vector<double>(3 * Channels, 0.0) };
  CameraEffect rest = msi::neutralEffect("unmodelled_response", sevenChannels().channels());
  offset.parameters[Channels] = 0.04;       // along x
  offset.parameters[2 * Channels] = -0.02;  // along y
  rest.parameters[3 * Channels + 1] = 0.05; // along x, in the second channel
  const std::vector<float> leaning = simulateAll({ offset, rest });
  for (const int x : { 0, 40, 96 })
  {
    for (const int y : { 3, 50 })
    {
      const float right = static_cast<float>(x - 48) / 48.0F;
      const float down = static_cast<float>(y - 26) / 48.0F;
      EXPECT_NEAR(at(leaning, x, y, 0), at(before, x, y, 0) + 0.04F * right - 0.02F * down, 1e-6);
      EXPECT_NEAR(at(leaning, x, y, 1), at(before, x, y, 1) * (1.0F + 0.05F * right), 1e-6);
      EXPECT_NEAR(at(leaning, x, y, 2), at(before, x, y, 2), 1e-6);
    }
  }
}

TEST(ImageSimulator, LagKeepsAPartOfTheChannelBefore)
{
  const msi::CameraModel camera = sevenChannels();
  const std::vector<float> ideal = simulateAll({});
  for (const char* form : { "common", "conserving" })
  {
    const std::vector<float> lagging = simulateAll({ { "lag", form, "", { 0.1 } } });
    const auto light = [&](int k)
    { return static_cast<double>(at(ideal, 20, 20, k)) - camera.dark()[k]; };
    for (int k = 1; k < Channels; ++k)
    {
      const double lost = std::string(form) == "conserving" ? light(k) : 0.0;
      EXPECT_NEAR(static_cast<double>(at(lagging, 20, 20, k) - at(ideal, 20, 20, k)),
        0.1 * (light(k - 1) - lost), 1e-6);
    }
    EXPECT_NEAR(
      static_cast<double>(at(lagging, 20, 20, 0)), static_cast<double>(at(ideal, 20, 20, 0)), 1e-6);
  }
}

TEST(ImageSimulator, BandingIsASineOverTheRows)
{
  const std::vector<float> ideal = simulateAll({});
  const std::vector<float> banded = simulateAll({ { "banding", "", "", { 0.05, 12.0, 0.25 } } });
  for (const int y : { 0, 5, 31 })
  {
    for (const int k : { 0, 3 })
    {
      const double expected = 1.0 + 0.05 * std::sin(6.283185307179586 * (y / 12.0 + 0.25 * k));
      const double dark = sevenChannels().dark()[k];
      const double light = static_cast<double>(at(ideal, 9, y, k)) - dark;
      EXPECT_NEAR(static_cast<double>(at(banded, 9, y, k)) - dark, expected * light, 1e-6);
    }
  }
}

TEST(ImageSimulator, BandingHasThreeHarmonicsAsGainOrAsOffset)
{
  const std::vector<float> ideal = simulateAll({});
  for (const char* form : { "row_harmonics", "column_harmonics", "row_offsets", "column_offsets" })
  {
    CameraEffect effect = msi::neutralEffect("banding", sevenChannels().channels(), form);
    const auto names = msi::effectParameters(effect, sevenChannels().channels());
    for (std::size_t i = 0; i < names.size(); ++i)
    {
      const std::string name = names[i].name.substr(0, names[i].name.find('['));
      effect.parameters[i] = name == "period" ? 12.5
        : name == "amplitude"                 ? 0.05
        : name == "amplitude_2"               ? 0.03
        : name == "amplitude_3"               ? 0.02
        : name == "start"                     ? 0.1
        : name == "start_2"                   ? 0.6
                                              : 0.35;
    }
    const std::vector<float> banded = simulateAll({ effect });
    const bool rows = form[0] == 'r';
    const bool offset = std::string(form).find("offsets") != std::string::npos;
    for (const int place : { 0, 5, 31 })
    {
      const auto sine = [&](int n, double start)
      { return std::sin(6.283185307179586 * (n * place / 12.5 + start)); };
      const double sum = 0.05 * sine(1, 0.1) + 0.03 * sine(2, 0.6) + 0.02 * sine(3, 0.35);
      const int x = rows ? 9 : place;
      const int y = rows ? place : 9;
      const double dark = sevenChannels().dark()[3];
      const double light = static_cast<double>(at(ideal, x, y, 3)) - dark;
      EXPECT_NEAR(static_cast<double>(at(banded, x, y, 3)) - dark,
        offset ? light + sum : light * (1.0 + sum), 1e-6)
        << form;
    }
  }
}

TEST(ImageSimulator, TurnedChannelsDoNotShowTheWindow)
{
  const ImageSimulator simulator(sevenChannels(), { misregistration(true) }, Extent);
  const ImageWindow all = msi::wholeImage(Extent);
  const std::vector<float> whole = simulateWindow(simulator, all, nullptr);
  EXPECT_NE(whole, simulateAll({ misregistration(false) }));
  const ImageWindow part{ 31, 17, 40, 20 };
  const std::vector<float> window = simulateWindow(simulator, part, nullptr);
  for (int y = 0; y < part.height; ++y)
  {
    for (int x = 0; x < part.width; ++x)
    {
      for (int k = 0; k < 7; ++k)
      {
        const int i = (y * part.width + x) * 7 + k;
        ASSERT_EQ(window[static_cast<std::size_t>(i)], at(whole, part.x + x, part.y + y, k));
      }
    }
  }
}

TEST(ImageSimulator, StrayLightLeavesTheMeanAndTakesContrast)
{
  const std::vector<float> ideal = simulateAll({});
  const std::vector<float> stray = simulateAll({ { "local_stray_light", "", "", { 0.3, 2.0 } } });
  const Eigen::Map<const Eigen::ArrayXf> before(
    ideal.data(), static_cast<Eigen::Index>(ideal.size()));
  const Eigen::Map<const Eigen::ArrayXf> after(
    stray.data(), static_cast<Eigen::Index>(stray.size()));
  EXPECT_NEAR(static_cast<double>(after.mean() / before.mean()), 1.0, 5e-3);
  EXPECT_LT((after - after.mean()).square().sum(), 0.8F * (before - before.mean()).square().sum());
}

TEST(ImageSimulator, NaNStaysInItsPixelWithoutNeighbourhoodEffects)
{
  std::vector<CameraEffect> effects;
  for (const CameraEffect& effect : everything())
  {
    if (effect.name != "misregistration" && effect.name != "defocus" &&
      effect.name != "local_stray_light")
    {
      effects.push_back(effect);
    }
  }
  const ImageSimulator simulator(sevenChannels(), effects, Extent, noisy());
  EXPECT_EQ(simulator.halo(), 0);
  const ImageWindow all = msi::wholeImage(Extent);
  const msi::SceneMean mean = meanOf(simulator);
  std::vector<float> reflectance = reflectanceOf(all);
  const std::vector<float> clean = simulateWindow(simulator, all, &mean);
  constexpr std::size_t Pixel = 97 * 20 + 30;
  reflectance[Pixel * Wavelengths + 12] = std::numeric_limits<float>::quiet_NaN();
  std::vector<float> response(clean.size());
  msi::ImageWorkspace workspace;
  simulator.simulate(
    reflectance.data(), mediaOf(all).data(), all, all, &mean, response.data(), workspace);
  for (std::size_t i = 0; i < response.size(); ++i)
  {
    if (i / Channels == Pixel)
    {
      ASSERT_TRUE(std::isnan(response[i]));
    }
    else
    {
      ASSERT_EQ(response[i], clean[i]);
    }
  }
}

TEST(ImageSimulator, RefusesWhatItCannotDoAndSaysWhy)
{
  EXPECT_EQ(messageOf(
              [] {
                ImageSimulator(sevenChannels(), {}, { 0, 5 });
              }),
    "the image has 0 x 5 pixels; expected at least one each way");
  EXPECT_EQ(
    messageOf(
      [] {
        ImageSimulator(sevenChannels(), { { "session_drift", "", "", { 0.1, 0.0 } } }, Extent);
      }),
    "session_drift concerns samples captured one after the other; for an image use channel_gain");
  const ImageSimulator simulator(sevenChannels(),
    { { "medium_gain", "", "paper", { 0.9 } }, { "veiling_glare", "", "", { 0.1 } } }, Extent);
  const ImageWindow all = msi::wholeImage(Extent);
  const std::vector<float> reflectance = reflectanceOf(all);
  std::vector<float> response(all.pixels() * Channels);
  msi::ImageWorkspace workspace;
  const auto run = [&](const int* medium, const ImageWindow& available, const ImageWindow& window)
  {
    return messageOf(
      [&]
      {
        simulator.simulate(
          reflectance.data(), medium, available, window, nullptr, response.data(), workspace);
      });
  };
  const std::vector<int> media = mediaOf(all);
  EXPECT_EQ(run(nullptr, all, all),
    "an effect of the camera acts on one medium, but the image comes without media");
  EXPECT_EQ(run(media.data(), all, all), "the effect veiling_glare needs the mean of the scene");
  EXPECT_EQ(run(media.data(), all, { 90, 0, 8, 4 }),
    "the window of 8 x 4 pixels at (90, 0) does not lie in the image of 97 x 53 pixels");
  EXPECT_EQ(run(media.data(), { 0, 0, 50, 53 }, { 20, 0, 40, 4 }),
    "the window of 40 x 4 pixels at (20, 0) depends on 40 x 4 pixels at (20, 0), but only 50 x 53 "
    "pixels at "
    "(0, 0) are available");
}

}
