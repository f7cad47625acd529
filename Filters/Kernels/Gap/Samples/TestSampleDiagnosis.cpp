#include "Kernels/Gap/Samples/SampleDiagnosis.h"

#include "Kernels/Gap/GapTestData.h"
#include "Kernels/Gap/Samples/SampleObservation.h"

#include <gtest/gtest.h>

#include <algorithm>

namespace
{

using namespace msi::test;

double probabilityOf(const msi::GapReport& report, const std::string& name)
{
  const auto found = std::find_if(report.probabilities.begin(), report.probabilities.end(),
    [&name](const auto& one) { return one.first == name; });
  return found == report.probabilities.end() ? 0.0 : found->second;
}

TEST(SampleDiagnosis, NoGapIsQuiet)
{
  const msi::GapReport report = *msi::diagnoseSamples(captureWith({}));
  EXPECT_EQ(report.verdict, msi::GapVerdict::NoGap);
  EXPECT_TRUE(report.causes.empty());
  EXPECT_GT(probabilityOf(report, "nothing"), 0.5);
}

TEST(SampleDiagnosis, OneEffectIsNamedAndMeasured)
{
  const msi::GapReport report =
    *msi::diagnoseSamples(captureWith({ { "detector_nonlinearity", "gamma", "", { 0.9 } } }));
  ASSERT_EQ(report.verdict, msi::GapVerdict::Explained);
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "detector_nonlinearity");
  EXPECT_EQ(report.causes.front().form, "gamma");
  EXPECT_NEAR(report.causes.front().parameters.front().value, 0.9, 0.005);
  EXPECT_GT(probabilityOf(report, "detector_nonlinearity"), 0.9);
}

// A Gaussian passband times an exponential of the wavelength is the passband moved: with white balanced again a tilt of the
// lamp and a shift of the filters do the same.
TEST(SampleDiagnosis, WhatIsTheSameForGaussianPassbandsIsSaidToBe)
{
  const msi::GapReport report =
    *msi::diagnoseSamples(captureWith({ { "filter_shift", "", "", { 2.5 } } }));
  ASSERT_EQ(report.verdict, msi::GapVerdict::Explained);
  const msi::GapCause& cause = report.causes.front();
  EXPECT_TRUE(cause.effect == "filter_shift" || says(cause.equivalent, "filter_shift"));
  EXPECT_TRUE(cause.effect == "illuminant_drift" || says(cause.equivalent, "illuminant_drift"));
  EXPECT_GT(probabilityOf(report, "filter_shift") + probabilityOf(report, "illuminant_drift"), 0.9);
}

TEST(SampleDiagnosis, SharesAreWhatTheGapShrinksBy)
{
  const msi::GapReport report = *msi::diagnoseSamples(captureWith(
    { { "illumination_gradient", "", "", { 0.05, 0.0 } }, { "dark_offset", "", "", { 0.01 } } }));
  ASSERT_EQ(report.causes.size(), 2U);
  EXPECT_NEAR(report.causes[0].share + report.causes[1].share, report.gap.shrink, 1e-9);
}

// A camera that was fitted as linear to a curved detector differs from it by the curve less its line alone.
TEST(SampleDiagnosis, ACurveBehindALinearFitIsOneCause)
{
  msi::GapCapture capture = captureWith({}, 96);
  const Eigen::MatrixXd straight =
    msi::CameraSimulator(sevenChannels(), {}).respond(rasterScene(96));
  constexpr double Square = 0.1;
  for (Eigen::Index k = 0; k < straight.rows(); ++k)
  {
    const Eigen::ArrayXd u = straight.row(k).transpose().array() - sevenChannels().dark()[k];
    const Eigen::ArrayXd squared = u.square();
    const Eigen::ArrayXd off = u - u.mean();
    const double slope = (off * squared).sum() / off.square().sum();
    for (Eigen::Index j = 0; j < capture.readings.cols(); ++j)
    {
      const Eigen::Index sample = capture.sampleOf[static_cast<std::size_t>(j)];
      capture.readings(k, j) += Square * (squared[sample] - squared.mean() - slope * off[sample]);
    }
  }
  const msi::GapReport report = *msi::diagnoseSamples(capture);
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "detector_nonlinearity");
  EXPECT_EQ(report.causes.front().form, "fitted");
  EXPECT_NEAR(report.causes.front().parameters.front().value, Square, 0.01);
}

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
