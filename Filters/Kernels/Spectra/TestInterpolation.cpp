#include "Kernels/Spectra/Interpolation.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <string>

namespace
{

using msi::InterpolationMethod;
using msi::resamplingMatrix;
using msi::WavelengthGrid;

const InterpolationMethod AllMethods[] = { InterpolationMethod::Linear,
  InterpolationMethod::CubicLagrange, InterpolationMethod::Sprague,
  InterpolationMethod::CubicSpline };

std::string messageOf(const WavelengthGrid& from, InterpolationMethod method)
{
  try
  {
    resamplingMatrix(from, WavelengthGrid({ 500.0 }), method);
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return {};
}

double valueAt(const WavelengthGrid& from, const Eigen::VectorXd& values, double wavelength,
  InterpolationMethod method)
{
  return (resamplingMatrix(from, WavelengthGrid({ wavelength }), method) * values)(0);
}

// Values that colour-science 0.4 prints in its documentation of SpragueInterpolator; the first
// three lie in an end interval, where the boundary values matter, the last in the other one.
TEST(Interpolation, SpragueMatchesColourScience)
{
  const auto from = WavelengthGrid::uniform(500.0, 506.0, 1.0);
  Eigen::VectorXd values(7);
  values << 5.9200, 9.3700, 10.8135, 4.5100, 69.5900, 27.8007, 86.0500;
  const auto method = InterpolationMethod::Sprague;
  EXPECT_NEAR(valueAt(from, values, 500.25, method), 6.72951612, 5e-9);
  EXPECT_NEAR(valueAt(from, values, 500.5, method), 7.21850256056, 5e-12);
  EXPECT_NEAR(valueAt(from, values, 500.75, method), 7.81406251, 5e-9);
  EXPECT_NEAR(valueAt(from, values, 505.5, method), 43.77379185, 5e-9);
}

// Expected values by SciPy 1.10, CubicSpline(bc_type="not-a-knot").
TEST(Interpolation, CubicSplineMatchesSciPyOnAnUnevenGrid)
{
  const WavelengthGrid from({ 400, 410, 425, 450, 480, 500, 540, 560, 610, 650, 700 });
  Eigen::VectorXd values(from.size());
  for (Eigen::Index i = 0; i < from.size(); ++i)
  {
    values(i) = 0.4 + 0.3 * std::sin(from[i] / 37.0) + 0.1 * std::cos(from[i] / 11.0);
  }
  const WavelengthGrid to({ 400, 403.5, 417, 437.25, 475, 499, 520, 555.5, 600, 633, 688, 700 });
  Eigen::VectorXd expected(to.size());
  expected << 0.12842158098747714, 0.1574104519588854, 0.20518376247322961, 0.1549666788226108,
    0.5557451198919039, 0.6535975203629041, 0.6835209880022096, 0.6654153313292046,
    0.32206056162397145, 0.07792449518695213, 0.27566654108664135, 0.49013861238171663;
  const Eigen::VectorXd got = resamplingMatrix(from, to, InterpolationMethod::CubicSpline) * values;
  EXPECT_LT((got - expected).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Interpolation, ReproducesThePolynomialsItClaims)
{
  const auto from = WavelengthGrid::uniform(400.0, 700.0, 10.0);
  const auto inner = WavelengthGrid::uniform(420.0, 680.0, 1.0);
  const auto whole = WavelengthGrid::uniform(400.0, 700.0, 1.0);
  const auto worst = [&from](const WavelengthGrid& to, InterpolationMethod method, int degree)
  {
    const auto power = [degree](const WavelengthGrid& grid)
    { return Eigen::VectorXd(((grid.vector().array() - 540.0) / 100.0).pow(degree)); };
    return (resamplingMatrix(from, to, method) * power(from) - power(to)).cwiseAbs().maxCoeff();
  };
  EXPECT_LT(worst(whole, InterpolationMethod::Linear, 1), 1e-14);
  EXPECT_LT(worst(whole, InterpolationMethod::Sprague, 1), 1e-13);
  EXPECT_LT(worst(inner, InterpolationMethod::Sprague, 4), 1e-13);
  EXPECT_LT(worst(whole, InterpolationMethod::CubicLagrange, 3), 1e-12);
  EXPECT_LT(worst(whole, InterpolationMethod::CubicSpline, 3), 1e-12);
}

TEST(Interpolation, CubicLagrangePassesThroughTheFourNearestValues)
{
  // At the middle of an interval the weights are -1/16, 9/16, 9/16, -1/16; in an end interval 5/16,
  // 15/16, -5/16, 1/16.
  const auto from = WavelengthGrid::uniform(400.0, 450.0, 10.0);
  Eigen::MatrixXd expected(3, 6);
  expected << 5, 15, -5, 1, 0, 0, 0, -1, 9, 9, -1, 0, 0, 0, 1, -5, 15, 5;
  const Eigen::MatrixXd got = 16.0 *
    resamplingMatrix(
      from, WavelengthGrid({ 405.0, 425.0, 445.0 }), InterpolationMethod::CubicLagrange);
  EXPECT_LT((got - expected).cwiseAbs().maxCoeff(), 1e-13);
}

TEST(Interpolation, CubicLagrangeLowersItsDegreeOnSmallGrids)
{
  const WavelengthGrid to({ 400.0, 475.0, 600.0 });
  for (const int count : { 1, 2, 3 })
  {
    const auto from = WavelengthGrid::uniform(400.0, 400.0 + 100.0 * (count - 1), 100.0);
    const auto power = [count](double wavelength)
    { return std::pow(wavelength / 500.0, count - 1); };
    const Eigen::VectorXd got = resamplingMatrix(from, to, InterpolationMethod::CubicLagrange) *
      from.vector().unaryExpr(power);
    const double second = std::min(475.0, from.back());
    EXPECT_NEAR(got(0), power(400.0), 1e-14);
    EXPECT_NEAR(got(1), power(second), 1e-14);
    EXPECT_NEAR(got(2), power(from.back()), 1e-14);
  }
}

TEST(Interpolation, KeepsTheValuesOfTheGridAndSumsToOne)
{
  const auto from = WavelengthGrid::uniform(400.0, 700.0, 10.0);
  const auto to = WavelengthGrid::uniform(360.0, 830.0, 1.0);
  for (const auto method : AllMethods)
  {
    EXPECT_TRUE(resamplingMatrix(from, from, method).isIdentity(1e-15));
    const Eigen::VectorXd sums = resamplingMatrix(from, to, method).rowwise().sum();
    EXPECT_LT((sums.array() - 1.0).abs().maxCoeff(), 1e-13);
  }
}

TEST(Interpolation, HoldsTheEndValuesAndSaysSo)
{
  const auto from = WavelengthGrid::uniform(400.0, 700.0, 20.0);
  const WavelengthGrid outside({ 380.0, 399.999, 700.001, 780.0 });
  const Eigen::VectorXd values = Eigen::VectorXd::LinSpaced(from.size(), 0.2, 0.9);
  Eigen::VectorXd expected(4);
  expected << 0.2, 0.2, 0.9, 0.9;
  for (const auto method : AllMethods)
  {
    const Eigen::VectorXd got = resamplingMatrix(from, outside, method) * values;
    EXPECT_LT((got - expected).cwiseAbs().maxCoeff(), 1e-15);
  }
  EXPECT_TRUE(msi::needsExtrapolation(from, outside));
  EXPECT_TRUE(msi::needsExtrapolation(from, WavelengthGrid({ 500.0, 701.0 })));
  EXPECT_FALSE(msi::needsExtrapolation(from, WavelengthGrid({ 400.0, 555.0, 700.0 })));
}

TEST(Interpolation, RecommendsByTheGrid)
{
  using msi::recommendedInterpolation;
  EXPECT_EQ(recommendedInterpolation(WavelengthGrid::uniform(400.0, 700.0, 10.0)),
    InterpolationMethod::Sprague);
  EXPECT_EQ(recommendedInterpolation(WavelengthGrid::uniform(400.0, 700.0, 100.0)),
    InterpolationMethod::CubicSpline);
  const WavelengthGrid uneven({ 400, 420, 430, 500, 560, 600, 700 });
  EXPECT_EQ(recommendedInterpolation(uneven), InterpolationMethod::CubicSpline);
  EXPECT_EQ(
    recommendedInterpolation(WavelengthGrid({ 400, 500, 600 })), InterpolationMethod::Linear);
  EXPECT_EQ(resamplingMatrix(uneven, WavelengthGrid({ 480.0 })),
    resamplingMatrix(uneven, WavelengthGrid({ 480.0 }), InterpolationMethod::CubicSpline));
}

TEST(Interpolation, OneWavelengthIsHeldEverywhere)
{
  const Eigen::MatrixXd matrix =
    resamplingMatrix(WavelengthGrid({ 550.0 }), WavelengthGrid({ 400.0, 550.0, 700.0 }));
  EXPECT_EQ(matrix, Eigen::MatrixXd::Ones(3, 1));
}

TEST(Interpolation, ANaNStaysInItsOwnSpectrum)
{
  const auto from = WavelengthGrid::uniform(400.0, 700.0, 10.0);
  Eigen::MatrixXd spectra = Eigen::MatrixXd::Constant(from.size(), 3, 0.5);
  spectra(4, 1) = std::numeric_limits<double>::quiet_NaN();
  const Eigen::MatrixXd got =
    resamplingMatrix(from, WavelengthGrid::uniform(400.0, 700.0, 5.0)) * spectra;
  EXPECT_TRUE(got.col(0).allFinite());
  EXPECT_TRUE(got.col(1).hasNaN());
  EXPECT_TRUE(got.col(2).allFinite());
}

TEST(Interpolation, RefusesAGridThatDoesNotCarryTheMethod)
{
  EXPECT_EQ(messageOf(WavelengthGrid::uniform(400.0, 500.0, 25.0), InterpolationMethod::Sprague),
    "Sprague interpolation needs at least 6 wavelengths; the grid has 5");
  EXPECT_EQ(messageOf(WavelengthGrid({ 400, 500, 600 }), InterpolationMethod::CubicSpline),
    "cubic spline interpolation needs at least 4 wavelengths; the grid has 3");
  EXPECT_EQ(
    messageOf(WavelengthGrid({ 400, 410, 420, 431, 440, 450 }), InterpolationMethod::Sprague),
    "Sprague interpolation needs a uniform wavelength grid; the spacing of this one varies. Take "
    "the cubic spline");
}

}
