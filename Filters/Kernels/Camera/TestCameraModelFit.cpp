#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraModelFit.h"
#include "Kernels/Camera/CameraTestData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <cstdlib>
#include <fstream>
#include <limits>
#include <sstream>

namespace
{
using msi::CameraModel;
using msi::CameraModelFit;
using msi::WavelengthGrid;
using msi::test::messageOf;
using msi::test::sevenChannels;
using msi::test::visibleGrid;

double rms(const Eigen::MatrixXd& difference)
{
  return std::sqrt(difference.array().square().mean());
}

// Sums of three broad bands: a chart that says much about M, not everything.
Eigen::MatrixXd chart(const WavelengthGrid& grid, Eigen::Index count, std::uint64_t seed)
{
  const msi::CounterRandom random(seed);
  Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(grid.size(), count, 0.04);
  for (Eigen::Index s = 0; s < count; ++s)
  {
    for (std::uint64_t band = 0; band < 3; ++band)
    {
      const auto index = static_cast<std::uint64_t>(3 * s) + band;
      const double center = 380.0 + 340.0 * random.uniform(index, 0);
      const double width = 20.0 + 40.0 * random.uniform(index, 1);
      reflectance.col(s).array() += 0.4 * random.uniform(index, 2) *
        (-((grid.vector().array() - center) / width).square()).exp();
    }
  }
  return reflectance;
}

constexpr double Noise = 0.002;

Eigen::MatrixXd measured(const CameraModel& camera, const Eigen::MatrixXd& reflectance)
{
  Eigen::MatrixXd response = msi::cameraResponse(camera)(reflectance);
  msi::CameraNoise noise;
  noise.read = Noise;
  msi::NoiseGenerator{ noise, 9 }(response, 0);
  return response;
}

CameraModelFit fitOf(Eigen::Index samples, msi::CameraModelFitOptions options = {})
{
  const Eigen::MatrixXd reflectance = chart(visibleGrid(), samples, 1);
  return msi::fitCameraModel(
    visibleGrid(), reflectance, measured(sevenChannels(), reflectance), options);
}

// The rms error of predicted responses to another chart.
double predictionRms(const CameraModel& fitted)
{
  const Eigen::MatrixXd other = chart(visibleGrid(), 200, 2);
  return rms(msi::cameraResponse(fitted)(other) - msi::cameraResponse(sevenChannels())(other));
}

TEST(CameraModelFit, FindsTheCameraWithinTheNoise)
{
  const CameraModelFit fit = fitOf(150);
  EXPECT_TRUE((fit.camera.responsivity().array() >= 0.0).all());
  EXPECT_LT(predictionRms(fit.camera), Noise);
  EXPECT_NEAR(fit.summary.residualRms, Noise, 0.1 * Noise);
  EXPECT_NEAR(fit.heldOutRms, Noise, 0.15 * Noise);
  EXPECT_LT((fit.camera.centroids() - sevenChannels().centroids()).cwiseAbs().maxCoeff(), 3.0);
  EXPECT_LT((fit.camera.dark() - sevenChannels().dark()).cwiseAbs().maxCoeff(), 0.002);
  EXPECT_EQ(fit.summary.samples, 150);
}

TEST(CameraModelFit, UncertaintyIsThatOfTheErrors)
{
  const CameraModelFit fit = fitOf(150);
  const Eigen::MatrixXd other = chart(visibleGrid(), 200, 2);
  const Eigen::MatrixXd error =
    msi::cameraResponse(fit.camera)(other) - msi::cameraResponse(sevenChannels())(other);
  double squares = 0.0;
  for (Eigen::Index s = 0; s < other.cols(); ++s)
  {
    for (Eigen::Index k = 0; k < 7; ++k)
    {
      squares += std::pow(error(k, s) / fit.predictionError(k, other.col(s)), 2);
    }
  }
  // Regularisation adds a bias that the bootstrap does not see; a factor of two covers it.
  const double ratio = std::sqrt(squares / static_cast<double>(error.size()));
  EXPECT_GT(ratio, 0.5);
  EXPECT_LT(ratio, 2.0);
}

TEST(CameraModelFit, NominalFiltersHelpAPoorChart)
{
  msi::CameraModelFitOptions options;
  options.draws = 0;
  const double without = predictionRms(fitOf(14, options).camera);
  // Another scale: the fit finds it.
  options.nominal =
    sevenChannels().with(0.7 * sevenChannels().responsivity(), Eigen::VectorXd::Zero(7));
  const double with = predictionRms(fitOf(14, options).camera);
  EXPECT_LT(with, 0.5 * without);
  EXPECT_LT(with, Noise);
}

TEST(CameraModelFit, ACurveOfTheDetectorIsFoundAndTakenOut)
{
  const Eigen::MatrixXd reflectance = chart(visibleGrid(), 120, 1);
  const Eigen::MatrixXd linear = msi::cameraResponse(sevenChannels())(reflectance);
  constexpr double Square = 0.1;
  Eigen::MatrixXd response = (1.0 - Square) * linear.array() + Square * linear.array().square();
  msi::CameraNoise noise;
  noise.read = Noise;
  msi::NoiseGenerator{ noise, 9 }(response, 0);
  msi::CameraModelFitOptions options;
  options.draws = 0;
  const CameraModelFit seen = msi::fitCameraModel(visibleGrid(), reflectance, response, options);
  ASSERT_TRUE(seen.curve && seen.curve->found());
  EXPECT_NEAR(seen.curve->square, Square, 0.02);
  EXPECT_LT(seen.curve->heldOutRms, seen.heldOutRms);
  EXPECT_NE(seen.summary.status.find("Detector Curve"), std::string::npos);
  options.detectorCurve = true;
  const CameraModelFit straight =
    msi::fitCameraModel(visibleGrid(), reflectance, response, options);
  const Eigen::MatrixXd other = chart(visibleGrid(), 60, 2);
  const Eigen::MatrixXd truth = msi::cameraResponse(sevenChannels())(other);
  EXPECT_LT(rms(msi::cameraResponse(straight.camera)(other) - truth),
    0.3 * rms(msi::cameraResponse(seen.camera)(other) - truth));
}

TEST(CameraModelFit, NoCurveIsSeenInALinearDetector)
{
  int seen = 0;
  for (std::uint64_t seed = 1; seed <= 10; ++seed)
  {
    const Eigen::MatrixXd reflectance = chart(visibleGrid(), 60, seed);
    Eigen::MatrixXd response = msi::cameraResponse(sevenChannels())(reflectance);
    msi::CameraNoise noise;
    noise.read = Noise;
    msi::NoiseGenerator{ noise, seed }(response, 0);
    msi::CameraModelFitOptions options;
    options.draws = 0;
    const CameraModelFit fit = msi::fitCameraModel(visibleGrid(), reflectance, response, options);
    ASSERT_TRUE(fit.curve);
    seen += fit.curve->found() ? 1 : 0;
  }
  EXPECT_LE(seen, 1);
}

TEST(CameraModelFit, SaysWhatTheChartCannotDetermine)
{
  // Mixtures of three spectra: three directions and no more.
  const Eigen::MatrixXd basis = chart(visibleGrid(), 3, 5);
  Eigen::MatrixXd reflectance(31, 60);
  const msi::CounterRandom random(6);
  for (Eigen::Index s = 0; s < 60; ++s)
  {
    const auto index = static_cast<std::uint64_t>(s);
    reflectance.col(s) = random.uniform(index, 0) * basis.col(0) +
      random.uniform(index, 1) * basis.col(1) + random.uniform(index, 2) * basis.col(2);
  }
  const CameraModelFit fit =
    msi::fitCameraModel(visibleGrid(), reflectance, measured(sevenChannels(), reflectance));
  EXPECT_EQ(fit.determined, 3);
  ASSERT_EQ(fit.undetermined.cols(), 28);
  EXPECT_FALSE(fit.summary.complete);
  EXPECT_EQ(fit.summary.status.rfind("the chart determines 3 of 31 directions", 0), 0U)
    << fit.summary.status;
  const Eigen::MatrixXd gram = fit.undetermined.transpose() * fit.undetermined;
  EXPECT_LT((gram - Eigen::MatrixXd::Identity(28, 28)).cwiseAbs().maxCoeff(), 1e-12);
  const Eigen::MatrixXd centered = reflectance.colwise() - reflectance.rowwise().mean();
  EXPECT_LT((fit.undetermined.transpose() * centered).cwiseAbs().maxCoeff(), 1e-12);
  EXPECT_GT(fit.resolution.minCoeff(), 10.0);
}

TEST(CameraModelFit, ResponsesOfOtherSamplesAreNoticed)
{
  const Eigen::MatrixXd reflectance = chart(visibleGrid(), 60, 1);
  Eigen::MatrixXd response = measured(sevenChannels(), reflectance);
  const auto asked = [&]
  {
    const std::string status =
      msi::fitCameraModel(visibleGrid(), reflectance, response).summary.status;
    return status.find("do the responses belong to these samples?") != std::string::npos;
  };
  EXPECT_FALSE(asked());
  response.rowwise().reverseInPlace();
  EXPECT_TRUE(asked());
}

TEST(CameraModelFit, ResponsesInOtherUnitsGiveTheSameCameraInThoseUnits)
{
  const Eigen::MatrixXd reflectance = chart(visibleGrid(), 60, 1);
  const Eigen::MatrixXd response = measured(sevenChannels(), reflectance);
  msi::CameraModelFitOptions options;
  options.draws = 0;
  const CameraModelFit one = msi::fitCameraModel(visibleGrid(), reflectance, response, options);
  const CameraModelFit counts =
    msi::fitCameraModel(visibleGrid(), reflectance, 4096.0 * response, options);
  EXPECT_LT((counts.camera.responsivity() / 4096.0 - one.camera.responsivity()).norm(), 1e-9);
  EXPECT_EQ(counts.determined, one.determined);
}

TEST(CameraModelFit, WeightsMeanTheSameOnAFinerGrid)
{
  msi::CameraModelFitOptions options;
  options.draws = 0;
  const auto fine = WavelengthGrid::uniform(400.0, 700.0, 5.0);
  const Eigen::MatrixXd reflectance = chart(visibleGrid(), 100, 1);
  const Eigen::MatrixXd response = measured(sevenChannels(), reflectance);
  const CameraModelFit coarse = msi::fitCameraModel(visibleGrid(), reflectance, response, options);
  const CameraModelFit finer = msi::fitCameraModel(fine, chart(fine, 100, 1), response, options);
  const Eigen::VectorXd difference = finer.camera.centroids() - coarse.camera.centroids();
  EXPECT_LT(difference.cwiseAbs().maxCoeff(), 2.0);
  EXPECT_NEAR(finer.heldOutRms, coarse.heldOutRms, 0.1 * coarse.heldOutRms);
}

TEST(CameraModelFit, KeepsAKnownDarkResponse)
{
  msi::CameraModelFitOptions options;
  options.draws = 5;
  options.dark = sevenChannels().dark();
  const CameraModelFit fit = fitOf(60, options);
  EXPECT_LT((fit.camera.dark() - *options.dark).cwiseAbs().maxCoeff(), 1e-15);
  EXPECT_LT(fit.darkError.maxCoeff(), 1e-15);
}

TEST(CameraModelFit, LeavesOutSamplesThatAreNotFinite)
{
  Eigen::MatrixXd reflectance = chart(visibleGrid(), 40, 1);
  const Eigen::MatrixXd response = measured(sevenChannels(), reflectance);
  msi::CameraModelFitOptions options;
  options.draws = 0;
  const CameraModelFit without =
    msi::fitCameraModel(visibleGrid(), reflectance.leftCols(39), response.leftCols(39), options);
  reflectance(3, 39) = std::numeric_limits<double>::quiet_NaN();
  const CameraModelFit fit = msi::fitCameraModel(visibleGrid(), reflectance, response, options);
  EXPECT_EQ(fit.camera.responsivity(), without.camera.responsivity());
  EXPECT_NE(fit.summary.status.find("1 sample with values that are not finite was left out"),
    std::string::npos);
}

TEST(CameraModelFit, RefusesWhatItCannotFitAndSaysWhy)
{
  const auto fit = [](const WavelengthGrid& grid, Eigen::Index samples, Eigen::Index responses,
                     const msi::CameraModelFitOptions& options = {})
  {
    return messageOf(
      [&]
      {
        msi::fitCameraModel(grid, Eigen::MatrixXd::Random(31, samples),
          Eigen::MatrixXd::Random(2, responses), options);
      });
  };
  EXPECT_EQ(fit(visibleGrid(), 20, 21), "the chart has 20 reflectances but 21 responses");
  EXPECT_EQ(fit(visibleGrid(), 9, 9),
    "the chart has 9 samples with finite values; a camera model needs 10 or more");
  EXPECT_EQ(fit(WavelengthGrid::uniform(400.0, 700.0, 20.0), 20, 20),
    "the chart's reflectances have 31 wavelengths, their grid 16");
  std::vector<double> uneven = visibleGrid().values();
  uneven[3] += 1.0;
  EXPECT_EQ(fit(WavelengthGrid(uneven), 20, 20),
    "a camera model is fitted on a uniform wavelength grid of two wavelengths or more; resample "
    "the "
    "reflectances");
  msi::CameraModelFitOptions options;
  options.folds = 1;
  EXPECT_EQ(
    fit(visibleGrid(), 20, 20, options), "the cross-validation has 1 folds; expected 2 to 20");
  options.folds = 5;
  options.nominal = sevenChannels();
  EXPECT_EQ(fit(visibleGrid(), 20, 20, options),
    "the nominal camera has 7 channels and 31 wavelengths, the chart 2 and 31; expected the same");
}

// The real measurements: sample, medium, R400..R700, C400..C700.
struct Measured
{
  Eigen::MatrixXd reflectance;
  Eigen::MatrixXd response;
};

Measured readMeasured(const std::string& file)
{
  std::ifstream in(file);
  std::string line;
  std::getline(in, line);
  std::vector<double> values;
  Eigen::Index rows = 0;
  while (std::getline(in, line))
  {
    std::istringstream cells(line);
    std::string cell;
    for (int column = 0; std::getline(cells, cell, ','); ++column)
    {
      if (column >= 2)
      {
        values.push_back(std::stod(cell));
      }
    }
    ++rows;
  }
  const Eigen::Map<const Eigen::MatrixXd> all(values.data(), 47, rows);
  return { all.topRows(31), all.bottomRows(16) };
}

// The bars are what a plain smooth non-negative fit reaches on these data.
TEST(CameraModelFit, PredictsRealPaperAndCottonBetterThanAPlainSmoothFit)
{
  const char* data = std::getenv("MULTISPECTRAL_DATA");
  if (data == nullptr)
  {
    GTEST_SKIP() << "MULTISPECTRAL_DATA is not set";
  }
  const Measured paper = readMeasured(std::string(data) + "/hkpolyu/paper.csv");
  const Measured cotton = readMeasured(std::string(data) + "/hkpolyu/cotton.csv");
  ASSERT_EQ(paper.response.cols(), 204);
  msi::CameraModelFitOptions options;
  options.draws = 0;
  const CameraModelFit fit =
    msi::fitCameraModel(visibleGrid(), paper.reflectance, paper.response, options);
  const double onCotton =
    rms(msi::cameraResponse(fit.camera)(cotton.reflectance) - cotton.response);

  // Five folds around everything that the fit does, its choice of weights too.
  double squares = 0.0;
  for (Eigen::Index fold = 0; fold < 5; ++fold)
  {
    std::vector<Eigen::Index> inside;
    std::vector<Eigen::Index> outside;
    for (Eigen::Index s = 0; s < 204; ++s)
    {
      (s % 5 == fold ? outside : inside).push_back(s);
    }
    const CameraModelFit part = msi::fitCameraModel(visibleGrid(),
      paper.reflectance(Eigen::all, inside), paper.response(Eigen::all, inside), options);
    squares += (msi::cameraResponse(part.camera)(paper.reflectance(Eigen::all, outside)) -
      paper.response(Eigen::all, outside))
                 .squaredNorm();
  }
  const double onPaper = std::sqrt(squares / static_cast<double>(paper.response.size()));
  RecordProperty("held_out_paper_rms", std::to_string(onPaper));
  RecordProperty("cotton_rms", std::to_string(onCotton));
  EXPECT_LT(onPaper, 0.0066);
  EXPECT_LT(onCotton, 0.0092);
}

}
