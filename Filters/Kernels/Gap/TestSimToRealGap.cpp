#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/SimToRealGap.h"

#include "Kernels/Camera/CameraDesign.h"
#include "Kernels/Colorimetry/Illuminant.h"
#include "Kernels/Gap/Samples/GapTestData.h"
#include "Kernels/Gap/Samples/NextCapture.h"
#include "Kernels/Numerics/CounterRandom.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <atomic>
#include <cmath>
#include <functional>
#include <limits>
#include <mutex>
#include <thread>
#include <utility>
#include <vector>

namespace
{

using namespace msi::test;
using msi::GapVerdict;

// Of which of these is the cause, bits.
double entropyOf(const msi::GapReport& report, const std::vector<std::string>& effects)
{
  double all = 0.0;
  for (const std::string& effect : effects)
  {
    all += report.probabilityOf(effect);
  }
  double bits = 0.0;
  for (const std::string& effect : effects)
  {
    const double p = report.probabilityOf(effect) / all;
    bits -= p > 0.0 ? p * std::log2(p) : 0.0;
  }
  return bits;
}

constexpr double NotMeasured = std::numeric_limits<double>::quiet_NaN();

TEST(SimToRealGap, NoGapIsQuiet)
{
  const msi::GapReport report = diagnosisOf(captureWith({}));
  EXPECT_EQ(report.verdict, GapVerdict::NoGap);
  EXPECT_STREQ(msi::nameOf(report.verdict), "no gap");
  EXPECT_TRUE(report.causes.empty());
  EXPECT_TRUE(report.correction.empty());
  EXPECT_EQ(report.gap.shrink, 0.0);
  EXPECT_TRUE(report.changePoints.empty());
  EXPECT_GT(report.probabilityOf("nothing"), 0.5);
  EXPECT_EQ(report.probabilityOf("unknown"), 0.0);
  // The mean of two readings of 0.0005 each.
  EXPECT_NEAR(report.gap.rmsBefore, TestReadNoise / std::sqrt(2.0), 0.1 * TestReadNoise);
  EXPECT_NEAR(report.gap.noiseFloor, report.gap.rmsBefore, 0.1 * TestReadNoise);
}

TEST(SimToRealGap, OneEffectIsNamedMeasuredAndPutBack)
{
  const std::vector<msi::CameraEffect> planted{ { "detector_nonlinearity", "gamma", "", { 0.9 } } };
  const msi::GapCapture capture = captureWith(planted);
  const msi::GapReport report = diagnosisOf(capture);
  ASSERT_EQ(report.verdict, GapVerdict::Explained);
  ASSERT_EQ(report.causes.size(), 1U);
  const msi::GapCause& cause = report.causes.front();
  EXPECT_EQ(cause.effect, "detector_nonlinearity");
  EXPECT_EQ(cause.form, "gamma");
  EXPECT_LE(cause.equivalent.size(), 2U);
  EXPECT_GT(cause.probability, 0.9);
  EXPECT_NEAR(
    cause.parameters.front().value, 0.9, 3.0 * cause.parameters.front().standardError + 0.001);
  EXPECT_GT(report.gap.shrink, 0.95);
  EXPECT_LE(report.gap.shrinkInterval[0], report.gap.shrink);
  EXPECT_GE(report.gap.shrinkInterval[1], report.gap.shrink);
  EXPECT_NEAR(cause.share + report.unexplained.share, 1.0, 1e-9);
  // The corrected simulator reproduces the real camera.
  const Eigen::MatrixXd corrected =
    msi::CameraSimulator(capture.camera, report.correction, { report.whiteAfterEffects })
      .respond(rasterScene(96));
  const Eigen::MatrixXd real =
    msi::CameraSimulator(capture.camera, planted).respond(rasterScene(96));
  const Eigen::MatrixXd nominal = msi::CameraSimulator(capture.camera, {}).respond(rasterScene(96));
  EXPECT_LT((corrected - real).norm(), 0.03 * (nominal - real).norm());
  EXPECT_EQ(report.gapBefore.rows(), 7);
  EXPECT_EQ(report.gapBefore.cols(), 96);
  EXPECT_LT(report.gapAfter.norm(), 0.2 * report.gapBefore.norm());
}

// A tunable filter before a chart of 24: more numbers of single channels than samples. The camera differs in its passbands, too, so
// that the gains leave more than noise.
TEST(SimToRealGap, GainsOfMoreChannelsThanSamplesAreFound)
{
  const msi::WavelengthGrid& grid = visibleGrid();
  msi::CameraParts parts;
  parts.detector = msi::siliconDetector(grid);
  parts.light = msi::Illuminant::named("A").powerAt(grid);
  msi::CameraParts realParts = parts;
  msi::CameraEffect gains{ "channel_gain", "", "", {} };
  const msi::CounterRandom random(11);
  for (std::uint64_t k = 0; k < 30; ++k)
  {
    const auto normal = random.normalPair(k);
    const double middle = 410.0 + 10.0 * static_cast<double>(k);
    parts.filters.push_back({ middle, 15.0 });
    realParts.filters.push_back({ middle + 0.5 * normal[0], 15.0 });
    gains.parameters.push_back(1.0 + 0.04 * normal[1]);
  }
  const msi::CameraSimulator real(msi::designCamera(grid, realParts), { gains });
  const msi::GapReport report = diagnosisOf(captureFrom(
    msi::designCamera(grid, parts), rasterSamples(24), real.respond(rasterScene(24)), 1));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "channel_gain");
  EXPECT_GT(report.causes.front().share, 0.8);
  EXPECT_GT(report.causes.front().probability, 0.7);
}

