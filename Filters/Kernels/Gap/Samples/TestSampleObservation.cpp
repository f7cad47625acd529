#include "Kernels/Gap/Samples/GapTestData.h"
#include "Kernels/Gap/Samples/SampleObservation.h"

#include <gtest/gtest.h>

#include <algorithm>

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
    observation.extended(*nominal, { optionOf("exposure_gain"), {}, 0.0, 1.0 });
  const msi::FitPointer both =
    observation.extended(*gain, { optionOf("dark_offset"), {}, 0.0, 1.0 });
  EXPECT_LT(both->energy, gain->energy);
  EXPECT_LT(gain->energy, nominal->energy);
  const msi::FitPointer again = observation.reduced(*both, 1);
  EXPECT_EQ(again->set, gain->set);
  EXPECT_NEAR(again->energy, gain->energy, 1e-3 * gain->energy);
}

} // namespace
