#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/TestTable.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>
#include <utility>

namespace
{

using Eigen::Vector3d;
using msi::Illuminant;
using msi::InterpolationMethod;
using msi::StandardObserver;
using msi::TristimulusTransform;
using msi::WavelengthGrid;

// How closely TristimulusTransform.h says that it follows ArgyllCMS. The larger part is illuminant A,
// which ArgyllCMS interpolates linearly between values 5 nm apart.
constexpr double StatedXYZ = 0.005;
constexpr double StatedLab = 0.01;

const Vector3d IccD50(96.42, 100.0, 82.49);

double bell(double nm, double center, double width)
{
  return std::exp(-0.5 * std::pow((nm - center) / width, 2.0));
}

double edge(double nm, double center, double width)
{
  return 1.0 / (1.0 + std::exp(-(nm - center) / width));
}

// The formulas of ArgyllReference.py, one a column.
Eigen::MatrixXd formulas(const WavelengthGrid& grid)
{
  Eigen::MatrixXd reflectance(grid.size(), 6);
  for (Eigen::Index i = 0; i < grid.size(); ++i)
  {
    const double nm = grid[i];
    reflectance.row(i) << 0.5, 0.015 + 0.01 * edge(nm, 600, 20), 0.05 + 0.80 * edge(nm, 590, 10),
      0.04 + 0.60 * bell(nm, 450, 35), 0.05 + 0.50 * bell(nm, 530, 30),
      0.06 + 0.55 * edge(nm, 500, -12) + 0.30 * edge(nm, 660, 12);
  }
  return reflectance;
}

struct Deviation
{
  double xyz = 0.0;
  double lab = 0.0;
};

// The largest deviation from what ArgyllCMS makes of the formulas on the grid `reference`, of what
// the transform makes of them on the grid `own`.
Deviation deviation(
  const WavelengthGrid& own, const WavelengthGrid& reference, InterpolationMethod method)
{
  const TestTable table(
    MULTISPECTRAL_SOURCE_DIR "/Filters/Kernels/Colorimetry/ArgyllReference.csv");
  const msi::CIELAB lab(IccD50);
  const Eigen::MatrixXd reflectance = formulas(own);
  Deviation worst;
  int rows = 0;
  for (std::size_t row = 0; row < table.rows.size(); ++row)
  {
    if (table.number(row, "first") != reference.front() ||
      table.number(row, "last") != reference.back() ||
      table.number(row, "step") != *reference.step())
    {
      continue;
    }
    const TristimulusTransform transform(own, Illuminant::named(table.text(row, "illuminant")),
      StandardObserver::named(table.text(row, "observer")), method);
    const auto sample = static_cast<Eigen::Index>(table.number(row, "reflectance"));
    const Vector3d xyz = transform(reflectance.col(sample));
    const Vector3d expectedXYZ(
      table.number(row, "X"), table.number(row, "Y"), table.number(row, "Z"));
    const Vector3d expectedLab(
      table.number(row, "L"), table.number(row, "a"), table.number(row, "b"));
    worst.xyz = std::max(worst.xyz, (xyz - expectedXYZ).cwiseAbs().maxCoeff());
    worst.lab = std::max(worst.lab, (lab.fromXYZ(xyz) - expectedLab).cwiseAbs().maxCoeff());
    ++rows;
  }
  EXPECT_EQ(rows, 4 * 2 * 6);
  ::testing::Test::RecordProperty("xyz", std::to_string(worst.xyz));
  ::testing::Test::RecordProperty("lab", std::to_string(worst.lab));
  return worst;
}

TEST(TristimulusTransform, MatchesArgyllOnTheSameGrid)
{
  for (const auto& grid :
    { WavelengthGrid::uniform(400.0, 700.0, 10.0), WavelengthGrid::uniform(380.0, 730.0, 10.0) })
  {
    const Deviation got = deviation(grid, grid, InterpolationMethod::CubicLagrange);
    EXPECT_LT(got.xyz, StatedXYZ);
    EXPECT_LT(got.lab, StatedLab);
  }
  // At 20 nm, the coarsest that ASTM E308 has weights for.
  for (const auto& grid :
    { WavelengthGrid::uniform(400.0, 700.0, 20.0), WavelengthGrid::uniform(380.0, 780.0, 20.0) })
  {
    const Deviation got = deviation(grid, grid, InterpolationMethod::CubicLagrange);
    EXPECT_LT(got.xyz, StatedXYZ);
    EXPECT_LT(got.lab, StatedLab);
  }
  // At 5 nm ArgyllCMS interpolates linearly.
  const auto fine = WavelengthGrid::uniform(380.0, 780.0, 5.0);
  const Deviation got = deviation(fine, fine, InterpolationMethod::Linear);
  EXPECT_LT(got.xyz, StatedXYZ);
  EXPECT_LT(got.lab, StatedLab);
}

// Given the reflectance at 1 nm, ArgyllCMS interpolates nothing: what is left is our interpolation.
TEST(TristimulusTransform, AtFiveNanometresMatchesArgyllAtOne)
{
  const auto own = WavelengthGrid::uniform(380.0, 780.0, 5.0);
  const auto reference = WavelengthGrid::uniform(380.0, 780.0, 1.0);
  for (const auto method : { InterpolationMethod::CubicLagrange, InterpolationMethod::Sprague,
         InterpolationMethod::CubicSpline })
  {
    const Deviation got = deviation(own, reference, method);
    EXPECT_LT(got.xyz, StatedXYZ);
    EXPECT_LT(got.lab, StatedLab);
  }
  // Linear interpolation does not reach that.
  EXPECT_GT(deviation(own, reference, InterpolationMethod::Linear).lab, 0.05);
}

TEST(TristimulusTransform, AtTenNanometresMatchesArgyllAtOne)
{
  const auto own = WavelengthGrid::uniform(380.0, 780.0, 10.0);
  const auto reference = WavelengthGrid::uniform(380.0, 780.0, 1.0);
  const Deviation lagrange = deviation(own, reference, InterpolationMethod::CubicLagrange);
  EXPECT_LT(lagrange.xyz, 0.01);
  EXPECT_LT(lagrange.lab, 0.02);
  const Deviation sprague = deviation(own, reference, InterpolationMethod::Sprague);
  EXPECT_LT(sprague.xyz, StatedXYZ);
  EXPECT_LT(sprague.lab, StatedLab);
}

// Chromaticities under the 1931 observer as CIE 15:2004 and, for LED, CIE 15:2018 print
// them: four decimals for lamps. The five of A, D65 and D50 are missed by the fifth, because their
// tables end at 780 nm.
TEST(TristimulusTransform, WhitePointsHaveThePublishedChromaticities)
{
  struct Published
  {
    const char* name;
    double x;
    double y;
    double digit;
  };
  const Published published[] = { { "A", 0.44758, 0.40745, 2.5e-5 },
    { "D65", 0.31272, 0.32903, 2.5e-5 }, { "D50", 0.34567, 0.35851, 2.5e-5 },
    { "FL1", 0.3131, 0.3371, 1e-4 }, { "FL2", 0.3721, 0.3751, 1e-4 },
    { "FL3", 0.4091, 0.3941, 1e-4 }, { "FL4", 0.4402, 0.4031, 1e-4 },
    { "FL5", 0.3138, 0.3452, 1e-4 }, { "FL6", 0.3779, 0.3882, 1e-4 },
    { "FL7", 0.3129, 0.3292, 1e-4 }, { "FL8", 0.3458, 0.3586, 1e-4 },
    { "FL9", 0.3741, 0.3727, 1e-4 }, { "FL10", 0.3458, 0.3588, 1e-4 },
    { "FL11", 0.3805, 0.3769, 1e-4 }, { "FL12", 0.4370, 0.4042, 1e-4 },
    { "LED-B1", 0.4560, 0.4078, 1e-4 }, { "LED-B2", 0.4357, 0.4012, 1e-4 },
    { "LED-B3", 0.3756, 0.3723, 1e-4 }, { "LED-B4", 0.3422, 0.3502, 1e-4 },
    { "LED-B5", 0.3118, 0.3236, 1e-4 }, { "LED-BH1", 0.4474, 0.4066, 1e-4 },
    { "LED-RGB1", 0.4557, 0.4211, 1e-4 }, { "LED-V1", 0.4548, 0.4044, 1e-4 },
    { "LED-V2", 0.3781, 0.3775, 1e-4 }, { "C", 0.31006, 0.31616, 2.5e-5 },
    { "D55", 0.33243, 0.34744, 2.5e-5 }, { "D75", 0.29903, 0.31488, 2.5e-5 },
    { "E", 0.3333, 0.3333, 1e-4 } };
  const auto grid = WavelengthGrid::uniform(400.0, 700.0, 10.0);
  for (const auto& one : published)
  {
    const Vector3d white = TristimulusTransform(grid, Illuminant::named(one.name)).whitePoint();
    EXPECT_NEAR(white(1), 100.0, 1e-12);
    const Vector3d chromaticity = white / white.sum();
    EXPECT_NEAR(chromaticity(0), one.x, 0.6 * one.digit) << one.name;
    EXPECT_NEAR(chromaticity(1), one.y, 0.6 * one.digit) << one.name;
  }
}

// White points that ASTM E308 prints, 1931 and 1964 observers.
TEST(TristimulusTransform, WhitePointsMatchAstmE308)
{
  const auto grid = WavelengthGrid::uniform(400.0, 700.0, 10.0);
  const auto white = [&grid](const char* illuminant, const char* observer)
  {
    return TristimulusTransform(
      grid, Illuminant::named(illuminant), StandardObserver::named(observer))
      .whitePoint();
  };
  const auto near = [](const Vector3d& got, double x, double z)
  { return std::max(std::abs(got(0) - x), std::abs(got(2) - z)); };
  EXPECT_LT(near(white("A", "2"), 109.850, 35.585), 0.001);
  EXPECT_LT(near(white("D65", "2"), 95.047, 108.883), 0.001);
  EXPECT_LT(near(white("F2", "2"), 99.186, 67.393), 0.001);
  EXPECT_LT(near(white("F7", "2"), 95.041, 108.747), 0.001);
  EXPECT_LT(near(white("F11", "2"), 100.962, 64.350), 0.001);
  EXPECT_LT(near(white("A", "10"), 111.144, 35.200), 0.001);
  EXPECT_LT(near(white("D65", "10"), 94.811, 107.304), 0.001);
}

TEST(TristimulusTransform, ThePerfectDiffuserIsTheWhitePoint)
{
  for (const auto& grid : { WavelengthGrid::uniform(400.0, 700.0, 10.0),
         WavelengthGrid({ 410.0, 455.0, 520.0, 530.0, 610.0 }), WavelengthGrid({ 550.0 }) })
  {
    const TristimulusTransform transform(grid, Illuminant::named("F2"));
    const Vector3d white = transform(Eigen::MatrixXd::Ones(grid.size(), 1));
    EXPECT_LT((white - transform.whitePoint()).cwiseAbs().maxCoeff(), 1e-11);
  }
}

TEST(TristimulusTransform, SaysHowMuchItExtrapolates)
{
  const auto share = [](double first, double last)
  {
    return TristimulusTransform(
      WavelengthGrid::uniform(first, last, 10.0), Illuminant::named("D65"))
      .extrapolatedShare();
  };
  EXPECT_EQ(share(360.0, 830.0), Vector3d::Zero());
  // y-bar below 555 nm is half of it, by the symmetry of the luminous efficiency function in kind.
  EXPECT_NEAR(share(560.0, 830.0)(1), 0.5, 0.06);
  EXPECT_GT(share(400.0, 700.0)(2), 0.0);
  EXPECT_LT(share(400.0, 700.0).maxCoeff(), 0.02);
}

TEST(TristimulusTransform, FloatBlocksFollowTheDoubleOnes)
{
  const auto grid = WavelengthGrid::uniform(400.0, 700.0, 10.0);
  const TristimulusTransform transform(grid, Illuminant::named("D65"));
  const Eigen::MatrixXd reflectance = (Eigen::MatrixXd::Random(31, 100'001).array() + 1.0) / 2.0;
  Eigen::Matrix3Xf got(3, 100'001);
  transform.apply(reflectance.cast<float>().eval(), got);
  const Eigen::Matrix3Xd expected = transform(reflectance.cast<float>().cast<double>());
  EXPECT_LT((got.cast<double>() - expected).cwiseAbs().maxCoeff(), 3e-5);
  EXPECT_LT((expected - transform.weights() * reflectance.cast<float>().cast<double>())
              .cwiseAbs()
              .maxCoeff(),
    1e-11);
}

// The bound that TristimulusBlocks.h states, for every number of values; single pixels give the same bytes.
TEST(TristimulusBlocks, SumAnyNumberOfValuesWithinTheBound)
{
  constexpr Eigen::Index Pixels = 103;
  for (const Eigen::Index values : { 1, 2, 3, 4, 5, 7, 16, 31, 32, 33, 81, 401 })
  {
    const Eigen::Matrix3Xd weights =
      Eigen::Matrix3Xf::Random(3, values).cast<double>(); // floats hold them
    const Vector3d constant(0.5, -3.0, 20.0);
    const Eigen::MatrixXf in = Eigen::MatrixXf::Random(values, Pixels);
    const msi::TristimulusBlocks blocks(weights, constant);
    Eigen::Matrix3Xf got(3, Pixels);
    blocks.apply(in.data(), got.data(), Pixels);
    const Eigen::Matrix3Xd expected = (weights * in.cast<double>()).colwise() + constant;
    const Eigen::Matrix3Xd sizes =
      (weights.cwiseAbs() * in.cast<double>().cwiseAbs()).colwise() + constant.cwiseAbs();
    const double roundings = 12.0 + std::floor(static_cast<double>(values - 1) / 32.0);
    EXPECT_LE(((got.cast<double>() - expected).array() / sizes.array()).abs().maxCoeff(),
      roundings * std::pow(2.0, -24))
      << values;
    for (Eigen::Index i = 0; i < Pixels; ++i)
    {
      Eigen::Vector3f alone;
      blocks.apply(in.col(i).data(), alone.data(), 1);
      EXPECT_EQ(alone, got.col(i)) << values;
    }
  }
}

// What stands beside a pixel does not reach it, also where the last values are read twice.
TEST(TristimulusBlocks, ANaNStaysInItsOwnPixel)
{
  const msi::TristimulusBlocks blocks(Eigen::Matrix3Xd::Ones(3, 31));
  Eigen::MatrixXf in = Eigen::MatrixXf::Constant(31, 9, 0.5F);
  in(0, 5) = std::numeric_limits<float>::quiet_NaN();
  in(30, 3) = std::numeric_limits<float>::quiet_NaN();
  Eigen::Matrix3Xf got(3, 9);
  blocks.apply(in.data(), got.data(), 9);
  for (Eigen::Index i = 0; i < 9; ++i)
  {
    EXPECT_EQ(got.col(i).array().isNaN().all(), i == 3 || i == 5) << i;
    EXPECT_EQ(got.col(i).hasNaN(), i == 3 || i == 5) << i;
  }
}

TEST(TristimulusTransform, TheSameBytesForEverySplit)
{
  const auto grid = WavelengthGrid::uniform(400.0, 700.0, 10.0);
  const TristimulusTransform transform(grid, Illuminant::named("A"));
  const Eigen::MatrixXd reflectance = Eigen::MatrixXd::Random(31, 41);
  const Eigen::Matrix3Xd whole = transform(reflectance);
  for (const Eigen::Index size : { 1, 2, 3, 5, 17 })
  {
    Eigen::Matrix3Xd pieces(3, 41);
    for (Eigen::Index first = 0; first < 41; first += size)
    {
      const Eigen::Index count = std::min<Eigen::Index>(size, 41 - first);
      transform.apply(reflectance.middleCols(first, count), pieces.middleCols(first, count));
    }
    EXPECT_EQ(pieces, whole);
  }
}

TEST(TristimulusTransform, ANaNStaysInItsOwnSample)
{
  const auto grid = WavelengthGrid::uniform(400.0, 700.0, 10.0);
  const TristimulusTransform transform(grid, Illuminant::named("D50"));
  Eigen::MatrixXd reflectance = Eigen::MatrixXd::Constant(31, 9, 0.4);
  const Eigen::Matrix3Xd clean = transform(reflectance);
  reflectance(30, 5) = std::numeric_limits<double>::quiet_NaN();
  const Eigen::Matrix3Xd got = transform(reflectance);
  EXPECT_TRUE(got.col(5).hasNaN());
  EXPECT_EQ(got.leftCols(5), clean.leftCols(5));
  EXPECT_EQ(got.rightCols(3), clean.rightCols(3));
}

TEST(TristimulusTransform, RefusesTheWrongNumberOfBandsAndInvisibleIlluminants)
{
  const auto grid = WavelengthGrid::uniform(400.0, 700.0, 10.0);
  try
  {
    TristimulusTransform(grid, Illuminant::named("D65"))(Eigen::MatrixXd::Ones(16, 2));
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(
      error.what(), "reflectance has 16 bands; the tristimulus transform was built for 31");
  }
  try
  {
    const Illuminant infrared(
      "laser diode", WavelengthGrid({ 900.0, 905.0 }), Eigen::Vector2d::Ones());
    TristimulusTransform transform(grid, infrared);
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(error.what(),
      "the observer 'CIE 1931 2 degree', 360 to 830 nm, sees nothing of the illuminant 'laser "
      "diode', 900 to 905 nm");
  }
}

}