// Its spectrum is none of those that the effect knows: the mean of two of them, of different kinds.
TEST(SimToRealGap, ALampOfAnotherKindIsOneCause)
{
  const msi::WavelengthGrid& grid = visibleGrid();
  const auto power = [&grid](const char* name) -> Eigen::VectorXd
  {
    const Eigen::VectorXd all = msi::Illuminant::named(name).powerAt(grid);
    return all / all.mean();
  };
  msi::CameraParts parts;
  parts.detector = msi::siliconDetector(grid);
  parts.filters = { { 460.0, 80.0 }, { 540.0, 90.0 }, { 610.0, 80.0 } };
  parts.light = power("A");
  const msi::CameraModel nominal = msi::designCamera(grid, parts);
  parts.light = power("LED-B2") + power("FL3");
  const msi::CameraSimulator real(msi::designCamera(grid, parts), {});
  msi::GapCapture capture =
    captureFrom(nominal, rasterSamples(96), real.respond(rasterScene(96)), 1);
  for (const bool noiseKnown : { true, false })
  {
    capture.noise = noiseKnown ? capture.noise : std::nullopt;
    const msi::GapReport report = diagnosisOf(capture);
    EXPECT_EQ(report.verdict, GapVerdict::Explained);
    ASSERT_FALSE(report.causes.empty());
    EXPECT_EQ(report.causes.front().effect, "illuminant_drift");
    EXPECT_EQ(report.causes.front().form, "another_lamp");
    EXPECT_GT(report.causes.front().share, 0.8);
    EXPECT_GT(report.causes.front().probability, 0.8);
    // Also where nobody tells the noise.
    EXPECT_LT(report.gap.noiseFloor, 1.1 * report.gap.rmsAfter);
  }
}

// Reflectances as rough as the grid's step, seen through single wavelengths: sums over wavelength may err by more than the offset,
// but not by the same in all samples.
TEST(SimToRealGap, AnOffsetIsNoErrorOfTheSumsOverWavelength)
{
  const msi::WavelengthGrid grid = visibleGrid();
  const msi::CounterRandom random(3);
  Eigen::MatrixXd responsivity = Eigen::MatrixXd::Zero(7, grid.size());
  msi::SceneSamples samples = rasterSamples(96);
  for (Eigen::Index j = 0; j < samples.reflectance.size(); ++j)
  {
    samples.reflectance.data()[j] = 0.3 + 0.2 * random.uniform(static_cast<std::uint64_t>(j));
  }
  std::vector<std::string> channels;
  for (Eigen::Index k = 0; k < 7; ++k)
  {
    responsivity(k, 3 + 4 * k) = 1.0;
    channels.push_back("C" + std::to_string(k + 1));
  }
  const msi::CameraModel camera(grid, responsivity, Eigen::VectorXd::Zero(7), channels);
  const msi::CameraSimulator real(camera, { { "dark_offset", "common", "", { 0.006 } } });
  const msi::GapReport report =
    diagnosisOf(captureFrom(camera, samples, real.respond(msi::SampleScene(grid, samples)), 1));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "dark_offset");
}

// A curve of its own in each channel is in no effect; it is in the corrected simulator where that is asked for.
TEST(SimToRealGap, WhatNoCauseExplainsCanBeAdded)
{
  msi::GapCapture capture = captureWith({});
  const auto bend = [](Eigen::MatrixXd& response)
  {
    const double square[] = { 0.06, -0.05, 0.04, -0.06, 0.05, -0.04, 0.06 };
    for (Eigen::Index k = 0; k < response.rows(); ++k)
    {
      response.row(k).array() += square[k] * response.row(k).array().square();
    }
  };
  bend(capture.readings);
  msi::GapOptions options;
  options.without = { "detector_nonlinearity" };
  msi::GapReport report = diagnosisOf(capture, options);
  EXPECT_NE(report.verdict, GapVerdict::NoGap);
  ASSERT_TRUE(report.unexplained.rmsWithRest);
  EXPECT_GT(report.gap.rmsAfter, 3.0 * TestReadNoise);
  EXPECT_LT(*report.unexplained.rmsWithRest, TestReadNoise);
  Eigen::MatrixXd real = msi::CameraSimulator(capture.camera, {}).respond(rasterScene(96));
  bend(real);
  const auto error = [&]
  {
    return (msi::CameraSimulator(capture.camera, report.correction, { report.whiteAfterEffects })
              .respond(rasterScene(96)) -
      real)
      .norm();
  };
  const double byCauses = error();
  options.addRest = true;
  report = diagnosisOf(capture, options);
  EXPECT_EQ(report.correction.back().name, "unmodelled_response");
  EXPECT_LT(error(), 0.2 * byCauses);
}

TEST(SimToRealGap, WhereTheCausesLeaveNothingNothingIsAdded)
{
  msi::GapOptions options;
  options.addRest = true;
  const msi::GapReport report =
    diagnosisOf(captureWith({ { "dark_offset", "", "", { 0.01 } } }), options);
  EXPECT_FALSE(report.unexplained.rmsWithRest);
  EXPECT_EQ(report.correction.size(), 1U);
}

// Numbers of single channels that follow a line over them: a lamp that becomes redder, lamps of two colours, one curve in counts seen
// by channels of different exposures. That they do makes something unknown no likelier.
TEST(SimToRealGap, NumbersOfChannelsMayFollowACurveWhereTheLightMakesThem)
{
  const auto line = [](double first, double last) -> std::vector<double>
  {
    std::vector<double> values(7);
    for (std::size_t k = 0; k < 7; ++k)
    {
      values[k] = first + (last - first) * static_cast<double>(k) / 6.0;
    }
    return values;
  };
  const auto joined = [](std::vector<double> a, const std::vector<double>& b)
  {
    a.insert(a.end(), b.begin(), b.end());
    return a;
  };
  for (const msi::CameraEffect& planted : { msi::CameraEffect{ "session_drift", "slope_per_channel",
                                              "", joined(line(-0.05, 0.05), { 0.0 }) },
         { "illumination_gradient", "per_channel", "", joined(line(0.0, 0.08), line(0.0, 0.0)) },
         { "vignetting", "per_channel", "", joined(line(0.02, 0.1), { 0.0, 0.0 }) },
         { "dark_offset", "plane", "",
           joined(joined(line(0.005, 0.01), line(0.005, 0.01)), line(0.0, 0.0)) },
         { "detector_nonlinearity", "per_channel", "", line(0.02, 0.15) } })
  {
    SCOPED_TRACE(planted.name);
    const msi::GapReport report = diagnosisOf(captureWith({ planted }));
    EXPECT_EQ(report.verdict, GapVerdict::Explained);
    ASSERT_EQ(report.causes.size(), 1U);
    EXPECT_EQ(report.causes.front().effect, planted.name);
    EXPECT_GT(report.causes.front().probability, 0.9);
    EXPECT_LT(report.probabilityOf("unknown"), 0.1);
    EXPECT_GT(report.gap.shrink, 0.95);
  }
}

