#include "Kernels/Doubts/SampleDoubts.h"

#include "Kernels/Numerics/CounterRandom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>

namespace
{

using Texts = std::vector<std::string>;

constexpr Eigen::Index Bands = 31;
constexpr Eigen::Index Channels = 6;

// Smooth reflectance, and what a linear camera of Gaussian passbands answers with a little noise.
msi::SampleSet samplesOf(Eigen::Index count, std::uint64_t seed)
{
  const msi::CounterRandom random(seed);
  const auto drawn = [&random](Eigen::Index sample, std::uint64_t number)
  { return random.uniform(100 * static_cast<std::uint64_t>(sample) + number); };
  const Eigen::ArrayXd place = Eigen::ArrayXd::LinSpaced(Bands, 0.0, 1.0);
  msi::SampleSet set{ Eigen::MatrixXd(Bands, count), {} };
  for (Eigen::Index i = 0; i < count; ++i)
  {
    set.reflectance.col(i).setConstant(0.05 + 0.2 * drawn(i, 0));
    for (std::uint64_t n = 0; n < 4; ++n)
    {
      const double width = 0.1 + 0.2 * drawn(i, 3 * n + 1);
      set.reflectance.col(i).array() +=
        0.3 * drawn(i, 3 * n + 2) * (-0.5 * ((place - drawn(i, 3 * n + 3)) / width).square()).exp();
    }
  }
  Eigen::MatrixXd responsivity(Channels, Bands);
  for (Eigen::Index k = 0; k < Channels; ++k)
  {
    responsivity.row(k) = (-0.5 * ((place - 0.1 - 0.16 * k) / 0.06).square()).exp().transpose();
    responsivity.row(k) /= responsivity.row(k).sum();
  }
  set.response = responsivity * set.reflectance;
  for (Eigen::Index j = 0; j < set.response.size(); ++j)
  {
    set.response(j) += 0.002 * random.normal(100000 + static_cast<std::uint64_t>(j));
  }
  return set;
}

msi::NamedSamples named(const std::string& table, msi::SampleSet set)
{
  msi::NamedSamples samples{ std::move(set), table, {}, {}, {} };
  for (Eigen::Index i = 0; i < samples.set.size(); ++i)
  {
    samples.names.push_back("s" + std::to_string(i));
  }
  return samples;
}

class SampleDoubts : public ::testing::Test
{
protected:
  Texts ofChart() const { return doubtsOf(Chart, Names); }
  Texts ofBoth() const { return doubtsOf(Chart, Names, &Medium); }

