// A camera fitted to charts that determine little or nothing, or cannot be: a defined result or a clear error, never NaN.
// And what the fit must not depend on: the units of responses and reflectances.
#include "Kernels/Camera/CameraModelFit.h"
#include "Kernels/Camera/CameraTestData.h"
#include "Kernels/Camera/ResponseDifference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <functional>
#include <limits>
#include <string>
#include <vector>

namespace
{

struct DegenerateChart
{
  std::string name;
  Eigen::MatrixXd reflectance;
  Eigen::MatrixXd response;
};

const msi::WavelengthGrid& coarseGrid()
{
  static const msi::WavelengthGrid grid = msi::WavelengthGrid::uniform(400.0, 700.0, 50.0);
  return grid;
}

DegenerateChart chartOf(Eigen::Index channels, Eigen::Index samples)
{
  const Eigen::Index bands = coarseGrid().size();
  const msi::CounterRandom random(7);
  DegenerateChart chart{ "", Eigen::MatrixXd(bands, samples), {} };
  for (Eigen::Index i = 0; i < chart.reflectance.size(); ++i)
  {
    chart.reflectance(i) = 0.1 + 0.8 * random.uniform(static_cast<std::uint64_t>(i));
  }
  const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(bands, -1.0, 1.0);
  Eigen::MatrixXd camera(channels, bands);
  for (Eigen::Index k = 0; k < channels; ++k)
  {
    const double center =
      channels > 1 ? -0.8 + 1.6 * static_cast<double>(k) / static_cast<double>(channels - 1) : 0.0;
    camera.row(k) = (-6.0 * (place - center).square()).exp().matrix().transpose();
    camera.row(k) /= camera.row(k).sum();
  }
  chart.response = (camera * chart.reflectance).array() + 0.005;
  for (Eigen::Index i = 0; i < chart.response.size(); ++i)
  {
    chart.response(i) += 0.001 * (random.uniform(static_cast<std::uint64_t>(i), 1) - 0.5);
  }
  return chart;
}

std::vector<DegenerateChart> degenerateCharts()
{
  std::vector<DegenerateChart> charts;
  const auto add = [&charts](const std::string& name,
                     const std::function<void(Eigen::MatrixXd&, Eigen::MatrixXd&)>& change)
  {
    charts.push_back(chartOf(4, 24));
    charts.back().name = name;
    change(charts.back().reflectance, charts.back().response);
  };
  using Matrix = Eigen::MatrixXd;
  add("as it should be", [](Matrix&, Matrix&) {});
  add("multiples of one sample",
    [](Matrix& r, Matrix& u)
    {
      const Eigen::RowVectorXd factor = Eigen::RowVectorXd::LinSpaced(r.cols(), 0.2, 1.1);
      r = (r.col(0) * factor).eval();
      u = (u.col(0) * factor).eval();
    });
  add("the same sample again and again",
    [](Matrix& r, Matrix& u)
    {
      r = r.col(0).replicate(1, r.cols()).eval();
      u = u.col(0).replicate(1, u.cols()).eval();
    });
  add("one flat spectrum",
    [](Matrix& r, Matrix& u)
    {
      r.setConstant(0.5);
      u.setConstant(0.5);
    });
  add("one flat spectrum, seen differently", [](Matrix& r, Matrix&) { r.setConstant(0.5); });
  add("a dead channel", [](Matrix&, Matrix& u) { u.row(1).setZero(); });
  add("a constant channel", [](Matrix&, Matrix& u) { u.row(2).setConstant(0.7); });
  add("responses of 0", [](Matrix&, Matrix& u) { u.setZero(); });
  add("responses below 0", [](Matrix&, Matrix& u) { u = -u; });
  add("reflectances of 0", [](Matrix& r, Matrix&) { r.setZero(); });
  add(
    "one sample", [](Matrix& r, Matrix& u) { r = r.leftCols(1).eval(), u = u.leftCols(1).eval(); });
  for (const double scale : { 1e-30, 1e30 })
  {
    const std::string times = scale < 1.0 ? " times 1e-30" : " times 1e30";
    add("responses" + times, [scale](Matrix&, Matrix& u) { u *= scale; });
    add("reflectances" + times, [scale](Matrix& r, Matrix&) { r *= scale; });
    add("one channel" + times, [scale](Matrix&, Matrix& u) { u.row(1) *= scale; });
    add("one sample" + times,
      [scale](Matrix& r, Matrix& u)
      {
        r.col(1) *= scale;
        u.col(1) *= scale;
      });
  }
  for (const double value :
    { std::numeric_limits<double>::quiet_NaN(), std::numeric_limits<double>::infinity() })
  {
    add("one reading that is not finite", [value](Matrix&, Matrix& u) { u(1, 3) = value; });
    add("one reflectance that is not finite", [value](Matrix& r, Matrix&) { r(1, 3) = -value; });
    add("nothing that is finite", [value](Matrix& r, Matrix&) { r.setConstant(value); });
  }
  for (const Eigen::Index channels : { 1, 200 })
  {
    charts.push_back(chartOf(channels, 24));
    charts.back().name = std::to_string(channels) + " channels";
  }
  return charts;
}

msi::CameraModelFitOptions fewDraws()
{
  msi::CameraModelFitOptions options;
  options.passbandWidth = 60.0;
  options.draws = 3;
  return options;
}

TEST(CameraOfDegenerateCharts, IsDefinedOrRefused)
{
  int fitted = 0;
  for (const DegenerateChart& chart : degenerateCharts())
  {
    SCOPED_TRACE(chart.name);
    try
    {
      const msi::CameraModelFit fit =
        msi::fitCameraModel(coarseGrid(), chart.reflectance, chart.response, fewDraws());
      ++fitted;
      EXPECT_TRUE(fit.camera.responsivity().allFinite());
      EXPECT_GE(fit.camera.responsivity().minCoeff(), 0.0);
      EXPECT_TRUE(fit.camera.dark().allFinite());
      EXPECT_TRUE(fit.responsivityError.allFinite());
      EXPECT_TRUE(fit.darkError.allFinite());
      EXPECT_TRUE(fit.channelRms.allFinite());
      EXPECT_TRUE(fit.resolution.allFinite());
      EXPECT_TRUE(std::isfinite(fit.heldOutRms));
      EXPECT_TRUE(std::isfinite(fit.summary.condition));
      EXPECT_FALSE(fit.summary.status.empty());
    }
    catch (const std::invalid_argument& error)
    {
      EXPECT_GT(std::string(error.what()).size(), 20U) << error.what();
    }
  }
  EXPECT_GT(fitted, 15);
}

// Counts instead of values relative to white, and percent instead of factors.
TEST(CameraOfDegenerateCharts, UnitsChangeTheUnitOfTheCameraAlone)
{
  const DegenerateChart chart = chartOf(4, 24);
  const msi::CameraModelFit expected =
    msi::fitCameraModel(coarseGrid(), chart.reflectance, chart.response, fewDraws());
  const double largest = expected.camera.responsivity().maxCoeff();
  for (const double counts : { 1.0 / 4096.0, 65536.0 })
  {
    for (const double percent : { 1.0, 100.0 })
    {
      const msi::CameraModelFit fit = msi::fitCameraModel(
        coarseGrid(), percent * chart.reflectance, counts * chart.response, fewDraws());
      EXPECT_LT((fit.camera.responsivity() * (percent / counts) - expected.camera.responsivity())
                  .cwiseAbs()
                  .maxCoeff(),
        1e-8 * largest);
      EXPECT_NEAR(fit.heldOutRms / counts, expected.heldOutRms, 1e-8 * expected.heldOutRms);
      EXPECT_EQ(fit.determined, expected.determined);
    }
  }
}

TEST(CameraOfDegenerateCharts, NoLineThroughSimulatedValuesThatAreTheSame)
{
  Eigen::MatrixXd real = chartOf(3, 24).response;
  // The mean of 24 times 0.7 is not 0.7.
  const auto channels = msi::responseDifference(real, Eigen::MatrixXd::Constant(3, 24, 0.7));
  for (const msi::ChannelDifference& channel : channels)
  {
    EXPECT_TRUE(std::isnan(channel.gain)) << channel.gain;
    EXPECT_TRUE(std::isfinite(channel.rms));
  }
}

TEST(CameraOfDegenerateCharts, TheirDifferenceIsDefinedOrMarkedAsWithout)
{
  for (const DegenerateChart& chart : degenerateCharts())
  {
    SCOPED_TRACE(chart.name);
    for (const msi::ChannelDifference& channel :
      msi::responseDifference(chart.response, chart.response))
    {
      EXPECT_EQ(std::isfinite(channel.rms), channel.samples > 0);
      EXPECT_EQ(std::isfinite(channel.mean), channel.samples > 0);
      if (std::isfinite(channel.gain))
      {
        EXPECT_NEAR(channel.gain, 1.0, 1e-9);
      }
    }
  }
}

}