// Channels that are exposed differently end at different levels, at once or gradually; two reach theirs.
TEST(SimToRealGap, SaturationMayBeAtALevelOfEachChannel)
{
  for (const double softness : { 0.005, 0.1 })
  {
    SCOPED_TRACE(softness);
    const msi::GapReport report = diagnosisOf(captureWith(
      { { "saturation", "per_channel", "", { 1.2, 0.5, 1.2, 1.2, 0.6, 1.2, 1.2, softness } } }));
    EXPECT_EQ(report.verdict, GapVerdict::Explained);
    ASSERT_FALSE(report.causes.empty());
    EXPECT_EQ(report.causes.front().effect, "saturation");
    EXPECT_GT(report.causes.front().share, 0.9);
  }
}

TEST(CausesOfAGap, TwoEffectsShareTheGap)
{
  const msi::GapReport report = diagnosisOf(captureWith(
    { { "illumination_gradient", "", "", { 0.05, 0.0 } }, { "dark_offset", "", "", { 0.01 } } }));
  ASSERT_EQ(report.verdict, GapVerdict::Explained);
  std::vector<std::string> names;
  double sum = 0.0;
  for (const msi::GapCause& cause : report.causes)
  {
    names.push_back(cause.effect);
    sum += cause.share;
  }
  std::sort(names.begin(), names.end());
  EXPECT_EQ(names, (std::vector<std::string>{ "dark_offset", "illumination_gradient" }));
  EXPECT_NEAR(sum, report.gap.shrink, 1e-9);
  EXPECT_NEAR(sum + report.unexplained.share, 1.0, 1e-9);
}

// Responses in another unit, or another exposure, of all channels or of each: a gradient of 5 % is a fiftieth of that gap.
TEST(CausesOfAGap, ALargeGainHidesNothing)
{
  const msi::CameraEffect gradient{ "illumination_gradient", "", "", { 0.05, 0.0 } };
  for (const msi::CameraEffect& gain : { msi::CameraEffect{ "exposure_gain", "", "", { 0.4 } },
         msi::CameraEffect{ "channel_gain", "", "", { 0.4, 1.6, 0.9, 1.2, 0.5, 1.7, 0.7 } } })
  {
    const msi::GapReport report = diagnosisOf(captureWith({ gain, gradient }));
    EXPECT_EQ(report.verdict, GapVerdict::Explained);
    ASSERT_EQ(report.causes.size(), 2U) << gain.name;
    ASSERT_EQ(report.correction.size(), 2U) << gain.name;
    EXPECT_EQ(report.causes.front().effect, gain.name);
    EXPECT_EQ(report.causes.back().effect, gradient.name);
    for (const msi::CameraEffect& effect : report.correction)
    {
      const double planted = (effect.name == gain.name ? gain : gradient).parameters.front();
      EXPECT_NEAR(effect.parameters.front(), planted, 0.002) << effect.name;
    }
  }
}

// A Gaussian passband times an exponential of the wavelength is the passband moved: with white balanced again a tilt of the
// lamp and a small shift of the filters do the same.
TEST(CausesOfAGap, WhatIsTheSameForGaussianPassbandsIsSaidToBe)
{
  const msi::GapReport report = diagnosisOf(captureWith({ { "filter_shift", "", "", { 1.0 } } }));
  ASSERT_EQ(report.verdict, GapVerdict::Explained);
  const msi::GapCause& cause = report.causes.front();
  EXPECT_TRUE(cause.effect == "filter_shift" || says(cause.equivalent, "filter_shift"));
  EXPECT_TRUE(cause.effect == "illuminant_drift" || says(cause.equivalent, "illuminant_drift"));
  EXPECT_GT(report.probabilityOf("filter_shift") + report.probabilityOf("illuminant_drift"), 0.9);
}

// A camera that was fitted as linear to a curved detector differs from it by the curve less its line alone: that, with this
// weight of the square, in the readings.
void curveBehindLinearFit(msi::GapCapture& capture, double square)
{
  const Eigen::MatrixXd straight =
    msi::CameraSimulator(sevenChannels(), {}).respond(rasterScene(96));
  for (Eigen::Index k = 0; k < straight.rows(); ++k)
  {
    const Eigen::ArrayXd u = straight.row(k).transpose().array() - sevenChannels().dark()[k];
    const Eigen::ArrayXd squared = u.square();
    const Eigen::ArrayXd off = u - u.mean();
    const double slope = (off * squared).sum() / off.square().sum();
    for (Eigen::Index j = 0; j < capture.readings.cols(); ++j)
    {
      const Eigen::Index sample = capture.sampleOf[static_cast<std::size_t>(j)];
      capture.readings(k, j) += square * (squared[sample] - squared.mean() - slope * off[sample]);
    }
  }
}

TEST(CausesOfAGap, ACurveBehindALinearFitIsOneCause)
{
  msi::GapCapture capture = captureWith({}, 96);
  curveBehindLinearFit(capture, 0.1);
  const msi::GapReport report = diagnosisOf(capture);
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "detector_nonlinearity");
  EXPECT_EQ(report.causes.front().form, "fitted");
  EXPECT_NEAR(report.causes.front().parameters.front().value, 0.1, 0.01);
  EXPECT_TRUE(says(report.notes, "linear fit to responses that are curved"));
}

