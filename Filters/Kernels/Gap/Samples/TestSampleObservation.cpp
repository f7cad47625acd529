#include "Kernels/Gap/Samples/GapTestData.h"
#include "Kernels/Gap/Samples/SampleObservation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <string>
#include <vector>

namespace
{

using namespace msi::test;

TEST(SampleObservation, AFitWithoutOnePositionIsTheFitOfTheOther)
{
  const msi::GapData data = dataOf(
    captureWith({ { "exposure_gain", "", "", { 1.05 } }, { "dark_offset", "", "", { 0.01 } } }));
  const msi::SampleObservation observation(data, data.usable, msi::choicesFor(data.scene, {}), 1);
  const auto optionOf = [&observation](const std::string& effect)
  {
    const auto& options = observation.options();
    return static_cast<std::size_t>(
      std::find_if(options.begin(), options.end(),
        [&effect](const msi::GapOption& option) { return option.effect->name == effect; }) -
      options.begin());
  };
  const msi::FitPointer nominal = observation.nominal();
  const msi::FitPointer gain =
    observation.extended(*nominal, { optionOf("exposure_gain"), {}, {} });
  const msi::FitPointer both = observation.extended(*gain, { optionOf("dark_offset"), {}, {} });
  EXPECT_LT(both->energy, gain->energy);
  EXPECT_LT(gain->energy, nominal->energy);
  const msi::FitPointer again = observation.reduced(*both, 1);
  EXPECT_EQ(again->set, gain->set);
  EXPECT_NEAR(again->energy, gain->energy, 1e-3 * gain->energy);
}

TEST(SampleObservation, TheWhiteStaysTakenWhereWhatSaidSoIsGone)
{
  const msi::CameraEffect leak{ "filter_leak", "", "", { 0.03, 0.5, 0.0, 0.0 } };
  const msi::CameraEffect wide{ "filter_bandwidth", "fixed_peak", "", { 1.3 } };
  const msi::SceneSamples samples = rasterSamples(96);
  const msi::CameraSimulator real(sevenChannels(), { leak, wide }, { true });
  const msi::GapData data = dataOf(
    captureFrom(sevenChannels(), samples, real.respond(msi::SampleScene(visibleGrid(), samples))));
  const std::vector<msi::EffectChoice> choices = msi::choicesFor(data.scene, {});
  const msi::SampleObservation observation(data, data.usable, choices, 1);
  const auto optionOf = [&choices](const msi::CameraEffect& effect, bool whiteAfter)
  {
    return static_cast<std::size_t>(
      std::find_if(choices.begin(), choices.end(),
        [&](const msi::EffectChoice& choice)
        {
          return choice.effect->name == effect.name && choice.whiteAfter == whiteAfter &&
            choice.form->name == (effect.form.empty() ? "common" : effect.form);
        }) -
      choices.begin());
  };
  const msi::FitPointer width =
    observation.extended(*observation.nominal(), { optionOf(wide, true), { 1.2 }, {} });
  const msi::FitPointer both =
    observation.extended(*width, { optionOf(leak, false), { 0.01, 0.0, 0.0, 0.0 }, {} });
  EXPECT_LT(both->energy, 2.0 * observation.noiseEnergy());
  EXPECT_EQ(observation.reduced(*both, 2)->set, std::vector<std::size_t>{ optionOf(leak, true) });
}

// The first of the effect's forms.
msi::GapPreview previewOf(const msi::SampleObservation& observation, const msi::ObservedFit& from,
  const std::string& effect)
{
  const std::vector<msi::GapPreview> previews = observation.previews(from);
  return *std::find_if(previews.begin(), previews.end(),
    [&](const msi::GapPreview& one)
    { return observation.options()[one.option].effect->name == effect; });
}

// Crosstalk reaches the channels beside its own, the gains that are there before do not.
TEST(SampleObservation, APreviewBesideNumbersOfChannelsMayReachTheirNeighbours)
{
  const msi::GapData data =
    dataOf(captureWith({ { "channel_gain", "", "", { 1.02, 0.99, 0.98, 1.01, 1.03, 0.99, 1.0 } },
      { "channel_crosstalk", "", "", { 0.03, 0.0 } } }));
  const msi::SampleObservation observation(data, data.usable, msi::choicesFor(data.scene, {}), 1);
  const msi::FitPointer nominal = observation.nominal();
  const msi::FitPointer gains =
    observation.extended(*nominal, previewOf(observation, *nominal, "channel_gain"));
  const msi::GapPreview preview = previewOf(observation, *gains, "channel_crosstalk");
  const msi::FitPointer fit = observation.extended(*gains, preview);
  EXPECT_LT(fit->energy, 0.2 * gains->energy);
  EXPECT_LT(preview.fit.energy, 2.0 * fit->energy); // one step, of two effects that multiply
}

// Beside another effect; the gains of the channels, seven numbers, learn how much they scatter.
TEST(SampleObservation, APreviewOfALinearEffectIsItsFit)
{
  const msi::GapData data = dataOf(captureWith({ { "dark_offset", "", "", { 0.01 } },
    { "channel_gain", "", "", { 1.02, 0.99, 0.98, 1.01, 1.03, 0.99, 1.0 } } }));
  const msi::SampleObservation observation(data, data.usable, msi::choicesFor(data.scene, {}), 1);
  const msi::FitPointer nominal = observation.nominal();
  const msi::FitPointer dark =
    observation.extended(*nominal, previewOf(observation, *nominal, "dark_offset"));
  const msi::GapPreview preview = previewOf(observation, *dark, "channel_gain");
  const msi::FitPointer fit = observation.extended(*dark, preview);
  EXPECT_EQ(preview.fit.set, fit->set);
  EXPECT_LT(fit->energy, 0.2 * dark->energy);
  EXPECT_NEAR(preview.fit.energy, fit->energy, 0.05 * fit->energy);
  EXPECT_NEAR(preview.fit.surprise, fit->surprise, 1.0); // a logarithm of odds
  const double gain = fit->prior.gain(fit->information);
  EXPECT_NEAR(preview.fit.prior.gain(preview.fit.information), gain, 0.05 * gain);
}

} // namespace
