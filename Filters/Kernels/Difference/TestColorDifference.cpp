#include "Kernels/Difference/CIEDE2000.h"
#include "Kernels/Difference/ColorDifference.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <string>

namespace
{

template <typename F>
std::string differenceMessageOf(F&& call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return {};
}

struct PublishedDifference
{
  std::string formula;
  Eigen::Vector3d lab1;
  Eigen::Vector3d lab2;
  double expected;
};

// Values of the test suite of colour-science, which holds CIE94, CMC and CIEDE2000 against Lindbloom's
// calculator and DIN99 against ASTM D2244.
TEST(ColorDifference, AgreesWithColourScience)
{
  const Eigen::Vector3d yellow(100.0, 21.57210357, 272.22819350);
  const Eigen::Vector3d red(100.0, 426.67945353, 72.39590835);
  const Eigen::Vector3d near(100.0, 74.05216981, 276.45318193);
  const Eigen::Vector3d blue(100.0, 8.32281957, -73.58297716);
  const Eigen::Vector3d dark1(48.99183622, -0.10561667, 400.65619925);
  const Eigen::Vector3d dark2(50.65907324, -0.11671910, 402.82235718);
  const PublishedDifference published[] = {
    { "ciede2000", yellow, red, 94.03564903 },
    { "ciede2000", yellow, near, 14.87906419 },
    { "ciede2000", dark1, dark2, 1.67093 },
    { "cie94", yellow, red, 83.779225500887094 },
    { "cie94", yellow, near, 10.053931954553839 },
    { "cie94", yellow, blue, 57.535453706667425 },
    { "cie94", dark1, dark2, 1.671119130541200 },
    { "cie94-textiles", yellow, red, 88.335553057506502 },
    { "cie94-textiles", yellow, near, 10.612657890048272 },
    { "cie94-textiles", yellow, blue, 60.368687261063329 },
    { "cmc", yellow, red, 172.70477129 },
    { "cmc", yellow, near, 20.59732717 },
    { "cmc", yellow, blue, 121.71841479 },
    { "cmc", dark1, dark2, 0.899699975683419 },
    { "din99", { 60.2574, -34.0099, 36.2677 }, { 60.4626, -34.1751, 39.4387 }, 1.177216620111552 },
    { "din99", { 63.0109, -31.0961, -5.8663 }, { 62.8187, -29.7946, -4.0864 }, 0.987529977993114 },
    { "din99", { 35.0831, -44.1164, 3.7933 }, { 35.0232, -40.0716, 1.5901 }, 1.535894757971742 },
    { "cie76", yellow, red, 451.7133019 },
    { "hyab", { 39.91531343, 51.16658481, 146.12933781 },
      { 53.12207516, -39.92365056, 249.54831278 }, 151.0215481 },
  };
  for (const auto& one : published)
  {
    const msi::ColorDifference difference(msi::colorDifferenceNamed(one.formula));
    EXPECT_NEAR(
      difference(one.lab1, one.lab2), one.expected, 1e-7 + 1e-5 * (one.formula == "ciede2000"))
      << one.formula;
  }
}

TEST(ColorDifference, IsNamedWithItsFactors)
{
  const Eigen::Vector3d yellow(100.0, 21.57210357, 272.22819350);
  const Eigen::Vector3d red(100.0, 426.67945353, 72.39590835);
  // As the test suite of colour-science has it; both have one lightness, so that its factor makes no difference.
  EXPECT_NEAR(msi::ColorDifference::named("cmc(1:1)")(yellow, red), 172.70477129, 1e-7);
  EXPECT_EQ(msi::ColorDifference::named("cmc(1:1)").metric(), "dECMC(1:1)");
  EXPECT_EQ(msi::ColorDifference::named("cmc(2:1)").metric(), "dECMC");
  EXPECT_EQ(msi::ColorDifference::named("cmc").factors().lightness, 2.0);
  EXPECT_EQ(msi::ColorDifference::named("ciede2000(2:1:1.5)").metric(), "dE00(2:1:1.5)");
  EXPECT_EQ(msi::ColorDifference::named("ciede2000(2:1:1.5)").factors().hue, 1.5);
  EXPECT_EQ(msi::ColorDifference::named("hyab").metric(), "dEHyAB");
  for (const char* bad : { "cmc(1)", "cmc(1:1:1:1)", "cmc(1:)", "cmc(:1)", "cmc()", "cmc(a:b)",
         "cmc(1,1)", "cmc(0:1)", "hyab(2:1)", "cmc(", "dE(1:1)", "" })
  {
    EXPECT_THROW(msi::ColorDifference::named(bad), std::invalid_argument) << bad;
  }
  EXPECT_EQ(differenceMessageOf([] { msi::ColorDifference::named("cmc(1)"); }),
    "the color difference 'cmc(1)' has no readable factors; expected lightness : chroma or "
    "lightness : chroma : hue, like cmc(1:1) or ciede2000(2:1:1)");
}

TEST(ColorDifference, DividesByItsFactors)
{
  // Lightness alone: the difference is inverse to the factor of lightness.
  for (const char* name : { "ciede2000", "cie94", "cie94-textiles", "cmc" })
  {
    const auto& formula = msi::colorDifferenceNamed(name);
    const Eigen::Vector3d a(50.0, 10.0, 10.0);
    const Eigen::Vector3d b(53.0, 10.0, 10.0);
    const double one = msi::ColorDifference(formula, { 1.0, 1.0, 1.0 })(a, b);
    EXPECT_NEAR(msi::ColorDifference(formula, { 4.0, 1.0, 1.0 })(a, b), one / 4.0, 1e-12) << name;
  }
}

TEST(ColorDifference, IsSymmetricWhereItSaysSo)
{
  const Eigen::Vector3d a(50.0, 20.0, -30.0);
  const Eigen::Vector3d b(47.0, 5.0, 12.0);
  for (const auto& formula : msi::colorDifferences())
  {
    const msi::ColorDifference difference(formula);
    EXPECT_EQ(difference(a, a), 0.0) << formula.name;
    EXPECT_GT(difference(a, b), 0.0) << formula.name;
    if (formula.symmetric)
    {
      EXPECT_NEAR(difference(a, b), difference(b, a), 1e-12) << formula.name;
    }
    else
    {
      EXPECT_GT(std::abs(difference(a, b) - difference(b, a)), 0.1) << formula.name;
    }
  }
}

TEST(ColorDifference, BlocksHoldWhatPairsHoldAndNaNStaysInItsPair)
{
  Eigen::Matrix3Xd first = 40.0 * Eigen::Matrix3Xd::Random(3, 37);
  Eigen::Matrix3Xd second = first + Eigen::Matrix3Xd::Random(3, 37);
  first.row(0).array() += 50.0;
  second.row(0).array() += 50.0;
  second(1, 11) = std::numeric_limits<double>::quiet_NaN();
  for (const auto& formula : msi::colorDifferences())
  {
    const msi::ColorDifference difference(formula);
    Eigen::VectorXd block(37);
    difference.apply(first, second, block);
    Eigen::VectorXf single(37);
    const Eigen::Matrix3Xf firstSingle = first.cast<float>();
    const Eigen::Matrix3Xf secondSingle = second.cast<float>();
    difference.apply(firstSingle, secondSingle, single);
    for (Eigen::Index i = 0; i < 37; ++i)
    {
      if (i == 11)
      {
        EXPECT_TRUE(std::isnan(block[i])) << formula.name;
        EXPECT_TRUE(std::isnan(single[i])) << formula.name;
        continue;
      }
      EXPECT_EQ(block[i], difference(first.col(i), second.col(i))) << formula.name;
      const double exact =
        difference(firstSingle.col(i).cast<double>(), secondSingle.col(i).cast<double>());
      EXPECT_NEAR(single[i], exact, (formula.name == "ciede2000" ? 4e-6 : 6e-8) * exact)
        << formula.name;
    }
  }
}

TEST(ColorDifference, RefusesBadFactorsAndSaysWhy)
{
  EXPECT_EQ(differenceMessageOf(
              [] {
                msi::ColorDifference(msi::colorDifferenceNamed("cmc"), { 0.0, 1.0, 1.0 });
              }),
    "the lightness factor of CMC(l:c) is 0; expected a finite value above zero");
  EXPECT_EQ(differenceMessageOf(
              [] {
                msi::ColorDifference(msi::colorDifferenceNamed("hyab"), { 1.0, 2.0, 1.0 });
              }),
    "the chroma factor of HyAB is 2; this formula has no factors, expected 1");
  EXPECT_EQ(differenceMessageOf([] { msi::colorDifferenceNamed("magic"); }),
    "there is no color difference 'magic'; expected one of ciede2000, cie94, cie94-textiles, cmc, "
    "din99, cie76, hyab");
}

}
