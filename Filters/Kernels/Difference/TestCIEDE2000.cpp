#include "Kernels/Difference/CIEDE2000.h"

#include "Kernels/Difference/CIEDE2000Textbook.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <fstream>
#include <limits>
#include <random>
#include <sstream>
#include <stdexcept>
#include <string>
#include <vector>

namespace
{

using Eigen::Vector3d;
using msi::CIEDE2000;

// The relative accuracy that CIEDE2000.h states.
constexpr double StatedAccuracy = 2e-12;

struct Pair
{
  Vector3d first;
  Vector3d second;
};

double textbookDifference(const Pair& pair, const msi::CIEDE2000Factors& factors = {})
{
  const Vector3d& x = pair.first;
  const Vector3d& y = pair.second;
  return static_cast<double>(textbook::deltaE2000(
    { x(0), x(1), x(2) }, { y(0), y(1), y(2) }, factors.kL, factors.kC, factors.kH));
}

// Random pairs of every kind that the formula treats in its own way.
class PairSource
{
public:
  Pair next()
  {
    Pair pair{ color(), color() };
    Vector3d& x = pair.first;
    Vector3d& y = pair.second;
    switch (Kind++ % 9)
    {
      case 1: // close
        y = x + 2.0 * Vector3d(uniform(), uniform(), uniform());
        break;
      case 2: // opposite hues, exactly
        y.tail<2>() = -x.tail<2>() * std::ldexp(1.0, static_cast<int>(Random() % 7) - 3);
        break;
      case 3: // opposite hues, nearly
        y(1) = -x(1) * (1.0 + uniform());
        y(2) = y(1) / x(1) * x(2) * (1.0 + 1e-9 * uniform());
        break;
      case 4: // a coarse lattice: equal, opposite, mirrored and vanishing coordinates abound
        x = (x / 16.0).array().round() * 4.0;
        y = (y / 16.0).array().round() * 4.0;
        break;
      case 5: // almost neutral
        x.tail<2>() *= 1e-6;
        y.tail<2>() *= 1e-4;
        break;
      case 6: // one neutral
        x.tail<2>().setZero();
        break;
      case 7: // mean hue close to 0 = 360 degrees
        y(1) = std::abs(x(1));
        x(1) = y(1);
        y(2) = -x(2) * (1.0 + 1e-9 * uniform());
        break;
      case 8: // mean hue close to 275 degrees, where hue and chroma rotate
        x(1) = 4.0 * uniform();
        y(1) = 4.0 * uniform();
        x(2) = -100.0 * std::abs(uniform());
        y(2) = -100.0 * std::abs(uniform());
        break;
      default: // anywhere
        break;
    }
    return pair;
  }

  double uniform() { return std::uniform_real_distribution<double>(-1.0, 1.0)(Random); }
  Vector3d color() { return { 50.0 + 50.0 * uniform(), 128.0 * uniform(), 128.0 * uniform() }; }

private:
  std::mt19937_64 Random{ 2005 };
  unsigned Kind = 0;
};

struct Blocks
{
  Eigen::Matrix3Xd first;
  Eigen::Matrix3Xd second;
};

Blocks randomBlocks(Eigen::Index count)
{
  PairSource source;
  Blocks blocks{ Eigen::Matrix3Xd(3, count), Eigen::Matrix3Xd(3, count) };
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const Pair pair = source.next();
    blocks.first.col(i) = pair.first;
    blocks.second.col(i) = pair.second;
  }
  return blocks;
}

Eigen::VectorXd differences(const Blocks& blocks)
{
  Eigen::VectorXd result(blocks.first.cols());
  CIEDE2000().apply(blocks.first, blocks.second, result);
  return result;
}

