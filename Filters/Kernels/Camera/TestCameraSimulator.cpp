#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraTestData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>

namespace
{
using msi::CameraEffect;
using msi::CameraSimulator;
using msi::test::messageOf;
using msi::test::rasterSamples;
using msi::test::rasterScene;
using msi::test::responseWith;
using msi::test::sevenChannels;
using msi::test::visibleGrid;

// Every form of every effect, on medium fabric where it needs one.
std::vector<CameraEffect> everyForm()
{
  std::vector<CameraEffect> all;
  for (const msi::EffectDefinition& effect : msi::effectLibrary())
  {
    for (const msi::EffectForm& form : effect.forms)
    {
      all.push_back(msi::neutralEffect(effect.name, sevenChannels().channels(), form.name,
        effect.need == msi::EffectNeed::Medium ? "fabric" : ""));
    }
  }
  return all;
}

std::string nameOf(const CameraEffect& effect)
{
  return effect.name + "/" + effect.form;
}

// The effect with its primary parameters moved by `steps` times their typical size.
CameraEffect moved(CameraEffect effect, double steps)
{
  const auto parameters = msi::effectParameters(effect, sevenChannels().channels());
  for (std::size_t i = 0; i < parameters.size(); ++i)
  {
    if (!parameters[i].secondary)
    {
      const bool atUpperBound = parameters[i].neutral == parameters[i].upper;
      effect.parameters[i] += (atUpperBound ? -steps : steps) * parameters[i].typical;
    }
  }
  return effect;
}

bool actsOnTables(const CameraEffect& effect)
{
  const msi::EffectStage stage = msi::findEffect(effect.name)->stage;
  return stage != msi::EffectStage::Image && stage != msi::EffectStage::Noise;
}

TEST(EffectLibrary, HasEveryEffectOfTheContract)
{
  for (const char* name :
    { "dark_offset", "exposure_gain", "channel_gain", "illuminant_drift", "detector_nonlinearity",
      "saturation", "channel_crosstalk", "filter_shift", "filter_bandwidth", "filter_leak",
      "veiling_glare", "local_stray_light", "vignetting", "illumination_gradient", "medium_gain",
      "specular_component", "interreflection", "translucency", "fluorescence", "session_drift",
      "excess_noise", "misregistration", "defocus" })
  {
    EXPECT_NE(msi::findEffect(name), nullptr) << name;
  }
}

TEST(EffectLibrary, EveryEntryIsWellFormed)
{
  std::set<std::string> names;
  msi::EffectStage stage = msi::EffectStage::Reflectance;
  for (const msi::EffectDefinition& effect : msi::effectLibrary())
  {
    EXPECT_TRUE(names.insert(effect.name).second) << effect.name;
    EXPECT_FALSE(effect.title.empty() || effect.meaning.empty()) << effect.name;
    EXPECT_GE(effect.stage, stage) << effect.name << " stands after an effect of a later stage";
    stage = effect.stage;
    ASSERT_FALSE(effect.forms.empty()) << effect.name;
    std::set<std::string> forms;
    for (const msi::EffectForm& form : effect.forms)
    {
      EXPECT_TRUE(forms.insert(form.name).second) << effect.name << " " << form.name;
      ASSERT_FALSE(form.parameters.empty());
      EXPECT_FALSE(form.parameters.front().secondary) << effect.name << " " << form.name;
      for (const msi::EffectParameter& parameter : form.parameters)
      {
        EXPECT_LE(parameter.lower, parameter.neutral) << effect.name << " " << parameter.name;
        EXPECT_GE(parameter.upper, parameter.neutral) << effect.name << " " << parameter.name;
        EXPECT_GT(parameter.typical, 0.0) << effect.name << " " << parameter.name;
        EXPECT_FALSE(parameter.meaning.empty() || parameter.unit.empty());
      }
      for (const auto& start : form.starts)
      {
        ASSERT_EQ(start.size(), form.parameters.size()) << effect.name << " " << form.name;
        for (std::size_t i = 0; i < start.size(); ++i)
        {
          EXPECT_GE(start[i], form.parameters[i].lower);
          EXPECT_LE(start[i], form.parameters[i].upper);
        }
      }
    }
  }
}

TEST(EffectLibrary, SaysWhatItKnows)
{
  const std::string message =
    messageOf([] { msi::neutralEffect("filter_shfit", sevenChannels().channels()); });
  EXPECT_EQ(message.rfind("there is no camera effect 'filter_shfit'; known are ", 0), 0U);
  EXPECT_NE(message.find("filter_shift"), std::string::npos);
  EXPECT_EQ(messageOf([] { msi::neutralEffect("dark_offset", sevenChannels().channels(), "all"); }),
    "there is no form of dark_offset 'all'; known are common, per_channel, plane");
}

TEST(EffectLibrary, SpreadsPerChannelParametersAndNamesThem)
{
  const auto parameters = msi::effectParameters({ "channel_gain", "", "", {} }, { "a", "b" });
  ASSERT_EQ(parameters.size(), 2U);
  EXPECT_EQ(parameters[0].name, "gain[a]");
  EXPECT_EQ(parameters[1].name, "gain[b]");
}

TEST(CameraSimulator, WithoutEffectsIsTheIdealCamera)
{
  EXPECT_EQ(responseWith({}), msi::cameraResponse(sevenChannels())(rasterScene().reflectance()));
}

TEST(CameraSimulator, NeutralEffectsChangeNoBit)
{
  const Eigen::MatrixXd ideal = responseWith({});
  for (const CameraEffect& effect : everyForm())
  {
    EXPECT_EQ(responseWith({ effect }), ideal) << nameOf(effect);
  }
  EXPECT_EQ(responseWith(
              [&]
              {
                std::vector<CameraEffect> defaults;
                for (const msi::EffectDefinition& effect : msi::effectLibrary())
                {
                  defaults.push_back(msi::neutralEffect(effect.name, sevenChannels().channels(), {},
                    effect.need == msi::EffectNeed::Medium ? "fabric" : ""));
                }
                return defaults;
              }(),
              true),
    ideal);
}

TEST(CameraSimulator, EveryEffectActsAndVanishesInProportion)
{
  const Eigen::MatrixXd ideal = responseWith({});
  for (const CameraEffect& effect : everyForm())
  {
    if (!actsOnTables(effect) || effect.name == "saturation")
    {
      continue;
    }
    // own_middles has products of its numbers, which only small steps leave out.
    const double step = effect.form == "own_middles" ? 0.2 : 1.0;
    const double large = (responseWith({ moved(effect, step) }) - ideal).norm();
    const double small = (responseWith({ moved(effect, 1e-4 * step) }) - ideal).norm();
    EXPECT_GT(large, 1e-3) << nameOf(effect);
    // cos4 starts with the square of its parameter, all others with the first power.
    const double power = effect.form == "cos4" ? 2.0 : 1.0;
    EXPECT_NEAR(small / large / std::pow(1e-4, power), 1.0, 0.35) << nameOf(effect);
  }
}

// Least squares needs one slope, seen from both sides of neutral and of a typical strength.
TEST(CameraSimulator, EveryEffectIsDifferentiable)
{
  for (const CameraEffect& effect : everyForm())
  {
    if (!actsOnTables(effect) || effect.name == "saturation" || effect.form == "cos4")
    {
      continue;
    }
    for (const double at : { 0.0, 1.0 })
    {
      const auto parameters = msi::effectParameters(effect, sevenChannels().channels());
      if (at == 0.0 && parameters.front().lower == parameters.front().neutral)
      {
        continue;
      }
      constexpr double Step = 1e-3;
      const Eigen::MatrixXd here = responseWith({ moved(effect, at) });
      const Eigen::MatrixXd right = responseWith({ moved(effect, at + Step) }) - here;
      const Eigen::MatrixXd left = here - responseWith({ moved(effect, at - Step) });
      EXPECT_LT((right - left).norm(), 0.02 * right.norm()) << nameOf(effect) << " at " << at;
    }
  }
}

TEST(CameraSimulator, NaNStaysInItsOwnSample)
{
  msi::SceneSamples samples = rasterSamples();
  samples.reflectance(7, 10) = std::numeric_limits<double>::quiet_NaN();
  const msi::SampleScene broken(visibleGrid(), samples);
  for (const CameraEffect& effect : everyForm())
  {
    const CameraSimulator simulator(sevenChannels(), { moved(effect, 1.0) });
    const Eigen::MatrixXd response = simulator.respond(broken);
    const Eigen::MatrixXd whole = simulator.respond(rasterScene());
    const bool mixes = effect.name == "veiling_glare" || effect.name == "local_stray_light";
    for (Eigen::Index j = 0; j < response.cols(); ++j)
    {
      if (j == 10)
      {
        EXPECT_TRUE(response.col(j).array().isNaN().all()) << nameOf(effect);
      }
      else if (mixes)
      {
        EXPECT_TRUE(response.col(j).allFinite()) << nameOf(effect);
      }
      else
      {
        EXPECT_EQ(response.col(j), whole.col(j)) << nameOf(effect);
      }
    }
  }
}

TEST(CameraSimulator, TheOrderOfTheListDoesNotMatter)
{
  const CameraEffect curve{ "detector_nonlinearity", "quadratic", "", { 0.2 } };
  const CameraEffect gain{ "exposure_gain", "", "", { 1.3 } };
  const CameraEffect dark{ "dark_offset", "", "", { 0.01 } };
  EXPECT_EQ(responseWith({ curve, gain, dark }), responseWith({ dark, gain, curve }));
}

TEST(CameraSimulator, WhiteAfterEffectsKeepsTheResponseToWhite)
{
  const CameraEffect drift{ "illuminant_drift", "smooth", "", { 0.3, -0.1, 0.05 } };
  const CameraEffect leak{ "filter_leak", "", "", { 0.05, 0.3, 0.0, 0.0 } };
  const CameraSimulator simulator(sevenChannels(), { drift, leak }, { true });
  EXPECT_LT((simulator.effectiveResponsivity().rowwise().sum() -
              sevenChannels().responsivity().rowwise().sum())
              .cwiseAbs()
              .maxCoeff(),
    1e-14);
  EXPECT_GT((responseWith({ drift, leak }, true) - responseWith({})).norm(), 1e-2);
}

TEST(CameraSimulator, RefusesWhatItCannotDoAndSaysWhy)
{
  const auto construct = [](const CameraEffect& effect)
  { return messageOf([&] { CameraSimulator(sevenChannels(), { effect }); }); };
  EXPECT_EQ(construct({ "dark_offset", "", "", { 0.1, 0.2 } }),
    "the camera effect dark_offset in the form common has 1 parameters but 2 are given");
  EXPECT_EQ(construct({ "dark_offset", "", "", { 0.9 } }),
    "the parameter offset of the camera effect dark_offset is 0.9; expected a value from -0.2 to "
    "0.2");
  EXPECT_EQ(construct({ "dark_offset", "", "paper", { 0.1 } }),
    "the camera effect dark_offset acts on all media; 'paper' cannot be its medium");
  EXPECT_EQ(construct({ "medium_gain", "", "", { 0.9 } }),
    "the camera effect medium_gain acts on one medium; name it");
  EXPECT_EQ(messageOf(
              []
              {
                const CameraEffect dark{ "dark_offset", "", "", { 0.01 } };
                CameraSimulator(sevenChannels(), { dark, dark });
              }),
    "the camera effect dark_offset is given twice; give it once");

  msi::SceneSamples bare;
  bare.reflectance = Eigen::MatrixXd::Constant(31, 2, 0.5);
  const msi::SampleScene scene(visibleGrid(), bare);
  const auto respond = [&scene](const CameraEffect& effect)
  {
    const CameraSimulator simulator(sevenChannels(), { effect });
    return messageOf([&] { (void)simulator.respond(scene); });
  };
  EXPECT_EQ(respond({ "vignetting", "", "", { 0.1, 0.0, 0.0 } }),
    "an effect of the camera depends on the position, but the scene has no x and y");
  EXPECT_EQ(respond({ "session_drift", "", "", { 0.1, 0.0 } }),
    "session_drift depends on the capture order, but the scene has no order");
  EXPECT_EQ(respond({ "medium_gain", "", "fabric", { 0.9 } }), "");
  const msi::SampleScene coarse(
    msi::WavelengthGrid::uniform(400.0, 700.0, 20.0), { Eigen::MatrixXd::Zero(16, 1) });
  EXPECT_EQ(messageOf([&] { (void)CameraSimulator(sevenChannels(), {}).respond(coarse); }),
    "the scene has 16 wavelengths from 400 to 700 nm, the camera 31 from 400 to 700; resample one "
    "of them");
}

TEST(CameraSimulator, ExcessNoiseChangesTheVarianceOnly)
{
  msi::CameraNoise noise;
  noise.read = 0.002;
  noise.shot = 0.01;
  const double response = 0.25;
  const double plain = 0.002 * 0.002 + 0.01 * 0.01 * response;
  const CameraSimulator ideal(sevenChannels(), {});
  EXPECT_DOUBLE_EQ(ideal.noiseGenerator(noise, 0).variance(3, response), plain);
  const CameraSimulator factor(sevenChannels(), { { "excess_noise", "", "", { 3.0 } } });
  EXPECT_DOUBLE_EQ(factor.noiseGenerator(noise, 0).variance(3, response), 9.0 * plain);
  const CameraSimulator added(sevenChannels(), { { "excess_noise", "added", "", { 0.004 } } });
  EXPECT_DOUBLE_EQ(added.noiseGenerator(noise, 0).variance(3, response), plain + 0.004 * 0.004);
}

}
