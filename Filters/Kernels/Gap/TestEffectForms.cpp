#include "Kernels/Gap/EffectForms.h"
#include "Kernels/Gap/GapTestData.h"

#include <gtest/gtest.h>

namespace
{

using namespace msi::test;

// Passbands that keep their peak as they widen are brighter, too; half as much light hides that.
TEST(EffectForms, WhatIsBrighterBesideAnExposureIsTheExposure)
{
  constexpr double Gain = 0.9;
  const msi::GapData data = dataOf(captureWith(
    { { "filter_bandwidth", "common", "", { 1.2 } }, { "exposure_gain", "", "", { Gain } } }));
  const msi::EffectFitter fitter(data, data.usable, 1);
  const msi::EffectDefinition* width = msi::findEffect("filter_bandwidth");
  const msi::EffectDefinition* exposure = msi::findEffect("exposure_gain");
  msi::EffectSet set;
  set.add({ width, msi::findForm(*width, "fixed_peak"), "" }, data.camera);
  set.add({ exposure, &exposure->forms.front(), "" }, data.camera);
  const msi::EffectFit nominal = fitter.nominal();
  const msi::EffectFit fit = msi::preferExposure(
    fitter, fitter.fit(set, msi::FinalFit), msi::choicesFor(data.scene, {}), nominal.energy);
  ASSERT_EQ(fit.set.size(), 2U);
  EXPECT_TRUE(fit.set.choices[0].whiteAfter);
  EXPECT_NEAR(fit.set.effects[1].parameters[0], Gain, 0.005);
}

} // namespace
