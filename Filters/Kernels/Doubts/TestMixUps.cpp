#include "Kernels/Doubts/MixUps.h"

#include "Kernels/Numerics/CounterRandom.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <limits>

namespace
{

// 4 channels of 60 drawn samples; each channel is seen with a gain of its own and a little noise.
class MixUps : public ::testing::Test
{
protected:
  MixUps()
    : Simulated(Eigen::MatrixXd::NullaryExpr(4, Count,
        [](Eigen::Index k, Eigen::Index i)
        {
          const msi::CounterRandom random(3);
          // Channels go together, as those of a camera do.
          return 0.2 + 0.5 * random.uniform(static_cast<std::uint64_t>(i)) +
            0.2 * random.uniform(static_cast<std::uint64_t>(1000 + 100 * k + i));
        }))
    , Observed(Simulated)
  {
    const msi::CounterRandom random(4);
    for (Eigen::Index j = 0; j < Observed.size(); ++j)
    {
      Observed(j) += 0.002 * random.normal(static_cast<std::uint64_t>(j));
    }
    Observed.array().colwise() *= Eigen::Array4d(0.8, 1.0, 1.3, 0.9);
    for (Eigen::Index i = 0; i < Count; ++i)
    {
      Names.push_back("s" + std::to_string(i));
    }
  }
  std::vector<std::string> found() const
  {
    std::vector<msi::Arrangement> arrangements{ { "in reverse order", {} } };
    for (Eigen::Index i = 0; i < Count; ++i)
    {
      arrangements.front().instead.push_back(Count - 1 - i);
    }
    const std::string text =
      mixUp(Observed, Simulated, arrangements, { "A", "B", "C", "D" }, Names).question;
    return text.empty() ? std::vector<std::string>() : std::vector<std::string>{ text };
  }

  static constexpr Eigen::Index Count = 60;
  Eigen::MatrixXd Simulated, Observed;
  std::vector<std::string> Names;
};

using Texts = std::vector<std::string>;

TEST_F(MixUps, GainsAndMissingReadingsAreNone)
{
  EXPECT_EQ(found(), Texts());
  Observed.col(7).setConstant(std::numeric_limits<double>::quiet_NaN());
  Observed(2, 20) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(found(), Texts());
}

TEST_F(MixUps, SamplesInReverseOrder)
{
  Observed.rowwise().reverseInPlace();
  EXPECT_EQ(found(), Texts{ "Mixed up? The samples fit much better in reverse order." });
}

TEST_F(MixUps, TwoSamplesExchanged)
{
  Eigen::Index darkest = 0;
  Eigen::Index brightest = 0;
  Simulated.row(0).minCoeff(&darkest);
  Simulated.row(0).maxCoeff(&brightest);
  Observed.col(darkest).swap(Observed.col(brightest));
  const auto [first, second] = std::minmax(darkest, brightest);
  EXPECT_EQ(found(),
    Texts{ "Mixed up? Samples s" + std::to_string(first) + " and s" + std::to_string(second) +
      " fit much better when they are exchanged." });
}

TEST_F(MixUps, ChannelsExchangedAndReversed)
{
  Observed.row(1).swap(Observed.row(2));
  EXPECT_EQ(
    found(), Texts{ "Mixed up? Channels B and C fit much better when they are exchanged." });
  Observed.row(0).swap(Observed.row(3));
  EXPECT_EQ(found(), Texts{ "Mixed up? The channels fit much better in reverse order." });
}

TEST_F(MixUps, ReadingsOfOtherSamples)
{
  for (Eigen::Index i = 0; i + 7 < Count; ++i) // a shift that is not looked for
  {
    Observed.col(i).swap(Observed.col(i + 7));
  }
  ASSERT_EQ(found().size(), 1U);
  EXPECT_NE(found().front().find("hardly go with the samples"), std::string::npos);
}

TEST_F(MixUps, ADeadChannel)
{
  const msi::CounterRandom random(5);
  for (Eigen::Index i = 0; i < Count; ++i)
  {
    Observed(2, i) = 0.01 + 0.002 * random.normal(static_cast<std::uint64_t>(i));
  }
  EXPECT_EQ(found(),
    Texts{ "Dead? Channel C does not change with the scene as the others do: is it connected, and "
           "nothing before it?" });
}

TEST_F(MixUps, AChannelThatIsThereTwice)
{
  Observed.row(3) = Observed.row(1);
  Observed(1, 20) = std::numeric_limits<double>::quiet_NaN();
  EXPECT_EQ(found(),
    Texts{ "Twice? Channels B and D have the same values: was the same file or column taken for "
           "both?" });
}

// A camera whose channels differ by nothing, before grey samples.
TEST_F(MixUps, ChannelsThatShouldBeTheSameAreNoCopies)
{
  Simulated.row(3) = Simulated.row(1);
  Observed.row(3) = Observed.row(1);
  EXPECT_EQ(found(), Texts());
}

// A flat field has nothing to go together with.
TEST_F(MixUps, AFlatFieldHasNone)
{
  Simulated.setConstant(0.9);
  Observed.setConstant(0.8);
  Observed.leftCols(30).setConstant(0.85);
  EXPECT_EQ(found(), Texts());
}

TEST(MixUpsOfPlaces, AFieldThatTurnsOntoItself)
{
  // A row after the other: turned is in reverse order, too.
  const Eigen::Array<double, 6, 1> x{ 0, 1, 2, 0, 1, 2 };
  const Eigen::Array<double, 6, 1> y{ 0, 0, 0, 1, 1, 1 };
  const std::vector<msi::Arrangement> turned = msi::turnedPlaces(x, y);
  ASSERT_EQ(turned.size(), 3u);
  EXPECT_EQ(turned[0].instead, (std::vector<Eigen::Index>{ 2, 1, 0, 5, 4, 3 }));
  EXPECT_EQ(turned[1].instead, (std::vector<Eigen::Index>{ 3, 4, 5, 0, 1, 2 }));
  EXPECT_EQ(turned[2].what, "turned by 180 degrees");
  EXPECT_EQ(turned[2].instead, msi::arrangementsOf(6).front().instead);
  const Eigen::Array<double, 6, 1> uneven{ 0, 1, 2, 0, 1, 5 };
  EXPECT_TRUE(msi::turnedPlaces(uneven, y).size() < 3u);
}

} // namespace