// How the simulated camera was made is said after what is new, however much of the gap it is.
TEST(CausesOfAGap, ACurveBehindALinearFitComesAfterWhatHasChanged)
{
  msi::GapCapture capture = captureWith({ { "dark_offset", "", "", { 0.002 } } }, 96);
  curveBehindLinearFit(capture, 0.1);
  const msi::GapReport report = diagnosisOf(capture);
  ASSERT_EQ(report.causes.size(), 2U);
  EXPECT_EQ(report.causes[0].effect, "dark_offset");
  EXPECT_EQ(report.causes[1].form, "fitted");
  EXPECT_LT(report.causes[0].share, report.causes[1].share);
}

// The detector has changed its curve since the camera was fitted as linear: one effect, and no offset to mend it.
TEST(CausesOfAGap, ACurveMayChangeBehindALinearFit)
{
  msi::GapCapture capture = captureWith({}, 96);
  curveBehindLinearFit(capture, 0.1);
  capture.readings.array() -= 0.1 * capture.readings.array().square();
  const msi::GapReport report = diagnosisOf(capture);
  ASSERT_EQ(report.correction.size(), 2U);
  for (const msi::CameraEffect& effect : report.correction)
  {
    EXPECT_EQ(effect.name, "detector_nonlinearity");
  }
  EXPECT_NE(report.correction[0].form, report.correction[1].form);
  EXPECT_EQ(report.causes.front().form, "quadratic");
  EXPECT_NEAR(report.causes.front().parameters.front().value, -0.1, 0.01);
}

// With one medium a gain of the medium and of the exposure are the same numbers.
TEST(CausesOfAGap, WhatThisCaptureCannotTellApartIsSaid)
{
  msi::SceneSamples samples = rasterSamples(96);
  samples.medium.assign(96, "paper");
  const msi::GapReport report =
    diagnosisOf(captureOf(samples, { { "exposure_gain", "", "", { 1.05 } } }));
  ASSERT_EQ(report.verdict, GapVerdict::Explained);
  EXPECT_EQ(report.causes.front().effect, "exposure_gain");
  EXPECT_TRUE(says(report.causes.front().equivalent, "medium_gain"));
  ASSERT_FALSE(report.nextCaptures.empty());
  // A white tile is not of that medium, and its light is that of the lamp. A dark frame tells nothing of gains, and the same chart
  // nothing new.
  EXPECT_EQ(report.nextCaptures.front().capture, "lamp spectrum, white tile");
  EXPECT_TRUE(says(report.nextCaptures.front().separates, "medium_gain"));
  EXPECT_GT(*report.nextCaptures.front().expectedBits,
    entropyOf(report, { "exposure_gain", "medium_gain", "illuminant_drift" }) - 0.1);
  for (const msi::GapNextCapture& next : report.nextCaptures)
  {
    EXPECT_NE(next.capture, "lens cap");
    EXPECT_NE(next.capture, "chart rotated by 180 degrees");
  }
  EXPECT_TRUE(says(report.notes, "One medium only"));
}

// Responsivities that alternate where no sample looks, as a fit with little regularization leaves them, answer to the samples alike.
TEST(CausesOfAGap, AFitThatAlternatesHidesNoGap)
{
  msi::GapCapture capture =
    captureWith({ { "channel_gain", "", "", { 1.03, 0.98, 1.0, 1.04, 0.97, 1.01, 0.96 } } }, 96);
  EXPECT_FALSE(says(diagnosisOf(capture).notes, "negative in part"));
  const Eigen::MatrixXd& seen = capture.samples.reflectance;
  Eigen::VectorXd unseen = Eigen::VectorXd::Ones(seen.rows());
  unseen(Eigen::seq(1, Eigen::last, 2)).setConstant(-1.0);
  unseen -= seen * seen.completeOrthogonalDecomposition().solve(unseen);
  ASSERT_GT(unseen.norm(), 1.0);
  const Eigen::MatrixXd responsivity = capture.camera.responsivity();
  capture.camera =
    capture.camera.with(responsivity + 2.0 * responsivity.rowwise().maxCoeff() * unseen.transpose(),
      capture.camera.dark());
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "channel_gain");
  EXPECT_TRUE(says(report.notes, "7 of 7 channels have responsivities that are negative in part"));
}

TEST(CausesOfAGap, ACameraFarFromWhiteIsSaid)
{
  const msi::GapCapture capture = captureWith({ { "exposure_gain", "", "", { 1.05 } } }, 96);
  EXPECT_FALSE(says(diagnosisOf(capture).notes, "to a perfect white"));
  msi::GapCapture quarter = capture;
  quarter.camera =
    capture.camera.with(0.25 * capture.camera.responsivity(), 0.25 * capture.camera.dark());
  quarter.readings *= 0.25;
  EXPECT_TRUE(says(diagnosisOf(quarter).notes, "answers 0.25 to a perfect white"));
}

TEST(CausesOfAGap, CurvesInOtherUnitsThanTheReadingsAreSaid)
{
  msi::GapCapture capture = captureWith({ { "exposure_gain", "", "", { 1.05 } } }, 96);
  const Eigen::MatrixXd curves = capture.camera.responsivity();
  const Eigen::ArrayXd peak = curves.rowwise().maxCoeff();
  capture.camera = capture.camera.with(
    peak.inverse().matrix().asDiagonal() * curves, (capture.camera.dark().array() / peak).matrix());
  EXPECT_TRUE(says(diagnosisOf(capture).notes, "Units? The curves of the simulated camera give"));
}

TEST(CausesOfAGap, ALidWithoutAPlaceLeavesTheChartItsPlaces)
{
  const msi::SceneSamples chart = rasterSamples(96);
  msi::SceneSamples lid;
  lid.reflectance = Eigen::MatrixXd::Zero(chart.reflectance.rows(), 3);
  msi::GapCapture capture =
    captureOf(msi::joined(chart, lid), { { "vignetting", "", "", { 0.3, 0.0, 0.0 } } });
  for (Eigen::VectorXd* column : { &capture.samples.x, &capture.samples.y, &capture.samples.order })
  {
    column->tail(3).setConstant(std::numeric_limits<double>::quiet_NaN());
  }
  const msi::GapReport report = diagnosisOf(capture);
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "vignetting");
  EXPECT_TRUE(
    says(report.notes, "3 of 99 samples have no position: they are taken to be in the middle"));
  EXPECT_TRUE(says(
    report.notes, "3 of 99 samples have no capture order: they are taken to be captured first"));
}

