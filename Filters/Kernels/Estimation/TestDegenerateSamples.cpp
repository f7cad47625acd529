// Every method of the registry on samples that determine little or nothing, or cannot be: a defined result or a clear
// error, never NaN. And what a fit must not depend on: the units of responses and reflectances.
#include "Kernels/Estimation/EstimationMethod.h"
#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/MethodComparison.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <functional>
#include <limits>
#include <string>
#include <utility>
#include <vector>

namespace
{

using msi::SampleSet;
using msi::test::messageOf;
using msi::test::randomMatrix;

// Smooth spectra between 0.2 and 0.8 and a camera of overlapping passbands; a second medium differs by a gain.
SampleSet degenerateBase(
  Eigen::Index bands, Eigen::Index channels, Eigen::Index count, double gain, unsigned seed)
{
  const Eigen::ArrayXd band = Eigen::ArrayXd::LinSpaced(bands, -1.0, 1.0);
  Eigen::MatrixXd basis(bands, 3);
  basis << Eigen::VectorXd::Ones(bands), band.matrix(), band.square().matrix();
  Eigen::MatrixXd reflectance = 0.1 * basis * randomMatrix(3, count, seed);
  reflectance.array() += 0.5;
  const Eigen::ArrayXd center = Eigen::ArrayXd::LinSpaced(channels, -0.9, 0.9);
  Eigen::MatrixXd camera(channels, bands);
  for (Eigen::Index k = 0; k < channels; ++k)
  {
    camera.row(k) = (-8.0 * (band - center[k]).square()).exp().matrix().transpose();
    camera.row(k) /= camera.row(k).sum();
  }
  return { reflectance,
    gain * camera * reflectance + 0.001 * randomMatrix(channels, count, seed + 1) };
}

struct DegenerateCase
{
  std::string name;
  SampleSet calibration;
  SampleSet tuning;
};

std::vector<DegenerateCase> degenerateCases()
{
  constexpr Eigen::Index Bands = 6;
  constexpr Eigen::Index Channels = 4;
  const SampleSet chart = degenerateBase(Bands, Channels, 30, 1.0, 1);
  const SampleSet medium = degenerateBase(Bands, Channels, 12, 1.05, 3);
  std::vector<DegenerateCase> cases;
  const auto both = [&](const std::string& name, const std::function<void(SampleSet&)>& change)
  {
    cases.push_back({ name, chart, medium });
    change(cases.back().calibration);
    change(cases.back().tuning);
  };
  const auto one = [&](const std::string& name, const std::function<void(SampleSet&)>& change)
  {
    cases.push_back({ name + " in the chart", chart, medium });
    change(cases.back().calibration);
    cases.push_back({ name + " in the tuning samples", chart, medium });
    change(cases.back().tuning);
    both(name + " in both", change);
  };
  one("samples that are multiples of one",
    [](SampleSet& set)
    {
      const Eigen::RowVectorXd factor = Eigen::RowVectorXd::LinSpaced(set.size(), 0.2, 1.2);
      set.reflectance = Eigen::MatrixXd(set.reflectance.col(0) * factor);
      set.response = Eigen::MatrixXd(set.response.col(0) * factor);
    });
  one("the same sample again and again",
    [](SampleSet& set)
    {
      set.reflectance = set.reflectance.col(0).replicate(1, set.size()).eval();
      set.response = set.response.col(0).replicate(1, set.size()).eval();
    });
  one("one flat spectrum",
    [](SampleSet& set)
    {
      set.reflectance.setConstant(0.5);
      set.response.setConstant(0.5);
    });
  one("every sample twice", [](SampleSet& set) { set = joined(set, set); });
  one("a dead channel", [](SampleSet& set) { set.response.row(1).setZero(); });
  one("a constant channel", [](SampleSet& set) { set.response.row(2).setConstant(0.7); });
  one("two equal channels", [](SampleSet& set) { set.response.row(0) = set.response.row(3); });
  one("responses of 0", [](SampleSet& set) { set.response.setZero(); });
  one("reflectances of 0", [](SampleSet& set) { set.reflectance.setZero(); });
  one("one sample", [](SampleSet& set) { set = set.subset({ 3 }); });
  one("two samples", [](SampleSet& set) { set = set.subset({ 3, 5 }); });
  for (const double scale : { 1e-30, 1e30 })
  {
    const std::string times = " times " + std::string(scale < 1.0 ? "1e-30" : "1e30");
    both("responses" + times, [&](SampleSet& set) { set.response *= scale; });
    both("reflectances" + times, [&](SampleSet& set) { set.reflectance *= scale; });
    both("one channel" + times, [&](SampleSet& set) { set.response.row(1) *= scale; });
    one("one sample" + times, [&](SampleSet& set) { set.response.col(1) *= scale; });
  }
  cases.push_back({ "the tuning samples are the chart", chart, chart });
  for (const auto& [bands, channels] : std::vector<std::pair<Eigen::Index, Eigen::Index>>{
         { 6, 1 }, { 1, 4 }, { 1, 1 }, { 3, 200 }, { 31, 3 } })
  {
    cases.push_back({ std::to_string(bands) + " bands, " + std::to_string(channels) + " channels",
      degenerateBase(bands, channels, 12, 1.0, 1), degenerateBase(bands, channels, 5, 1.05, 3) });
  }
  return cases;
}

class MethodOnDegenerateSamples : public testing::TestWithParam<std::string>
{
protected:
  const msi::EstimationMethod& Method = msi::estimationMethodNamed(GetParam());
};

TEST_P(MethodOnDegenerateSamples, HasADefinedResultOrAClearError)
{
  int fitted = 0;
  for (const DegenerateCase& given : degenerateCases())
  {
    SCOPED_TRACE(given.name);
    try
    {
      const auto fit = Method.fit(given.calibration, given.tuning, {});
      ++fitted;
      EXPECT_FALSE(fit.summary.status.empty());
      // Where no sample could be left out there is no residual, and the status says so.
      EXPECT_TRUE(std::isfinite(fit.summary.residualRms) || !fit.summary.complete)
        << fit.summary.status;
      for (const SampleSet* set : { &given.calibration, &given.tuning })
      {
        EXPECT_TRUE((*fit.estimator)(set->response).array().isFinite().all());
        EXPECT_TRUE(fit.estimator->standardDeviation(set->response).array().isFinite().all());
      }
      EXPECT_NO_THROW(msi::estimatorFrom(fit.estimator->parameters()));
    }
    catch (const std::invalid_argument& error)
    {
      EXPECT_GT(std::string(error.what()).size(), 20U) << error.what();
    }
  }
  EXPECT_GT(fitted, 20);
}

TEST_P(MethodOnDegenerateSamples, RefusesWhatIsNotFinite)
{
  const SampleSet chart = degenerateBase(6, 4, 30, 1.0, 1);
  const SampleSet medium = degenerateBase(6, 4, 12, 1.05, 3);
  for (const double value : { std::numeric_limits<double>::quiet_NaN(),
         std::numeric_limits<double>::infinity(), -std::numeric_limits<double>::infinity() })
  {
    for (const int place : { 0, 1, 2, 3 })
    {
      SampleSet sets[2] = { chart, medium };
      SampleSet& changed = sets[place / 2];
      (place % 2 == 0 ? changed.reflectance : changed.response)(1, 2) = value;
      // The chart alone does not look at the tuning samples, and the other way round.
      const bool used =
        !(GetParam() == "direct" && place >= 2) && !(GetParam() == "pinv" && place < 2);
      const std::string said = messageOf([&] { Method.fit(sets[0], sets[1], {}); });
      EXPECT_EQ(said.find("expected a finite number") != std::string::npos, used)
        << place << ": " << said;
    }
  }
}

// Counts instead of values relative to white: the same estimate, up to rounding and where a search for hyperparameters
// stops.
TEST_P(MethodOnDegenerateSamples, DoesNotDependOnTheUnitOfTheResponses)
{
  const SampleSet chart = degenerateBase(6, 4, 30, 1.0, 1);
  const SampleSet medium = degenerateBase(6, 4, 12, 1.05, 3);
  const SampleSet test = degenerateBase(6, 4, 9, 1.05, 5);
  const Eigen::MatrixXd expected = (*Method.fit(chart, medium, {}).estimator)(test.response);
  for (const double factor : { 1.0 / 1000.0, 4095.0, 65535.0 })
  {
    const auto fit = Method.fit({ chart.reflectance, factor * chart.response },
      { medium.reflectance, factor * medium.response }, {});
    EXPECT_LT(
      msi::test::largestDifference((*fit.estimator)(factor * test.response), expected), 1e-5)
      << factor;
  }
}

TEST_P(MethodOnDegenerateSamples, DoesNotDependOnTheUnitOfTheReflectances)
{
  const SampleSet chart = degenerateBase(6, 4, 30, 1.0, 1);
  const SampleSet medium = degenerateBase(6, 4, 12, 1.05, 3);
  const SampleSet test = degenerateBase(6, 4, 9, 1.05, 5);
  const Eigen::MatrixXd expected = (*Method.fit(chart, medium, {}).estimator)(test.response);
  const auto percent = Method.fit({ 100.0 * chart.reflectance, chart.response },
    { 100.0 * medium.reflectance, medium.response }, {});
  EXPECT_LT(
    msi::test::largestDifference((*percent.estimator)(test.response) / 100.0, expected), 1e-5);
}

INSTANTIATE_TEST_SUITE_P(Registry, MethodOnDegenerateSamples,
  testing::ValuesIn(msi::allMethodNames()),
  [](const auto& method)
  {
    std::string name = method.param;
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return name;
  });

}
