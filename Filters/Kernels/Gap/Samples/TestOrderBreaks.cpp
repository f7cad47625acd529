#include "Kernels/Gap/Samples/GapTestData.h"
#include "Kernels/Gap/Samples/OrderBreaks.h"

#include <gtest/gtest.h>

#include <vector>

namespace
{

using namespace msi::test;

const msi::EffectForm& stepForm()
{
  return msi::requireForm(msi::requireEffect("session_drift"), "step");
}

// The responses of every sample from number `first` on are multiplied by 1 + change.
msi::GapCapture withJump(const std::vector<std::pair<int, double>>& jumps)
{
  msi::GapCapture capture = captureWith({});
  for (const auto& [first, change] : jumps)
  {
    for (Eigen::Index j = 0; j < capture.readings.cols(); ++j)
    {
      if (capture.sampleOf[static_cast<std::size_t>(j)] >= first)
      {
        capture.readings.col(j) *= 1.0 + change;
      }
    }
  }
  return capture;
}

TEST(OrderBreaks, OneJumpIsFoundWithItsSizeBetweenTheTwoSamples)
{
  const msi::GapData data = dataOf(withJump({ { 60, 0.04 } }));
  const msi::EffectFitter fitter(data, data.usable, 1);
  const auto found = msi::OrderBreaks::significant(fitter, data.simulated, 6);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_DOUBLE_EQ(found.front().order, 59.5);
  EXPECT_NEAR(found.front().change, 0.04, 0.002);
  EXPECT_GT(found.front().deviations, 5.0);
  const auto starts = msi::OrderBreaks(fitter, data.simulated).startsFor(stepForm());
  ASSERT_FALSE(starts.empty());
  EXPECT_NEAR(starts.front()[0], 0.04, 0.003);
  EXPECT_NEAR(starts.front()[1], 59.5 / 95.0, 1e-9); // capture time 0..1
}

TEST(OrderBreaks, TwoJumpsAreFoundInTheirOrder)
{
  const msi::GapData data = dataOf(withJump({ { 30, 0.05 }, { 70, -0.03 } }));
  const msi::EffectFitter fitter(data, data.usable, 1);
  const auto found = msi::OrderBreaks::significant(fitter, data.simulated, 6);
  ASSERT_EQ(found.size(), 2U);
  EXPECT_DOUBLE_EQ(found[0].order, 29.5);
  EXPECT_DOUBLE_EQ(found[1].order, 69.5);
  EXPECT_NEAR(found[0].change, 0.05, 0.003);
  EXPECT_NEAR(found[1].change, -0.03 * 1.05, 0.003);
  EXPECT_EQ(msi::OrderBreaks::significant(fitter, data.simulated, 1).size(), 1U);
}

TEST(OrderBreaks, DriftHasNoneAndAJumpInItKeepsItsSize)
{
  msi::GapCapture capture = withJump({});
  for (Eigen::Index j = 0; j < capture.readings.cols(); ++j)
  {
    capture.readings.col(j) *= 1.0 + 0.001 * capture.sampleOf[static_cast<std::size_t>(j)];
  }
  const auto breaksOf = [](const msi::GapCapture& some)
  {
    const msi::GapData data = dataOf(some);
    return msi::OrderBreaks::significant(
      msi::EffectFitter(data, data.usable, 1), data.simulated, 6);
  };
  EXPECT_TRUE(breaksOf(capture).empty());
  for (Eigen::Index j = 0; j < capture.readings.cols(); ++j)
  {
    capture.readings.col(j) *= capture.sampleOf[static_cast<std::size_t>(j)] < 40 ? 1.0 : 0.97;
  }
  const auto found = breaksOf(capture);
  ASSERT_EQ(found.size(), 1U);
  EXPECT_DOUBLE_EQ(found.front().order, 39.5);
  EXPECT_NEAR(found.front().change, -0.03 * 1.04, 0.003);
}

TEST(OrderBreaks, NoJumpNoOrderNoBreaks)
{
  const msi::GapData data = dataOf(captureWith({}));
  const msi::EffectFitter fitter(data, data.usable, 1);
  EXPECT_TRUE(msi::OrderBreaks::significant(fitter, data.simulated, 6).empty());
  msi::GapCapture capture = withJump({ { 60, 0.04 } });
  capture.samples.order.resize(0);
  const msi::GapData orderless = dataOf(capture);
  const msi::EffectFitter blind(orderless, orderless.usable, 1);
  EXPECT_TRUE(msi::OrderBreaks::significant(blind, orderless.simulated, 6).empty());
  EXPECT_TRUE(msi::OrderBreaks(blind, orderless.simulated).startsFor(stepForm()).empty());
}

} // namespace