std::string messageOf(const msi::CIEDE2000Factors& factors)
{
  try
  {
    CIEDE2000 difference(factors);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return {};
}

TEST(CIEDE2000, MatchesAllPairsOfSharmaInBothOrders)
{
  std::ifstream file(MULTISPECTRAL_SOURCE_DIR "/Data/Tables/ciede2000_sharma2005_table1.csv");
  ASSERT_TRUE(file) << "Data/Tables/ciede2000_sharma2005_table1.csv is missing";
  const CIEDE2000 difference;
  int pairs = 0;
  for (std::string line; std::getline(file, line);)
  {
    if (line.empty() || line[0] == '#' || line[0] == 'L')
    {
      continue;
    }
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    Vector3d x;
    Vector3d y;
    double printed = 0.0;
    ASSERT_TRUE(numbers >> x(0) >> x(1) >> x(2) >> y(0) >> y(1) >> y(2) >> printed) << line;
    EXPECT_EQ(std::round(difference(x, y) * 1e4), std::round(printed * 1e4)) << line;
    EXPECT_EQ(difference(y, x), difference(x, y)) << line;
    ++pairs;
  }
  EXPECT_EQ(pairs, 34);
}

TEST(CIEDE2000, KeepsItsAccuracyOnMillionsOfPairs)
{
  PairSource source;
  const CIEDE2000 difference;
  double worst = 0.0;
  for (int i = 0; i < 2'000'000; ++i)
  {
    const Pair pair = source.next();
    const double expected = textbookDifference(pair);
    const double error = std::abs(difference(pair.first, pair.second) - expected);
    if (error > StatedAccuracy * expected)
    {
      ADD_FAILURE() << "pair " << i << ": " << pair.first.transpose() << " and "
                    << pair.second.transpose() << " differ by " << expected << ", off by " << error;
      return;
    }
    worst = std::max(worst, expected > 0.0 ? error / expected : 0.0);
  }
  RecordProperty("worst_relative_error", std::to_string(worst * 1e12) + "e-12");
}

TEST(CIEDE2000, IsAMeasureOfDifference)
{
  PairSource source;
  const CIEDE2000 difference;
  for (int i = 0; i < 300'000; ++i)
  {
    const Pair pair = source.next();
    const double forth = difference(pair.first, pair.second);
    ASSERT_GE(forth, 0.0);
    ASSERT_EQ(forth, difference(pair.second, pair.first));
    ASSERT_EQ(difference(pair.first, pair.first), 0.0);
    ASSERT_TRUE(forth > 0.0 || pair.first == pair.second);
  }
}

TEST(CIEDE2000, ParametricFactorsDivideTheirComponents)
{
  const Vector3d x(40.0, 20.0, -30.0);
  const CIEDE2000 reference;
  EXPECT_DOUBLE_EQ(CIEDE2000({ 2.0, 1.0, 1.0 })(x, Vector3d(60.0, 20.0, -30.0)),
    reference(x, Vector3d(60.0, 20.0, -30.0)) / 2.0);
  const msi::CIEDE2000Factors factors{ 2.0, 1.5, 0.7 };
  const CIEDE2000 textile(factors);
  PairSource source;
  for (int i = 0; i < 10'000; ++i)
  {
    const Pair pair = source.next();
    const double expected = textbookDifference(pair, factors);
    ASSERT_NEAR(textile(pair.first, pair.second), expected, StatedAccuracy * expected);
  }
}

TEST(CIEDE2000, FloatBlocksAreTheDoubleResultsRoundedOnce)
{
  const Blocks blocks = randomBlocks(100'003);
  const Eigen::Matrix3Xf first = blocks.first.cast<float>();
  const Eigen::Matrix3Xf second = blocks.second.cast<float>();
  Eigen::VectorXf got(first.cols());
  CIEDE2000().apply(first, second, got);
  const Eigen::VectorXd exact = differences({ first.cast<double>(), second.cast<double>() });
  EXPECT_EQ(got, exact.cast<float>());
}

TEST(CIEDE2000, TheSameBytesForEverySplitAndStride)
{
  const Blocks blocks = randomBlocks(997);
  const Eigen::VectorXd whole = differences(blocks);
  const CIEDE2000 difference;
  for (const Eigen::Index size : { 1, 3, 7, 16, 61, 500 })
  {
    Eigen::VectorXd pieces = Eigen::VectorXd::Constant(whole.size(), -1.0);
    for (Eigen::Index first = 0; first < whole.size(); first += size)
    {
      const Eigen::Index count = std::min(size, whole.size() - first);
      difference.apply(blocks.first.middleCols(first, count),
        blocks.second.middleCols(first, count), pieces.segment(first, count));
    }
    EXPECT_EQ(pieces, whole) << "pieces of " << size;
  }
  Eigen::MatrixXd wide = Eigen::MatrixXd::Zero(5, whole.size());
  wide.middleRows<3>(1) = blocks.first;
  Eigen::VectorXd strided(whole.size());
  difference.apply(wide.middleRows<3>(1), blocks.second, strided);
  EXPECT_EQ(strided, whole);
  for (Eigen::Index i = 0; i < whole.size(); ++i)
  {
    ASSERT_EQ(difference(blocks.first.col(i), blocks.second.col(i)), whole(i));
  }
}

TEST(CIEDE2000, TheSameBytesOnEveryInstructionSet)
{
  const Blocks blocks = randomBlocks(9'999);
  const Eigen::VectorXd best = differences(blocks);
  const std::int64_t targets = hwy::SupportedTargets();
  int sets = 0;
  for (std::int64_t rest = targets; rest != 0; rest &= rest - 1)
  {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    hwy::GetChosenTarget().DeInit();
    EXPECT_EQ(differences(blocks), best) << hwy::TargetName(rest & -rest);
    ++sets;
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
  RecordProperty("instruction_sets", sets);
}

TEST(CIEDE2000, ANaNStaysInItsOwnPair)
{
  const double nan = std::numeric_limits<double>::quiet_NaN();
  const Blocks clean = randomBlocks(50);
  const Eigen::VectorXd expected = differences(clean);
  for (Eigen::Index coordinate = 0; coordinate < 6; ++coordinate)
  {
    Blocks blocks = clean;
    (coordinate < 3 ? blocks.first : blocks.second)(coordinate % 3, 20) = nan;
    const Eigen::VectorXd got = differences(blocks);
    EXPECT_TRUE(std::isnan(got(20)));
    EXPECT_EQ(got.head(20), expected.head(20));
    EXPECT_EQ(got.tail(29), expected.tail(29));
  }
}

TEST(CIEDE2000, RefusesFactorsThatAreNotPositive)
{
  EXPECT_EQ(messageOf({ 0.0, 1.0, 1.0 }),
    "the CIEDE2000 factor kL is 0; expected a finite value above zero");
  EXPECT_EQ(messageOf({ 1.0, -2.0, 1.0 }),
    "the CIEDE2000 factor kC is -2; expected a finite value above zero");
  EXPECT_NE(messageOf({ 1.0, 1.0, std::numeric_limits<double>::infinity() }), "");
}

}