// A gain of its own for each sample: in no library.
TEST(DoubtsOfAGap, UnknownIsCalledUnknown)
{
  msi::GapCapture capture = captureWith({});
  for (Eigen::Index j = 0; j < capture.readings.cols(); ++j)
  {
    const int sample = capture.sampleOf[static_cast<std::size_t>(j)];
    capture.readings.col(j) *= sample * 7 % 12 < 6 ? 1.04 : 0.96;
  }
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_EQ(report.verdict, GapVerdict::Unexplained);
  EXPECT_TRUE(report.causes.empty());
  EXPECT_DOUBLE_EQ(report.unexplained.share, 1.0);
  EXPECT_FALSE(report.unexplained.where.empty());
  EXPECT_GT(report.probabilityOf("unknown"), 0.85);
  ASSERT_FALSE(report.unexplained.dependsOn.empty());
  EXPECT_EQ(report.unexplained.dependsOn.front().first, "sample");
  ASSERT_FALSE(report.where.empty());
  EXPECT_EQ(report.where.front().axis, "sample");
}

TEST(DoubtsOfAGap, AnEffectLeftOutIsNotBlamed)
{
  const msi::GapCapture capture =
    captureWith({ { "illumination_gradient", "", "", { 0.06, 0.02 } } });
  ASSERT_EQ(diagnosisOf(capture).causes.front().effect, "illumination_gradient");
  msi::GapOptions options;
  options.without = { "illumination_gradient" };
  const msi::GapReport report = diagnosisOf(capture, options);
  EXPECT_TRUE(
    report.verdict == GapVerdict::Unexplained || report.verdict == GapVerdict::PartlyExplained);
  for (const msi::GapCause& cause : report.causes)
  {
    EXPECT_NE(cause.effect, "illumination_gradient");
    EXPECT_LT(cause.probability, 0.5);
  }
  EXPECT_EQ(report.where.front().axis, "position");
}

TEST(DoubtsOfAGap, ScatterBeyondTheNoiseModelIsExcessNoise)
{
  msi::GapCapture capture = captureOf(rasterSamples(96), {}, 4, 0.002);
  capture.noise = msi::CameraNoise{ 0.001, 0.0 };
  const msi::GapReport report = diagnosisOf(capture);
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "excess_noise");
  EXPECT_NEAR(report.causes.front().parameters.front().value, 2.0,
    4.0 * report.causes.front().parameters.front().standardError);
  EXPECT_EQ(report.probabilityOf("excess_noise"), 1.0);
  EXPECT_EQ(report.probabilityOf("nothing"), 0.0);
  msi::GapOptions options;
  options.without = { "excess_noise" };
  const msi::GapReport barred = diagnosisOf(capture, options);
  EXPECT_EQ(barred.verdict, GapVerdict::Unexplained);
  EXPECT_NE(barred.unexplained.where.find("scatter between repeats"), std::string::npos)
    << barred.unexplained.where;
  EXPECT_GT(barred.probabilityOf("unknown"), 0.5);
  EXPECT_TRUE(barred.causes.empty());
}

// Scatter of single readings beyond the noise model may be noise, or not: what a cause leaves to it is in doubt.
TEST(DoubtsOfAGap, WhatACauseLeavesToScatterIsInDoubt)
{
  const auto unknownBeside = [](double readNoise)
  {
    msi::GapCapture capture =
      captureOf(rasterSamples(96), { { "exposure_gain", "", "", { 1.1 } } }, 1, readNoise);
    capture.noise = msi::CameraNoise{ 0.001, 0.0 };
    return diagnosisOf(capture);
  };
  const msi::GapReport calm = unknownBeside(0.001);
  EXPECT_EQ(calm.causes.size(), 1U);
  EXPECT_LT(calm.probabilityOf("unknown"), 0.1);
  const msi::GapReport scattered = unknownBeside(0.008);
  ASSERT_EQ(scattered.causes.size(), 2U);
  EXPECT_EQ(scattered.causes[1].effect, "excess_noise");
  // Odds of three times the part of the gap that is not explained for sure.
  const double unsure = scattered.causes[1].share * (1.0 - msi::Decision::Unconfirmed);
  EXPECT_GT(scattered.probabilityOf("unknown"), 3.0 * unsure / (1.0 + 3.0 * unsure) - 0.02);
}

// Without a noise model and repeats all that nothing predicts is taken for noise; it may be something else.
TEST(DoubtsOfAGap, WhatIsTakenForNoiseIsInDoubt)
{
  const auto diagnosed = [](double readNoise, bool known)
  {
    msi::GapCapture capture =
      captureOf(rasterSamples(96), { { "exposure_gain", "", "", { 1.03 } } }, 1, readNoise);
    if (!known)
    {
      capture.noise.reset();
    }
    return diagnosisOf(capture);
  };
  const msi::GapReport known = diagnosed(0.006, true);
  const msi::GapReport taken = diagnosed(0.006, false);
  ASSERT_EQ(known.causes.size(), 1U);
  ASSERT_EQ(taken.causes.size(), 1U);
  EXPECT_GT(taken.gap.shrink, 0.9);
  EXPECT_LT(known.probabilityOf("unknown"), 0.1);
  EXPECT_LT(diagnosed(0.001, false).probabilityOf("unknown"), 0.1);
  EXPECT_TRUE(says(taken.notes, "Noise? No noise model"));
  const double part = std::pow(taken.gap.noiseFloor / taken.gap.rmsBefore, 2);
  const double unsure = part * (taken.gap.shrink - msi::Decision::Unconfirmed);
  EXPECT_GT(taken.probabilityOf("unknown"), 3.0 * unsure / (1.0 + 3.0 * unsure) - 0.02);
}

