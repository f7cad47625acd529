#include "Kernels/Difference/CIEDE2000.h"

#include "Kernels/Difference/CIEDE2000Textbook.h"

#include <gtest/gtest.h>
#include <hwy/targets.h>

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <cstring>
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
constexpr double StatedFloatAccuracy = 4e-6;
constexpr double AccuracyOfCloseColors = 1e-14;
// The squares of smaller differences leave the range of single precision.
constexpr double SmallestFloatDifference = 1e-18;

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

struct SharmaPair
{
  Pair colors;
  double printed;
};

std::vector<SharmaPair> sharmaPairs()
{
  std::ifstream file(MULTISPECTRAL_SOURCE_DIR "/Data/Tables/ciede2000_sharma2005_table1.csv");
  std::vector<SharmaPair> pairs;
  for (std::string line; std::getline(file, line);)
  {
    if (line.empty() || line[0] == '#' || line[0] == 'L')
    {
      continue;
    }
    std::replace(line.begin(), line.end(), ',', ' ');
    std::istringstream numbers(line);
    SharmaPair pair;
    Vector3d& x = pair.colors.first;
    Vector3d& y = pair.colors.second;
    EXPECT_TRUE(numbers >> x(0) >> x(1) >> x(2) >> y(0) >> y(1) >> y(2) >> pair.printed) << line;
    pairs.push_back(pair);
  }
  return pairs;
}

