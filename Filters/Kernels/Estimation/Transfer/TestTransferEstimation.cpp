#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/Transfer/TransferEstimation.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstring>
#include <limits>

namespace
{

using msi::NamedMatrices;
using msi::TransferEstimator;
using msi::test::largestDifference;
using msi::test::messageOf;
using msi::test::randomMatrix;

using msi::test::NaN;

// Smooth reflectances with three degrees of freedom, five channels.
msi::SampleSet smoothSamples(
  Eigen::Index count, unsigned seed, double gain, double offset, double noise)
{
  constexpr Eigen::Index bands = 16;
  const Eigen::MatrixXd position = Eigen::VectorXd::LinSpaced(bands, 0.0, 1.0);
  Eigen::MatrixXd basis(bands, 3);
  basis << Eigen::VectorXd::Ones(bands), (3.0 * position.array()).sin(),
    (6.0 * position.array()).cos();
  const Eigen::MatrixXd weights =
    Eigen::Vector3d(0.15, 0.12, 0.06).asDiagonal() * randomMatrix(3, count, seed);
  Eigen::MatrixXd camera(5, bands);
  for (Eigen::Index k = 0; k < 5; ++k)
  {
    camera.row(k) =
      (-((position.array() - 0.25 * static_cast<double>(k)) / 0.15).square()).exp().transpose();
    camera.row(k) /= camera.row(k).sum();
  }
  msi::SampleSet samples;
  samples.reflectance = (0.4 + (basis * weights).array()).matrix();
  samples.response = ((gain * (camera * samples.reflectance)).array() + offset).matrix() +
    noise * randomMatrix(5, count, seed + 1);
  return samples;
}

const msi::TransferFit& exampleFit()
{
  static const msi::TransferFit fit = msi::fitTransfer(
    smoothSamples(60, 1, 1.0, 0.0, 0.002), smoothSamples(10, 3, 1.08, 0.02, 0.002));
  return fit;
}

const Eigen::MatrixXd& exampleResponses()
{
  static const Eigen::MatrixXd responses = smoothSamples(37, 5, 1.08, 0.02, 0.002).response;
  return responses;
}

TEST(TransferEstimation, LearnsTheGainAndOffsetOfTheTarget)
{
  const auto chart = smoothSamples(60, 1, 1.0, 0.0, 0.0);
  const auto target = smoothSamples(200, 5, 1.08, 0.02, 0.0);
  const auto fit = msi::fitTransfer(chart, smoothSamples(10, 3, 1.08, 0.02, 0.0));
  const double rms = std::sqrt((fit.estimator(target.response) - target.reflectance).squaredNorm() /
    static_cast<double>(target.reflectance.size()));
  // Without the target's samples the gain alone costs about 0.03; three degrees of freedom seen by
  // five channels without noise can be told nearly exactly.
  EXPECT_LT(rms, 0.001);
}

TEST(TransferEstimation, EstimatesTheSameWithoutUncertainty)
{
  const msi::SampleSet chart = smoothSamples(40, 5, 1.0, 0.0, 0.0);
  const msi::SampleSet tuning = smoothSamples(8, 6, 1.05, 0.01, 0.002);
  EXPECT_EQ(msi::fitTransfer(chart, tuning, false).estimator(tuning.response),
    msi::fitTransfer(chart, tuning).estimator(tuning.response));
}

// 20 targets of their own gain and offset; share of true values within 90 % intervals over all of them.
double coverage(Eigen::Index tuningSamples)
{
  double inside = 0.0;
  double total = 0.0;
  for (unsigned i = 0; i < 20; ++i)
  {
    const double gain = 1.0 + 0.004 * static_cast<double>(i);
    const auto chart = smoothSamples(40, 100 + 10 * i, 1.0, 0.0, 0.004);
    const auto tuning = smoothSamples(tuningSamples, 103 + 10 * i, gain, 0.01, 0.004);
    const auto target = smoothSamples(50, 106 + 10 * i, gain, 0.01, 0.004);
    const auto fit = msi::fitTransfer(chart, tuning);
    const Eigen::ArrayXXd z = (fit.estimator(target.response) - target.reflectance).array() /
      fit.estimator.standardDeviation(target.response).array();
    inside += static_cast<double>((z.abs() < 1.6449).count());
    total += static_cast<double>(z.size());
  }
  return inside / total;
}

TEST(TransferEstimation, CoversHeldOutSamples)
{
  for (const Eigen::Index tuningSamples : { 6, 8, 12, 24 })
  {
    EXPECT_NEAR(coverage(tuningSamples), 0.9, 0.03) << tuningSamples << " tuning samples";
  }
}

TEST(TransferEstimation, DoesNotDependOnTheUnitOfTheResponse)
{
  auto chart = smoothSamples(40, 11, 1.0, 0.0, 0.002);
  auto tuning = smoothSamples(8, 13, 1.1, 0.01, 0.002);
  const Eigen::MatrixXd before = msi::fitTransfer(chart, tuning).estimator(tuning.response);
  chart.response *= 4096.0;
  tuning.response *= 4096.0;
  const Eigen::MatrixXd after = msi::fitTransfer(chart, tuning).estimator(tuning.response);
  EXPECT_LT(largestDifference(before, after), 1e-6);
}

TEST(TransferEstimation, DoesNotDependOnTheGainOfAChannel)
{
  const Eigen::VectorXd gains = (Eigen::VectorXd(5) << 1.0, 0.01, 80.0, 0.5, 0.002).finished();
  const auto scaled = [&gains](msi::SampleSet samples)
  {
    samples.response = gains.asDiagonal() * samples.response;
    return samples;
  };
  const auto fit = msi::fitTransfer(
    scaled(smoothSamples(60, 1, 1.0, 0.0, 0.002)), scaled(smoothSamples(10, 3, 1.08, 0.02, 0.002)));
  EXPECT_LT(largestDifference(fit.estimator(gains.asDiagonal() * exampleResponses()),
              exampleFit().estimator(exampleResponses())),
    1e-4);
}

TEST(TransferEstimation, FitsTheSameSamplesToTheSameBytes)
{
  const auto again = msi::fitTransfer(
    smoothSamples(60, 1, 1.0, 0.0, 0.002), smoothSamples(10, 3, 1.08, 0.02, 0.002));
  EXPECT_EQ(again.estimator.parameters(), exampleFit().estimator.parameters());
  EXPECT_EQ(again.summary.status, exampleFit().summary.status);
}

TEST(TransferEstimation, ManySamplesRestOnFewPoints)
{
  const auto fit = msi::fitTransfer(
    smoothSamples(500, 15, 1.0, 0.0, 0.004), smoothSamples(100, 17, 1.08, 0.02, 0.004));
  EXPECT_LE(fit.summary.rank, 256);
  EXPECT_EQ(fit.summary.samples, 600);
  const auto target = smoothSamples(100, 19, 1.08, 0.02, 0.004);
  const double rms = std::sqrt((fit.estimator(target.response) - target.reflectance).squaredNorm() /
    static_cast<double>(target.reflectance.size()));
  EXPECT_LT(rms, 0.006);
}

TEST(TransferEstimation, TakesTwoTuningSamplesAndSaysWhatThatIsWorth)
{
  const auto chart = smoothSamples(30, 21, 1.0, 0.0, 0.002);
  const auto tuning = smoothSamples(2, 23, 1.05, 0.0, 0.002);
  const auto fit = msi::fitTransfer(chart, tuning);
  EXPECT_FALSE(fit.summary.complete);
  EXPECT_NE(
    fit.summary.status.find("with fewer than 5 tuning samples the uncertainty is a rough guess"),
    std::string::npos)
    << fit.summary.status;
  EXPECT_TRUE(fit.estimator(tuning.response).allFinite());
  EXPECT_TRUE(fit.estimator.standardDeviation(tuning.response).allFinite());
}

TEST(TransferEstimation, SurvivesDegenerateSamples)
{
  // One sample over and over, a dead channel, responses of zero.
  auto chart = smoothSamples(20, 25, 1.0, 0.0, 0.0).subset(std::vector<Eigen::Index>(20, 0));
  auto tuning = smoothSamples(4, 27, 1.0, 0.0, 0.0);
  EXPECT_TRUE(msi::fitTransfer(chart, tuning).estimator(tuning.response).allFinite());
  chart = smoothSamples(20, 25, 1.0, 0.0, 0.0);
  chart.response.row(2).setZero();
  tuning.response.row(2).setZero();
  EXPECT_TRUE(msi::fitTransfer(chart, tuning).estimator(tuning.response).allFinite());
  chart.response.setZero();
  tuning.response.setZero();
  EXPECT_TRUE(msi::fitTransfer(chart, tuning).estimator(tuning.response).allFinite());
}

// Nothing but the mean to learn: no product in it may have an empty side.
TEST(TransferEstimation, OneFlatSpectrumForAll)
{
  for (const double level : { 0.0, 0.4 })
  {
    for (const double response : { 0.0, 0.3 })
    {
      const msi::SampleSet chart{ Eigen::MatrixXd::Constant(31, 24, level),
        Eigen::MatrixXd::Constant(8, 24, response) };
      const msi::SampleSet tuning{ Eigen::MatrixXd::Constant(31, 6, level),
        Eigen::MatrixXd::Constant(8, 6, response) };
      const msi::TransferFit fit = msi::fitTransfer(chart, tuning);
      const Eigen::MatrixXd estimate = fit.estimator(tuning.response);
      EXPECT_LT((estimate.array() - level).abs().maxCoeff(), 1e-6) << level << ", " << response;
      EXPECT_TRUE(fit.estimator.standardDeviation(tuning.response).allFinite());
    }
  }
}

TEST(TransferEstimation, RefusesBadInputAndSaysWhy)
{
  const auto chart = smoothSamples(20, 29, 1.0, 0.0, 0.0);
  auto tuning = smoothSamples(4, 31, 1.0, 0.0, 0.0);
  EXPECT_EQ(messageOf([&] { msi::fitTransfer(chart, tuning.subset({ 0 })); }),
    "there is 1 tuning sample; the method transfer expects at least 2 samples");
  tuning.response(4, 1) = NaN;
  EXPECT_EQ(messageOf([&] { msi::fitTransfer(chart, tuning); }),
    "tuning sample 2, response channel 5 is nan; expected a finite number");
  tuning.response.conservativeResize(4, Eigen::NoChange);
  EXPECT_EQ(messageOf([&] { msi::fitTransfer(chart, tuning); }),
    "calibration has 5 response channels but tuning has 4; expected the same response channels in "
    "both");
}

TEST(TransferEstimator, IsRebuiltFromItsParametersToTheByte)
{
  const auto& fit = exampleFit();
  const TransferEstimator rebuilt(fit.estimator.parameters());
  EXPECT_EQ(rebuilt(exampleResponses()), fit.estimator(exampleResponses()));
  EXPECT_EQ(rebuilt.standardDeviation(exampleResponses()),
    fit.estimator.standardDeviation(exampleResponses()));
  EXPECT_EQ(rebuilt.bands(), 16);
  EXPECT_EQ(rebuilt.channels(), 5);
}

template <typename Scalar>
using Block = Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>;

// Mean above standard deviation.
template <typename Scalar>
Block<Scalar> meanAndDeviation(const TransferEstimator& estimator, const Block<Scalar>& in)
{
  Block<Scalar> mean(estimator.bands(), in.cols());
  Block<Scalar> deviation(estimator.bands(), in.cols());
  estimator.apply(in.data(), mean.data(), deviation.data(), in.cols());
  Block<Scalar> both(2 * estimator.bands(), in.cols());
  both << mean, deviation;
  return both;
}

template <typename Scalar>
void expectSameBytes()
{
  const auto& estimator = exampleFit().estimator;
  const Block<Scalar> in = exampleResponses().cast<Scalar>();
  const Block<Scalar> whole = meanAndDeviation<Scalar>(estimator, in);
  for (const Eigen::Index piece : { 1, 3, 8, 13 })
  {
    for (Eigen::Index first = 0; first < in.cols(); first += piece)
    {
      const Eigen::Index count = std::min(piece, in.cols() - first);
      EXPECT_EQ(meanAndDeviation<Scalar>(estimator, in.middleCols(first, count)),
        whole.middleCols(first, count));
    }
  }
  msi::test::withLesserInstructionSets(
    [&] { EXPECT_EQ(meanAndDeviation<Scalar>(estimator, in), whole); });
}

TEST(TransferEstimator, SameBytesForAnySplitAndInstructionSet)
{
  expectSameBytes<double>();
  expectSameBytes<float>();
}

// Rms over bands and samples of the difference between float and double blocks.
double floatDifference(const TransferEstimator& estimator, const Eigen::MatrixXd& responses)
{
  const Eigen::MatrixXf in = responses.cast<float>();
  const Eigen::MatrixXf narrow = meanAndDeviation<float>(estimator, in);
  const Eigen::MatrixXd wide = meanAndDeviation<double>(estimator, in.cast<double>());
  EXPECT_EQ(narrow.bottomRows(estimator.bands()), // the deviation is that of double, rounded
    wide.bottomRows(estimator.bands()).cast<float>());
  const Eigen::MatrixXd apart = narrow.cast<double>() - wide;
  return std::sqrt(apart.topRows(estimator.bands()).array().square().mean());
}

TEST(TransferEstimator, FloatBlocksAreWithinTheStatedBound)
{
  EXPECT_LT(floatDifference(exampleFit().estimator, exampleResponses()), 3e-4);
}

TEST(TransferEstimator, FloatBlocksOfRealSamplesAreWithinTheStatedBound)
{
  const auto paper = msi::test::realSamples("hkpolyu/paper.csv");
  const auto cotton = msi::test::realSamples("hkpolyu/cotton.csv");
  if (!paper || !cotton)
  {
    GTEST_SKIP() << "MULTISPECTRAL_DATA is not set";
  }
  std::vector<Eigen::Index> everyTwelfth;
  for (Eigen::Index i = 0; i < paper->size(); i += 12)
  {
    everyTwelfth.push_back(i);
  }
  const std::vector<Eigen::Index> nine{ 0, 2, 4, 6, 8, 10, 12, 14, 15 };
  for (auto [chart, target] : { std::pair(*paper, *cotton), std::pair(*cotton, *paper) })
  {
    const auto fit = msi::fitTransfer(chart, target.subset(everyTwelfth));
    EXPECT_LT(floatDifference(fit.estimator, target.response), 3e-4);
    chart.response = Eigen::MatrixXd(chart.response(nine, Eigen::all));
    target.response = Eigen::MatrixXd(target.response(nine, Eigen::all));
    const auto fitOfNine = msi::fitTransfer(chart, target.subset(everyTwelfth));
    EXPECT_LT(floatDifference(fitOfNine.estimator, target.response), 3e-4);
  }
}

TEST(TransferEstimator, NaNAndInfinityStayInTheirPixelOfFloatBlocks)
{
  const auto& estimator = exampleFit().estimator;
  const Eigen::MatrixXf good = exampleResponses().cast<float>();
  const Eigen::MatrixXf clean = meanAndDeviation<float>(estimator, good);
  for (const float bad : { static_cast<float>(NaN), std::numeric_limits<float>::infinity(),
         -std::numeric_limits<float>::infinity() })
  {
    Eigen::MatrixXf in = good;
    in(2, 10) = bad;
    const Eigen::MatrixXf mean = meanAndDeviation<float>(estimator, in);
    for (Eigen::Index p = 0; p < in.cols(); ++p)
    {
      EXPECT_TRUE(p == 10 ? mean.col(p).array().isNaN().all() : mean.col(p) == clean.col(p));
    }
  }
}

TEST(TransferEstimator, NaNAndInfinityStayInTheirPixel)
{
  const auto& estimator = exampleFit().estimator;
  const Eigen::MatrixXd clean = estimator(exampleResponses());
  for (const double bad :
    { NaN, std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() })
  {
    Eigen::MatrixXd in = exampleResponses();
    in(2, 10) = bad;
    const Eigen::MatrixXd mean = estimator(in);
    const Eigen::MatrixXd deviation = estimator.standardDeviation(in);
    for (Eigen::Index p = 0; p < in.cols(); ++p)
    {
      EXPECT_TRUE(p == 10 ? mean.col(p).array().isNaN().all() : mean.col(p) == clean.col(p));
      EXPECT_EQ(deviation.col(p).array().isNaN().all(), p == 10);
    }
  }
}

TEST(TransferEstimator, RefusesParametersThatDoNotFitAndSaysWhich)
{
  const NamedMatrices good = exampleFit().estimator.parameters();
  const auto with = [&](const std::string& name, const Eigen::MatrixXd& matrix)
  {
    NamedMatrices changed = good;
    changed[name] = matrix;
    return messageOf([&] { TransferEstimator{ changed }; });
  };
  NamedMatrices missing = good;
  missing.erase("squareRoot.center");
  EXPECT_EQ(messageOf([&] { TransferEstimator{ missing }; }),
    "the transfer estimator has no matrix 'squareRoot.center'");
  EXPECT_EQ(with("linear.center", Eigen::MatrixXd::Zero(3, 1)),
    "matrix 'linear.center' of the transfer estimator is 3 x 1; expected 16 x 1, not empty");
  EXPECT_EQ(with("linear.center", Eigen::MatrixXd::Constant(16, 1, NaN)),
    "matrix 'linear.center' of the transfer estimator holds a value that is not finite");
  EXPECT_EQ(with("bandVariance", Eigen::MatrixXd::Constant(16, 1, -1.0)),
    "matrix 'bandVariance' of the transfer estimator holds a negative variance");
  Eigen::MatrixXd scalars = good.at("linear.scalars");
  scalars(4) = 0.0;
  EXPECT_EQ(with("linear.scalars", scalars),
    "element 5 of matrix 'linear.scalars' of the transfer estimator is 0; expected a positive "
    "number");
  EXPECT_EQ(messageOf([] { exampleFit().estimator(Eigen::MatrixXd::Zero(4, 2)); }),
    "the block has 4 values per pixel but the estimator takes 5; expected the same number");
}

}