TEST(DoubtsOfAGap, TheSameBytesOnManyThreadsAndOne)
{
  const msi::GapCapture capture = captureWith({ { "medium_gain", "", "fabric", { 0.94 } } }, 48);
  const msi::GapReport alone = diagnosisOf(capture);
  std::mutex mutex;
  msi::GapOptions options;
  std::atomic<int> steps{ 0 };
  options.progress = [&steps](double fraction, const char*)
  {
    ++steps;
    return fraction >= 0.0 && fraction <= 1.0;
  };
  options.exclusive = [&mutex](const std::function<void()>& body)
  {
    const std::lock_guard<std::mutex> lock(mutex);
    body();
  };
  options.parallelFor = [](int count, const std::function<void(int)>& body)
  {
    std::vector<std::thread> threads;
    for (int i = count - 1; i >= 0; --i)
    {
      threads.emplace_back([&body, i] { body(i); });
    }
    for (std::thread& thread : threads)
    {
      thread.join();
    }
  };
  const msi::GapReport parallel = diagnosisOf(capture, options);
  EXPECT_GT(steps, 0);
  EXPECT_EQ(alone.verdict, parallel.verdict);
  EXPECT_EQ(alone.gap.shrink, parallel.gap.shrink);
  EXPECT_EQ(alone.gap.shrinkInterval, parallel.gap.shrinkInterval);
  EXPECT_EQ(alone.gapAfter, parallel.gapAfter);
  ASSERT_EQ(alone.causes.size(), parallel.causes.size());
  EXPECT_EQ(alone.causes.front().parameters.front().value,
    parallel.causes.front().parameters.front().value);
}

// Two effects of the surface can imitate a third to the last: r (1 - p) / (1 - p r) is a gain and a loss that grows with r.
TEST(DoubtsOfAGap, DoubtsTwoAlikeEffectsOfOneMedium)
{
  msi::GapOptions options;
  options.without = { "interreflection" };
  const msi::GapReport report =
    diagnosisOf(captureWith({ { "interreflection", "", "fabric", { 0.25 } } }, 192), options);
  EXPECT_GT(report.probabilityOf("unknown"), 0.2);
  for (const msi::GapCause& cause : report.causes)
  {
    EXPECT_LT(cause.probability, 0.8) << cause.effect;
  }
}

TEST(DoubtsOfAGap, StopsWhenAskedTo)
{
  msi::GapOptions options;
  options.progress = [](double, const char*) { return false; };
  EXPECT_FALSE(msi::diagnoseGap(captureWith({}, 24), options).has_value());
}

TEST(DoubtsOfAGap, RefusesWhatDisagreesAndSaysWhat)
{
  const auto message = [](const auto& change)
  {
    msi::GapCapture capture = captureWith({}, 12);
    msi::GapOptions options;
    change(capture, options);
    return messageOf([&] { msi::diagnoseGap(capture, options); });
  };
  using Capture = msi::GapCapture;
  using Options = msi::GapOptions;
  EXPECT_EQ(message([](Capture& c, Options&) { c.readings = c.readings.topRows(6).eval(); }),
    "the camera has 7 channels but the readings have 6");
  EXPECT_EQ(message([](Capture& c, Options&) { c.sampleOf.pop_back(); }),
    "there are 24 readings but 23 sample numbers for them");
  EXPECT_EQ(message([](Capture& c, Options&) { c.sampleOf[4] = 12; }),
    "reading 5 belongs to sample number 12 but there are only 12 samples, counted from 0");
  EXPECT_EQ(message([](Capture& c, Options&)
              { c.wavelengths = msi::WavelengthGrid::uniform(400.0, 700.0, 20.0); }),
    "the samples' reflectances have 31 wavelengths, their grid 16");
  EXPECT_EQ(message([](Capture&, Options& o) { o.without = { "gremlins" }; }),
    "there is no effect 'gremlins' to leave out");
  EXPECT_EQ(
    message([](Capture& c, Options&) { c.readings.rightCols(22).setConstant(NotMeasured); }),
    "a diagnosis needs 2 samples or more with reading and reflectance; 1 of 12 have both");
}

TEST(DegenerateCapture, OneReadingAndNoNoiseModel)
{
  msi::GapCapture capture =
    captureOf(rasterSamples(96), { { "exposure_gain", "", "", { 1.06 } } }, 1);
  capture.noise.reset();
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_TRUE(says(report.notes, "No noise model and one reading a sample"));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  EXPECT_EQ(report.causes.front().effect, "exposure_gain");
}

// Channels are read one by one: their noise is independent, a sample's own gain is not.
TEST(DoubtsOfAGap, WithoutNoiseModelWhatChannelsShareIsAGap)
{
  msi::GapCapture capture = captureOf(rasterSamples(96), {}, 1, 0.01);
  capture.noise.reset();
  EXPECT_EQ(diagnosisOf(capture).verdict, GapVerdict::NoGap);
  capture = captureOf(rasterSamples(96), {}, 1);
  capture.noise.reset();
  const msi::CounterRandom random(7, 1);
  for (Eigen::Index j = 0; j < capture.readings.cols(); ++j)
  {
    capture.readings.col(j) *= 1.0 + 0.05 * random.normal(static_cast<std::uint64_t>(j));
  }
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_EQ(report.verdict, GapVerdict::Unexplained);
  EXPECT_EQ(report.where.front().axis, "sample");
}

TEST(DegenerateCapture, NoMediaNoPositionsNoOrder)
{
  msi::SceneSamples samples;
  samples.reflectance = rasterSamples(96).reflectance;
  const msi::GapReport report =
    diagnosisOf(captureOf(samples, { { "detector_nonlinearity", "gamma", "", { 0.9 } } }));
  EXPECT_TRUE(says(report.notes, "The samples name no medium"));
  EXPECT_TRUE(says(report.notes, "No positions"));
  EXPECT_TRUE(says(report.notes, "No capture order"));
  EXPECT_TRUE(says(report.notes, "One scene only"));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "detector_nonlinearity");
}