  const Texts Names{ "A", "B", "C", "D", "E", "F" };
  msi::NamedSamples Chart = named("chart", samplesOf(60, 1));
  msi::NamedSamples Medium = named("medium", samplesOf(12, 2));
};

TEST_F(SampleDoubts, RightOnesHaveNone)
{
  for (std::uint64_t seed = 1; seed <= 50; ++seed)
  {
    Chart = named("chart", samplesOf(10 + static_cast<Eigen::Index>(seed), seed));
    Medium = named("medium", samplesOf(3 + static_cast<Eigen::Index>(seed), 100 + seed));
    EXPECT_EQ(ofBoth(), Texts()) << seed;
    Chart.set.response *= 4000.0; // in counts
    Medium.set.response = 4000.0 * Medium.set.response.array() + 8.0;
    EXPECT_EQ(ofBoth(), Texts()) << seed;
  }
}

TEST_F(SampleDoubts, AMediumMayDifferByGainsAndALittleOffset)
{
  Medium.set.response.array() *= 0.9;
  Medium.set.response.array() += 0.01;
  EXPECT_EQ(ofBoth(), Texts());
}

TEST_F(SampleDoubts, ReadingsOfAnotherSample)
{
  Chart.set.response.col(7) = samplesOf(1, 5).response;
  Medium.set.response.col(3) = samplesOf(1, 6).response;
  EXPECT_EQ(ofBoth(),
    (Texts{ "chart: Odd? s7 (1 of 60 samples): far from what the others predict. Look at label, "
            "patch and readings.",
      "medium: Odd? s3 (1 of 12 samples): far from what the others predict. Look at label, patch "
      "and readings." }));
}

TEST_F(SampleDoubts, ExchangedSamples)
{
  Chart.set.response.col(7).swap(Chart.set.response.col(40));
  Medium.set.response.col(1).swap(Medium.set.response.col(8));
  const std::string exchanged = " fit much better when they are exchanged.";
  EXPECT_EQ(ofBoth(), (Texts{ "chart: Mixed up? Samples s7 and s40" + exchanged }));
  Chart = named("chart", samplesOf(60, 1));
  EXPECT_EQ(ofBoth(), (Texts{ "medium: Mixed up? Samples s1 and s8" + exchanged }));
}

TEST_F(SampleDoubts, AnotherOrder)
{
  Chart.set.response = Chart.set.response.rowwise().reverse().eval();
  EXPECT_EQ(ofChart(), (Texts{ "chart: Mixed up? The samples fit much better in reverse order." }));
  Chart = named("chart", samplesOf(60, 1));
  Medium.set.response = Medium.set.response.rowwise().reverse().eval();
  EXPECT_EQ(ofBoth(), (Texts{ "medium: Mixed up? The samples fit much better in reverse order." }));
  Chart.set.response.rightCols(59) = Chart.set.response.leftCols(59).eval();
  EXPECT_EQ(ofChart().size(), 1u);
  EXPECT_NE(ofChart().front().find("shifted by one"), std::string::npos);
}

TEST_F(SampleDoubts, PlacesThatAreTurned)
{
  // Three rows of four, in millimetres; a row after the other, upside down.
  Medium.x = Eigen::ArrayXd::NullaryExpr(12, [](Eigen::Index i) { return 20.0 * (i % 4); });
  Medium.y = Eigen::ArrayXd::NullaryExpr(12, [](Eigen::Index i) { return 15.0 * (i / 4); });
  const Eigen::MatrixXd right = Medium.set.response;
  Medium.set.response << right.rightCols(4), right.middleCols(4, 4), right.leftCols(4);
  EXPECT_EQ(ofBoth(), (Texts{ "medium: Mixed up? The samples fit much better upside down." }));
}

TEST_F(SampleDoubts, ReadingsThatBelongToNoSample)
{
  Chart.set.response = samplesOf(60, 9).response;
  EXPECT_EQ(ofChart(),
    (Texts{ "chart: Mixed up? The readings hardly go with the samples: do they belong to these, in "
            "this order?" }));
}

TEST_F(SampleDoubts, ExchangedChannels)
{
  Medium.set.response.row(1).swap(Medium.set.response.row(4));
  EXPECT_EQ(ofBoth(),
    (Texts{ "medium: Mixed up? Channels B and E fit much better when they are exchanged." }));
}

TEST_F(SampleDoubts, AChannelThatIsThereTwice)
{
  Medium.set.response.row(1) = Medium.set.response.row(4);
  ASSERT_EQ(ofBoth().size(), 1u);
  EXPECT_EQ(ofBoth().front().find("medium: Twice? Channels B and E have the same values"), 0u);
}

TEST_F(SampleDoubts, AnotherExposureOrDark)
{
  const msi::SampleSet right = Medium.set;
  Medium.set.response *= 0.5;
  ASSERT_EQ(ofBoth().size(), 1u);
  EXPECT_EQ(ofBoth().front().find("medium: Exposure? The responses are 0.5 to 0.5 times"), 0u);
  Medium.set.response = right.response.array() + 0.05;
  ASSERT_EQ(ofBoth().size(), 1u);
  EXPECT_EQ(ofBoth().front().find("medium: Dark? The responses are 0.0"), 0u);
}

TEST_F(SampleDoubts, ExposureTimesOfChannels)
{
  Medium.set.response.row(2) *= 1.4;
  ASSERT_EQ(ofBoth().size(), 1u);
  EXPECT_EQ(ofBoth().front().find("medium: Exposure? The responses are "), 0u);
  EXPECT_NE(ofBoth().front().find(" to 1.4 times"), std::string::npos);
}

TEST_F(SampleDoubts, DeadChannelsBesideAnOddSample)
{
  Chart.set.response.row(2).setZero();
  Medium.set.response.col(3) = samplesOf(1, 6).response;
  Medium.set.response.row(4).setConstant(0.25);
  const std::string question = " in every sample: is it connected, and nothing before it?";
  ASSERT_EQ(ofBoth().size(), 3u);
  EXPECT_EQ(ofBoth()[0], "chart: Dead? Channel C is 0" + question);
  EXPECT_EQ(ofBoth()[1], "medium: Dead? Channel E is 0.25" + question);
  EXPECT_EQ(ofBoth()[2].find("medium: Odd? s3 (1 of 12 samples)"), 0u);
}

TEST_F(SampleDoubts, GammaEncoded)
{
  for (msi::NamedSamples* samples : { &Chart, &Medium })
  {
    samples->set.response = samples->set.response.cwiseMax(0.0).array().pow(1.0 / 2.2);
  }
  ASSERT_EQ(ofBoth().size(), 1u);
  EXPECT_EQ(ofBoth().front().find("chart: Curved? The responses go with the reflectance much "
                                  "better once raised to the power 2.2"),
    0u);
  Chart = named("chart", samplesOf(60, 1));
  ASSERT_EQ(ofBoth().size(), 1u);
  EXPECT_EQ(ofBoth().front().find("medium: Curved? "), 0u);
}

TEST_F(SampleDoubts, Saturated)
{
  Chart.set.response.row(2) = Chart.set.response.row(2).cwiseMin(0.35);
  const Texts found = ofChart();
  ASSERT_FALSE(found.empty());
  EXPECT_EQ(found.front().find("chart: Saturated? Channel C has its largest response in "), 0u);
}

TEST_F(SampleDoubts, SamplesThatStandTwice)
{
  Medium.set.reflectance.col(5) = Medium.set.reflectance.col(2);
  Medium.set.response.col(5) = Medium.set.response.col(2);
  Medium.set.reflectance.col(9) = Chart.set.reflectance.col(30);
  Medium.set.response.col(9) = Chart.set.response.col(30);
  ASSERT_EQ(ofBoth().size(), 1u);
  EXPECT_EQ(ofBoth().front().find("medium: Twice? s5 and s9 (2 of 12 samples)"), 0u);
}

TEST_F(SampleDoubts, FewSamplesAndFlatOnes)
{
  Chart = named("chart", samplesOf(3, 1));
  EXPECT_EQ(ofBoth(), Texts());
  Chart = named("chart", samplesOf(20, 1));
  Chart.set.reflectance.setConstant(0.5);
  Chart.set.response.setConstant(0.4);
  EXPECT_EQ(ofChart(), Texts());
}

} // namespace
