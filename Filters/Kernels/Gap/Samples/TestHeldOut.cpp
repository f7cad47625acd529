#include "Kernels/Gap/Samples/GapTestData.h"
#include "Kernels/Gap/Samples/HeldOut.h"

#include <gtest/gtest.h>

namespace
{

using namespace msi::test;

// A step of 5 % between samples 40 and 41. Without both of them it is only known to lie between 39 and 42.
TEST(HeldOut, ASampleBesideAStepMayLieOnEitherSide)
{
  const double place = 40.5 / 95.0;
  const msi::GapData data =
    dataOf(captureWith({ { "session_drift", "step", "", { 0.05, place, 0.001 } } }));
  std::vector<char> training(96, 1);
  training[40] = training[41] = training[60] = 0;
  const msi::EffectDefinition* drift = msi::findEffect("session_drift");
  for (const double guess : { 39.4, 41.6 })
  {
    msi::EffectSet set;
    set.add(
      { drift, msi::findForm(*drift, "step"), "" }, data.camera, { 0.05, guess / 95.0, 0.001 });
    msi::EffectFit fit;
    fit.predicted = msi::respond(data.camera, data.scene, set);
    fit.set = std::move(set);
    const Eigen::MatrixXd plain = data.observed - fit.predicted;
    const Eigen::MatrixXd left = msi::leftOfHeldOut(data, fit, training);
    ASSERT_GT(std::fmax(plain.col(40).norm(), plain.col(41).norm()), 0.01);
    EXPECT_LT(left.col(40).norm(), 0.002);
    EXPECT_LT(left.col(41).norm(), 0.002);
    EXPECT_EQ(left.col(60), plain.col(60));
    EXPECT_EQ(left.col(39), plain.col(39));
  }
}

} // namespace