TEST(DegenerateCapture, FewerSamplesThanParameters)
{
  const msi::GapReport report =
    diagnosisOf(captureWith({ { "exposure_gain", "", "", { 1.08 } } }, 4));
  EXPECT_TRUE(says(report.notes, "samples are few"));
  EXPECT_NE(report.verdict, GapVerdict::NoGap);
  EXPECT_TRUE(report.gapAfter.allFinite());
  EXPECT_TRUE(std::isfinite(report.gap.shrink));
}

TEST(DegenerateCapture, TwoSamplesAndOneChannel)
{
  msi::GapCapture whole = captureWith({ { "exposure_gain", "", "", { 1.1 } } }, 2);
  const msi::CameraModel one(
    visibleGrid(), whole.camera.responsivity().topRows(1), whole.camera.dark().head(1));
  const msi::GapCapture capture{ one, whole.wavelengths, whole.samples, whole.readings.topRows(1),
    whole.sampleOf, whole.noise };
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_TRUE(says(report.notes, "samples are few"));
  EXPECT_TRUE(std::isfinite(report.gap.rmsBefore));
}

TEST(DegenerateCapture, ConstantReflectance)
{
  msi::SceneSamples samples = rasterSamples(48);
  samples.reflectance.setConstant(0.5);
  const msi::GapReport report =
    diagnosisOf(captureOf(samples, { { "illumination_gradient", "", "", { 0.05, 0.0 } } }));
  EXPECT_TRUE(says(report.notes, "hardly change with wavelength"));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "illumination_gradient");
}

TEST(DegenerateCapture, SaturatedReadings)
{
  msi::GapCapture capture = captureWith({});
  const double limit = 0.8 * capture.readings.maxCoeff();
  capture.readings = capture.readings.cwiseMin(limit);
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_TRUE(says(report.notes, "look clipped"));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "saturation");
}

// A reading of something else than the sample, as behind a wrong label, would hide every cause.
TEST(DegenerateCapture, AnOddSampleIsNamedAndLeftOut)
{
  const std::vector<msi::CameraEffect> planted{ { "detector_nonlinearity", "gamma", "",
    { 0.95 } } };
  msi::GapCapture capture = captureWith(planted);
  capture.readings.middleCols(10, 2) = (1.6 * capture.readings.middleCols(10, 2)).array() + 0.05;
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_TRUE(says(report.notes, "Odd? sample 6 (1 of 96 samples) left out: far from"));
  EXPECT_FALSE(says(report.notes, "no reading or no reflectance"));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "detector_nonlinearity");
  EXPECT_TRUE(report.gapAfter.col(5).array().isNaN().all());
}

// Two labels exchanged: the rest is diagnosed all the same.
TEST(DegenerateCapture, ExchangedSamplesAreNamedAndLeftOut)
{
  msi::GapCapture capture = captureWith({ { "detector_nonlinearity", "gamma", "", { 0.95 } } });
  for (int& sample : capture.sampleOf)
  {
    sample = sample == 5 ? 40 : sample == 40 ? 5 : sample;
  }
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_TRUE(says(report.notes, "Mixed up? Samples sample 6 and sample 41 fit much better"));
  EXPECT_TRUE(says(report.notes, "Odd? sample 6 and sample 41 (2 of 96 samples) left out"));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "detector_nonlinearity");
}

// One of two readings of a sample, nothing in one channel, made a scatter of many times the noise.
TEST(DegenerateCapture, AnOddReadingIsNamedAndLeftOut)
{
  msi::GapCapture capture = captureWith({ { "detector_nonlinearity", "gamma", "", { 0.95 } } });
  capture.readings(2, 11) = 0.0;
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_TRUE(says(report.notes,
    "Odd? A reading of " + capture.camera.channels()[2] +
      " of sample 6 (1 of 1344 readings) left out: far from other readings of the same sample."));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "detector_nonlinearity");
  EXPECT_TRUE(report.gapAfter.allFinite());
}

// A missing value written as 0, which every reading shows.
TEST(DegenerateCapture, AnOddValueIsNamedAndLeftOut)
{
  msi::GapCapture capture = captureWith({ { "detector_nonlinearity", "gamma", "", { 0.95 } } });
  capture.readings.block(2, 10, 1, 2).setZero();
  capture.readings.block(5, 60, 1, 2).setOnes();
  const msi::GapReport report = diagnosisOf(capture);
  const auto& channels = capture.camera.channels();
  EXPECT_TRUE(says(report.notes,
    "Odd? " + channels[2] + " of sample 6 and " + channels[5] +
      " of sample 31 (2 of 672 values) left out: far from"));
  EXPECT_EQ(report.verdict, GapVerdict::Explained);
  ASSERT_EQ(report.causes.size(), 1U);
  EXPECT_EQ(report.causes.front().effect, "detector_nonlinearity");
  EXPECT_EQ(report.gapAfter.array().isNaN().count(), 2);
}

TEST(DegenerateCapture, OddSamplesAloneAreTheGap)
{
  msi::GapCapture capture = captureWith({});
  capture.readings.middleCols(10, 2) = (1.6 * capture.readings.middleCols(10, 2)).array() + 0.05;
  capture.readings.middleCols(40, 2).reverseInPlace();
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_EQ(report.verdict, GapVerdict::Unexplained);
  EXPECT_TRUE(report.causes.empty());
  EXPECT_EQ(report.unexplained.where, "sample 21");
  EXPECT_TRUE(says(report.notes,
    "Odd? sample 6 and sample 21 (2 of 96 samples), without which there is no gap: far"));
}

// What a medium does is checked on samples of it that were left out.
TEST(DegenerateCapture, AMediumOfOneSampleIsNotBlamed)
{
  msi::GapCapture capture = captureWith({ { "exposure_gain", "", "", { 1.05 } } }, 48);
  for (std::size_t i = 0; i < capture.samples.medium.size(); ++i)
  {
    capture.samples.medium[i] = "medium " + std::to_string(i);
  }
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_TRUE(says(report.notes, "48 of 48 media have one sample"));
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "exposure_gain");
}

