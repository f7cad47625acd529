#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/SampleChoice.h"
#include "Kernels/Estimation/SampleDraw.h"
#include "Kernels/Estimation/Transfer/TransferEstimation.h"
#include "Kernels/Estimation/Transfer/TransferKernel.h"

#include <Eigen/LU>
#include <gtest/gtest.h>

#include <algorithm>
#include <set>

namespace
{

using msi::test::messageOf;
using msi::test::randomMatrix;

Eigen::MatrixXd someResponses(Eigen::Index count, unsigned seed)
{
  return (0.5 + 0.4 * randomMatrix(4, count, seed).array()).matrix();
}

TEST(SampleChoice, ExplainsWhatTheWholeMatrixSays)
{
  // Rasmussen and Williams, Eq. 2.26, with the inverse of the whole matrix: the standard
  // deviations of all candidates with and without the chosen ones.
  const Eigen::MatrixXd chart = someResponses(15, 1);
  const Eigen::MatrixXd candidates = someResponses(12, 2);
  const auto choice = msi::chooseSamples(chart, candidates, 5);
  const Eigen::VectorXd scales = chart.cwiseAbs2().rowwise().mean().cwiseSqrt();
  const Eigen::MatrixXd scaledChart = scales.cwiseInverse().asDiagonal() * chart;
  const auto features = msi::featuresOf(msi::TransferSpace::Linear, scaledChart);
  const Eigen::MatrixXd a = features.ofChart(scaledChart);
  const Eigen::MatrixXd b = features.ofChart(scales.cwiseInverse().asDiagonal() * candidates);
  const auto kernel = msi::startingKernel();
  const auto deviationsGiven = [&](const std::vector<Eigen::Index>& chosen)
  {
    Eigen::MatrixXd known(4, 15 + static_cast<Eigen::Index>(chosen.size()));
    known << a, b(Eigen::all, chosen);
    Eigen::MatrixXd k = msi::covariance(kernel, known, 15, known, 15);
    k.diagonal().array() += kernel[msi::TransferKernel::ChartNoise];
    EXPECT_EQ(kernel[msi::TransferKernel::ChartNoise], kernel[msi::TransferKernel::TargetNoise]);
    const Eigen::MatrixXd cross = msi::covariance(kernel, known, 15, b, 0);
    return (msi::covariance(kernel, b, 0, b, 0) - cross.transpose() * k.inverse() * cross)
      .diagonal()
      .cwiseMax(0.0)
      .cwiseSqrt()
      .sum();
  };
  const double before = deviationsGiven({});
  std::vector<Eigen::Index> chosen;
  for (std::size_t rank = 0; rank < 5; ++rank)
  {
    // No other candidate would have explained more.
    double least = before;
    for (Eigen::Index i = 0; i < 12; ++i)
    {
      if (std::find(chosen.begin(), chosen.end(), i) == chosen.end())
      {
        auto with = chosen;
        with.push_back(i);
        least = std::min(least, deviationsGiven(with));
      }
    }
    chosen.push_back(choice.samples[rank]);
    EXPECT_NEAR(choice.explained[rank], 1.0 - deviationsGiven(chosen) / before, 1e-9);
    EXPECT_NEAR(deviationsGiven(chosen), least, 1e-9 * before);
  }
}

TEST(SampleChoice, TakesEverySampleOnceAndDoesNotDependOnGains)
{
  const Eigen::MatrixXd chart = someResponses(15, 3);
  Eigen::MatrixXd candidates = someResponses(9, 4);
  candidates.col(8) = candidates.col(7); // a duplicate is worth little, but comes in the end
  const auto choice = msi::chooseSamples(chart, candidates, 9);
  EXPECT_EQ(std::set<Eigen::Index>(choice.samples.begin(), choice.samples.end()).size(), 9U);
  EXPECT_TRUE(std::is_sorted(choice.explained.begin(), choice.explained.end()));
  EXPECT_LT(choice.explained.back(), 1.0);
  const Eigen::Vector4d gains(1.0, 100.0, 0.01, 4096.0);
  EXPECT_EQ(
    msi::chooseSamples(gains.asDiagonal() * chart, gains.asDiagonal() * candidates, 4).samples,
    msi::chooseSamples(chart, candidates, 4).samples);
}

TEST(SampleChoice, BeatsRandomDrawsOnRealSamples)
{
  const auto paper = msi::test::realSamples("hkpolyu/paper.csv");
  const auto cotton = msi::test::realSamples("hkpolyu/cotton.csv");
  if (!paper || !cotton)
  {
    GTEST_SKIP() << "MULTISPECTRAL_DATA is not set";
  }
  // 8 samples out of a random half of the target, test on all others: choice against draw.
  constexpr Eigen::Index count = 8;
  double ofChoice = 0.0;
  double ofDraw = 0.0;
  for (const auto& [chart, target] : { std::pair(*paper, *cotton), std::pair(*cotton, *paper) })
  {
    for (std::uint64_t draw = 0; draw < 6; ++draw)
    {
      const auto half = msi::drawSamples(target.size(), target.size() / 2, 7, draw);
      const auto errorWith = [&, &chart = chart, &target = target](
                               const std::vector<Eigen::Index>& ofHalf)
      {
        std::vector<Eigen::Index> chosen;
        chosen.reserve(ofHalf.size());
        for (const Eigen::Index i : ofHalf)
        {
          chosen.push_back(half[static_cast<std::size_t>(i)]);
        }
        std::sort(chosen.begin(), chosen.end());
        const auto heldOut = target.subset(msi::remainingSamples(target.size(), chosen));
        const auto fit = msi::fitTransfer(chart, target.subset(chosen));
        const Eigen::MatrixXd error = fit.estimator(heldOut.response) - heldOut.reflectance;
        return error.cwiseAbs2().colwise().mean().cwiseSqrt().mean();
      };
      ofChoice +=
        errorWith(msi::chooseSamples(chart.response, target.subset(half).response, count).samples);
      ofDraw += errorWith(msi::drawSamples(target.size() / 2, count, 5, draw));
    }
  }
  EXPECT_LT(ofChoice, 0.95 * ofDraw);
}

TEST(SampleChoice, RefusesBadInputAndSaysWhy)
{
  const Eigen::MatrixXd chart = someResponses(15, 5);
  const Eigen::MatrixXd candidates = someResponses(9, 6);
  EXPECT_EQ(messageOf([&] { msi::chooseSamples(chart, candidates, 10); }),
    "10 samples are to be chosen from 9; expected a number from 1 to 9");
  EXPECT_EQ(messageOf([&] { msi::chooseSamples(chart, candidates.topRows(3), 2); }),
    "the chart has 4 response channels and the candidates have 3; expected the same channels in "
    "both");
  EXPECT_EQ(messageOf([&] { msi::chooseSamples({}, candidates, 2); }),
    "there are no chart responses; expected at least one sample");
}

}