TEST(CIEDE2000, MatchesAllPairsOfSharmaInBothOrders)
{
  const CIEDE2000 difference;
  const auto pairs = sharmaPairs();
  EXPECT_EQ(pairs.size(), 34U);
  for (const auto& [colors, printed] : pairs)
  {
    const auto& [x, y] = colors;
    EXPECT_EQ(std::round(difference(x, y) * 1e4), std::round(printed * 1e4)) << x.transpose();
    EXPECT_EQ(difference(y, x), difference(x, y)) << x.transpose();
  }
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

// CloseColors.txt: an independent program in 80 digits.
TEST(CIEDE2000, KeepsTheDigitsOfNearlyEqualColors)
{
  std::ifstream file(MULTISPECTRAL_SOURCE_DIR "/Filters/Kernels/Difference/CloseColors.txt");
  Pair pair;
  double expected = 0.0;
  int count = 0;
  while (file >> pair.first[0] >> pair.first[1] >> pair.first[2] >> pair.second[0] >>
    pair.second[1] >> pair.second[2] >> expected)
  {
    ++count;
    EXPECT_NEAR(CIEDE2000()(pair.first, pair.second), expected, AccuracyOfCloseColors * expected)
      << pair.first.transpose() << " and " << pair.second.transpose();
  }
  EXPECT_EQ(count, 32);
}

// 10^7 pairs: of every kind, and moved by single units of the last place of single precision.
TEST(CIEDE2000, FloatBlocksKeepTheirAccuracyOnMillionsOfPairs)
{
  constexpr Eigen::Index Pairs = 500'000;
  const Blocks blocks = randomBlocks(Pairs);
  double worst = 0.0;
  for (int round = 0; round < 20; ++round)
  {
    Eigen::Matrix3Xf first = blocks.first.cast<float>();
    Eigen::Matrix3Xf second = blocks.second.cast<float>();
    for (Eigen::Index i = 0; i < Pairs; ++i)
    {
      if (round % 4 == 1) // one unit of the last place apart
      {
        second.col(i) = first.col(i);
        second((i + round) % 3, i) = std::nextafter(first((i + round) % 3, i), 1e3F);
      }
      else if (round % 4 > 1) // all coordinates apart by up to 10, down to 1e-6 of it
      {
        const auto scale = std::ldexp(1.0F, -static_cast<int>((i + round) % 20));
        second.col(i) = first.col(i) + scale * 0.08F * second.col(i);
      }
      if (round / 4 > 0) // other halves of the plane of hues
      {
        first.col(i).tail<2>() *= round / 4 % 2 == 0 ? 1.0F : -1.0F;
        second.col(i).tail<2>() *= round / 4 % 2 == 0 ? 1.0F : -1.0F;
        std::swap(first(1 + i % 2, i), first(2 - i % 2, i));
      }
    }
    Eigen::VectorXf got(Pairs);
    CIEDE2000().apply(first, second, got);
    Eigen::VectorXf back(Pairs);
    CIEDE2000().apply(second, first, back);
    ASSERT_EQ(got, back);
    const Eigen::VectorXd exact = differences({ first.cast<double>(), second.cast<double>() });
    for (Eigen::Index i = 0; i < Pairs; ++i)
    {
      const double error = std::abs(static_cast<double>(got(i)) - exact(i));
      ASSERT_LE(error, StatedFloatAccuracy * exact(i) + SmallestFloatDifference)
        << "round " << round << ", pair " << i << ": " << first.col(i).transpose() << " and "
        << second.col(i).transpose() << " differ by " << exact(i);
      worst = std::max(worst, exact(i) > 1e-6 ? error / exact(i) : 0.0);
    }
  }
  RecordProperty("worst_relative_error", std::to_string(worst * 1e6) + "e-6");
}

TEST(CIEDE2000, FloatBlocksMatchAllPairsOfSharma)
{
  Eigen::Matrix3Xf first(3, 34);
  Eigen::Matrix3Xf second(3, 34);
  std::vector<double> printed;
  for (const SharmaPair& pair : sharmaPairs())
  {
    first.col(static_cast<Eigen::Index>(printed.size())) = pair.colors.first.cast<float>();
    second.col(static_cast<Eigen::Index>(printed.size())) = pair.colors.second.cast<float>();
    printed.push_back(pair.printed);
  }
  ASSERT_EQ(printed.size(), 34U);
  Eigen::VectorXf forth(34);
  Eigen::VectorXf back(34);
  CIEDE2000().apply(first, second, forth);
  CIEDE2000().apply(second, first, back);
  EXPECT_EQ(forth, back);
  for (Eigen::Index i = 0; i < 34; ++i)
  {
    // Half a unit of the fourth decimal, and the roundings of the colors themselves.
    const double exact = printed[static_cast<std::size_t>(i)];
    EXPECT_NEAR(forth(i), exact, 5.1e-5 + 4e-6 * exact) << i;
  }
}

TEST(CIEDE2000, FloatBlocksHaveTheSameBytesForEverySplitAndInstructionSet)
{
  const Blocks blocks = randomBlocks(9'999);
  const Eigen::Matrix3Xf first = blocks.first.cast<float>();
  Eigen::Matrix3Xf second = blocks.second.cast<float>();
  second(1, 17) = std::numeric_limits<float>::quiet_NaN();
  second(2, 18) = 3e20F;
  const CIEDE2000 difference;
  Eigen::VectorXf whole(first.cols());
  difference.apply(first, second, whole);
  EXPECT_TRUE(std::isnan(whole(17)));
  EXPECT_EQ(whole.array().isNaN().count(), 1);
  EXPECT_TRUE(std::isfinite(whole(18)));
  const auto same = [&whole](const Eigen::VectorXf& other)
  { return std::memcmp(whole.data(), other.data(), sizeof(float) * 9'999) == 0; };
  for (const Eigen::Index size : { 1, 7, 16, 500 })
  {
    Eigen::VectorXf pieces(whole.size());
    for (Eigen::Index at = 0; at < whole.size(); at += size)
    {
      const Eigen::Index count = std::min(size, whole.size() - at);
      difference.apply(
        first.middleCols(at, count), second.middleCols(at, count), pieces.segment(at, count));
    }
    EXPECT_TRUE(same(pieces)) << "pieces of " << size;
  }
  for (std::int64_t rest = hwy::SupportedTargets(); rest != 0; rest &= rest - 1)
  {
    hwy::SetSupportedTargetsForTest(rest & -rest);
    hwy::GetChosenTarget().DeInit();
    Eigen::VectorXf got(whole.size());
    difference.apply(first, second, got);
    EXPECT_TRUE(same(got)) << hwy::TargetName(rest & -rest);
  }
  hwy::SetSupportedTargetsForTest(0);
  hwy::GetChosenTarget().DeInit();
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
