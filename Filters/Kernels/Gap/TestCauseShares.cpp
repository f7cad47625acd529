#include "Kernels/Gap/CauseShares.h"
#include "Kernels/Gap/GapTestData.h"
#include "Kernels/Gap/Shrink.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

using namespace msi::test;

// The effects, in the forms given, fitted to a capture that has other or the same effects.
class Shared
{
public:
  Shared(std::vector<msi::CameraEffect> planted, const std::vector<msi::CameraEffect>& blamed)
    : Data(dataOf(captureWith(std::move(planted))))
    , Fitter(Data, Data.usable, 1)
  {
    msi::EffectSet set;
    for (const msi::CameraEffect& effect : blamed)
    {
      const msi::EffectDefinition* definition = msi::findEffect(effect.name);
      set.add({ definition, msi::findForm(*definition, effect.form), effect.medium }, Data.camera);
    }
    Fit = Fitter.fit(std::move(set), msi::FinalFit);
  }
  std::vector<msi::CauseShare> shares(double doubt) const
  {
    return msi::causeShares(Fitter, Fit, 1.0, doubt);
  }
  double shrinkBy(const msi::CameraEffect& effect) const
  {
    const msi::EffectDefinition* definition = msi::findEffect(effect.name);
    msi::EffectSet set;
    set.add({ definition, msi::findForm(*definition, effect.form), effect.medium }, Data.camera);
    return msi::shrinkOf(Fitter, Fitter.fit(std::move(set), msi::FinalFit));
  }
  double shrink() const { return msi::shrinkOf(Fitter, Fit); }

private:
  msi::GapData Data;
  msi::EffectFitter Fitter;
  msi::EffectFit Fit;
};

const msi::CameraEffect Offset{ "dark_offset", "", "", { 0.02 } };
const msi::CameraEffect Corners{ "vignetting", "", "", { 0.2, 0.0, 0.0 } };

TEST(CauseShares, WithoutDoubtTheySumUpToTheWhole)
{
  const std::vector<msi::CauseShare> shares =
    Shared({ Offset, Corners }, { Offset, Corners }).shares(0.0);
  EXPECT_NEAR(shares[0].share + shares[1].share, 1.0, 1e-12);
}

// Dark corners and an offset, against each other. What each does has the angle a with what the other does; the larger can
// undo the part cos(a)^2 of the smaller.
TEST(CauseShares, OppositeCausesUndoOnlyWhatPointsAtOneAnother)
{
  const msi::SampleScene scene = rasterScene(96);
  const auto change = [&scene](const std::vector<msi::CameraEffect>& effects)
  {
    return (msi::CameraSimulator(sevenChannels(), effects).respond(scene) -
      msi::CameraSimulator(sevenChannels(), {}).respond(scene))
      .reshaped()
      .eval();
  };
  const Eigen::VectorXd corners = change({ Corners, Offset }) - change({ Offset });
  const Eigen::VectorXd offset = change({ Offset });
  const double cosine = corners.dot(offset) / (corners.norm() * offset.norm());
  ASSERT_LT(cosine, -0.3);
  ASSERT_GT(offset.norm(), -cosine * corners.norm());
  const std::vector<msi::CauseShare> shares =
    Shared({ Offset, Corners }, { Offset, Corners }).shares(1.0);
  EXPECT_NEAR(shares[1].undone, cosine * cosine, 0.05);
  EXPECT_GT(shares[1].share, 0.1);
}

// The offset of each channel counts as a small error; the corners show once it is out of the way.
TEST(CauseShares, ACauseThatSmallErrorsHideGetsWhatItDoesBesideThem)
{
  const msi::CameraEffect darks{ "dark_offset", "per_channel", "",
    { 0.02, 0.03, 0.025, 0.02, 0.035, 0.03, 0.02 } };
  const Shared shared({ darks, Corners }, { darks, Corners });
  const std::vector<msi::CauseShare> shares = shared.shares(0.0);
  const auto energy = [](double shrink) { return 1.0 - std::pow(1.0 - shrink, 2); };
  const double first = energy(shared.shrinkBy(Corners));
  const double beside = energy(shared.shrink()) - energy(shared.shrinkBy(darks));
  ASSERT_GT(beside, first);
  EXPECT_NEAR(shares[1].share, beside / energy(shared.shrink()), 0.01);
}

// Offsets that are the same in all channels are no small errors: they share like any other cause.
TEST(CauseShares, NumbersOfChannelsThatFollowOneCurveAreACause)
{
  const msi::CameraEffect darks{ "dark_offset", "per_channel", "",
    { 0.02, 0.02, 0.02, 0.02, 0.02, 0.02, 0.02 } };
  const msi::CameraEffect glare{ "veiling_glare", "", "", {} };
  const Shared shared({ darks }, { glare, darks });
  ASSERT_GT(shared.shrinkBy(glare), 0.3);
  const double ahead = shared.shrinkBy(darks) - shared.shrinkBy(glare);
  EXPECT_NEAR(shared.shares(0.0)[1].share, 0.5 + 0.5 * ahead / shared.shrink(), 0.01);
}

// A lamp that warmed and may not be blamed: an exposure and gains along a curve do the same.
TEST(CauseShares, AnExposureBesideGainsAlongACurveMayBeAPartOfSomethingElse)
{
  const msi::CameraEffect lamp{ "illuminant_drift", "", "", { 0.1 } };
  const msi::CameraEffect darker{ "exposure_gain", "", "", { 0.95 } };
  const msi::CameraEffect gains{ "channel_gain", "", "",
    { 1.03, 0.96, 1.02, 0.99, 1.05, 0.97, 1.01 } };
  const Shared mimicked({ lamp, darker }, { darker, gains });
  ASSERT_GT(mimicked.shrink(), 0.9);
  EXPECT_LT(mimicked.shares(0.0)[0].share, 0.5);
  EXPECT_LT(mimicked.shares(0.0)[1].share, 0.05);
  const Shared real({ darker, gains }, { darker, gains });
  EXPECT_NEAR(real.shares(0.0)[0].share + real.shares(0.0)[1].share, 1.0, 1e-12);
}

TEST(CauseShares, AGainThatStaysIsNoDrift)
{
  const msi::CameraEffect gains{ "channel_gain", "", "",
    { 1.03, 0.96, 1.02, 0.99, 1.05, 0.97, 1.01 } };
  const msi::CameraEffect warming{ "session_drift", "warm_up_per_channel", "", {} };
  EXPECT_EQ(Shared({ gains }, { warming }).shares(0.0)[0].share, 0.0);
  const msi::CameraEffect slope{ "session_drift", "slope", "", { 0.08, 0.0 } };
  EXPECT_NEAR(Shared({ slope }, { slope }).shares(0.0)[0].share, 1.0, 1e-12);
}

} // namespace