TEST(DegenerateCapture, ANoiseModelThatIsTooLargeIsDoubted)
{
  for (const int repeats : { 1, 2 })
  {
    msi::GapCapture capture =
      captureOf(rasterSamples(96), { { "exposure_gain", "", "", { 1.02 } } }, repeats);
    EXPECT_FALSE(says(diagnosisOf(capture).notes, "Noise?"));
    capture.noise = msi::CameraNoise{ 0.02, 0.0 };
    EXPECT_TRUE(says(diagnosisOf(capture).notes,
      repeats == 1 ? "Noise? The gap is smaller" : "Noise? The repeats scatter 0.02"));
  }
}

TEST(DegenerateCapture, PartsThatWereNotMeasured)
{
  msi::GapCapture capture = captureWith({ { "exposure_gain", "", "", { 1.05 } } });
  capture.readings.row(2).setConstant(NotMeasured);
  capture.readings.leftCols(20).setConstant(NotMeasured);
  capture.samples.reflectance(3, 50) = NotMeasured;
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_TRUE(says(report.notes, "11 of 96 samples have no reading or no reflectance"));
  EXPECT_EQ(report.causes.front().effect, "exposure_gain");
  EXPECT_TRUE(report.gapBefore.row(2).array().isNaN().all());
  EXPECT_TRUE(std::isfinite(report.gapBefore(0, 20)));
}

// Whatever stands in the readings: figures that are numbers, or an error that says what is wrong.
TEST(DegenerateCapture, ImpossibleReadingsGiveNumbersOrAnError)
{
  using Change = std::function<void(msi::GapCapture&)>;
  const double infinite = std::numeric_limits<double>::infinity();
  const std::vector<std::pair<const char*, Change>> changes{
    { "an infinite reading", [=](msi::GapCapture& c) { c.readings(2, 5) = infinite; } },
    { "an infinite reflectance",
      [=](msi::GapCapture& c) { c.samples.reflectance(4, 7) = -infinite; } },
    { "a dead channel", [](msi::GapCapture& c) { c.readings.row(1).setZero(); } },
    { "readings of 0", [](msi::GapCapture& c) { c.readings.setZero(); } },
    { "readings times 1e30", [](msi::GapCapture& c) { c.readings *= 1e30; } },
    { "readings times 1e-30", [](msi::GapCapture& c) { c.readings *= 1e-30; } },
    { "one reading of 1e30", [](msi::GapCapture& c) { c.readings(0, 0) = 1e30; } },
    { "one sample again and again",
      [](msi::GapCapture& c)
      {
        c.samples.reflectance =
          c.samples.reflectance.col(0).replicate(1, c.samples.reflectance.cols()).eval();
        c.readings = c.readings.col(0).replicate(1, c.readings.cols()).eval();
      } },
    { "reflectances times 1e-30", [](msi::GapCapture& c) { c.samples.reflectance *= 1e-30; } },
  };
  for (const auto& [name, change] : changes)
  {
    SCOPED_TRACE(name);
    msi::GapCapture capture = captureWith({ { "exposure_gain", "", "", { 1.05 } } }, 16);
    change(capture);
    try
    {
      const msi::GapReport report = diagnosisOf(capture);
      EXPECT_TRUE(std::isfinite(report.gap.rmsBefore));
      EXPECT_TRUE(std::isfinite(report.gap.noiseFloor));
      EXPECT_TRUE(std::isfinite(report.gap.shrink));
      EXPECT_TRUE(std::isfinite(report.unexplained.share));
      for (const msi::GapCause& cause : report.causes)
      {
        EXPECT_TRUE(std::isfinite(cause.share)) << cause.effect;
        EXPECT_TRUE(std::isfinite(cause.probability)) << cause.effect;
      }
    }
    catch (const std::invalid_argument& error)
    {
      EXPECT_GT(std::string(error.what()).size(), 20U) << error.what();
    }
  }
}

TEST(MisreadCapture, AChartTurnedByHalfATurnIsMixedUp)
{
  msi::GapCapture capture = captureWith({ { "exposure_gain", "", "", { 0.9 } } });
  EXPECT_FALSE(says(diagnosisOf(capture).notes, "Mixed up?"));
  for (int& sample : capture.sampleOf)
  {
    sample = 95 - sample;
  }
  // rasterSamples() has a row after the other, so that turned is in reverse order, too.
  EXPECT_TRUE(says(diagnosisOf(capture).notes, "Mixed up? The samples fit much better in reverse"));
}

// Filters that moved by a whole filter would explain them as well.
TEST(MisreadCapture, ExchangedChannelsPutTheCausesInDoubt)
{
  msi::GapCapture capture = captureWith({ { "exposure_gain", "", "", { 0.9 } } });
  EXPECT_LT(diagnosisOf(capture).probabilityOf("unknown"), 0.2);
  capture.readings.row(2).swap(capture.readings.row(3));
  const msi::GapReport report = diagnosisOf(capture);
  EXPECT_TRUE(says(report.notes, "fit much better when they are exchanged"));
  EXPECT_EQ(report.verdict, GapVerdict::Unexplained);
  EXPECT_GE(report.probabilityOf("unknown"), 0.75);
}

// Dark counts over those of white, as with a filter wheel whose exposures differ.
TEST(MisreadCapture, OffsetsThatFollowTheExposureAreDark)
{
  msi::GapCapture capture = captureWith({});
  const Eigen::Index channels = capture.readings.rows();
  capture.readings.colwise() += Eigen::VectorXd::LinSpaced(channels, 0.03, 0.003);
  const msi::GapReport report = diagnosisOf(capture);
  ASSERT_FALSE(report.causes.empty());
  EXPECT_EQ(report.causes.front().effect, "dark_offset");
  EXPECT_LT(report.probabilityOf("unknown"), 0.2);
}

} // namespace
