#include "Kernels/Camera/CameraTestData.h"
#include "Kernels/Camera/Effects/MovedSpectrum.h"

#include <gtest/gtest.h>

#include <array>
#include <cmath>

namespace
{
using msi::CameraEffect;
using msi::CameraSimulator;
using msi::WavelengthGrid;

WavelengthGrid fineGrid()
{
  return WavelengthGrid::uniform(400.0, 700.0, 2.0);
}

Eigen::ArrayXd gaussian(const WavelengthGrid& grid, double center, double deviation)
{
  return (-0.5 * ((grid.vector().array() - center) / deviation).square()).exp();
}

// Three Gaussian passbands under an even light.
constexpr double FilterDeviation = 12.0;
msi::CameraModel gaussianCamera()
{
  const WavelengthGrid grid = fineGrid();
  Eigen::MatrixXd responsivity(3, grid.size());
  for (int k = 0; k < 3; ++k)
  {
    responsivity.row(k) = gaussian(grid, 480.0 + 70.0 * k, FilterDeviation).transpose();
  }
  return msi::CameraModel(grid, responsivity, Eigen::VectorXd::Zero(3)).whiteBalanced();
}

Eigen::VectorXd responseTo(const Eigen::VectorXd& reflectance, const CameraEffect& effect)
{
  msi::SceneSamples samples;
  samples.reflectance = reflectance;
  return CameraSimulator(gaussianCamera(), { effect }).respond({ fineGrid(), samples });
}

// Mean of a Gaussian of deviation b, displaced by d, under a Gaussian of deviation a.
double overlap(double a, double b, double d)
{
  const double variance = a * a + b * b;
  return b / std::sqrt(variance) * std::exp(-0.5 * d * d / variance);
}

constexpr double BandDeviation = 20.0;

TEST(FilterShift, MovesAGaussianPassbandOverAGaussianReflectance)
{
  const Eigen::VectorXd band = gaussian(fineGrid(), 550.0, BandDeviation);
  for (const double shift : { -7.3, -2.0, 0.4, 5.5 })
  {
    for (const char* form : { "common", "sampled" })
    {
      EXPECT_NEAR(responseTo(band, { "filter_shift", form, "", { shift } })[1],
        overlap(FilterDeviation, BandDeviation, shift), 2e-5)
        << form << " " << shift;
    }
  }
}

TEST(FilterShift, GrowsWithTheWavelengthAndDiffersByChannel)
{
  const Eigen::VectorXd ramp = (fineGrid().vector().array() - 400.0) / 300.0;
  const Eigen::VectorXd ideal = responseTo(ramp, { "filter_shift", "", "", { 0.0 } });
  const Eigen::VectorXd linear =
    responseTo(ramp, { "filter_shift", "linear", "", { 2.0, 1.5 } }) - ideal;
  for (int k = 0; k < 3; ++k)
  {
    const double shift = 2.0 + 1.5 * (480.0 + 70.0 * k - 550.0) / 100.0;
    EXPECT_NEAR(linear[k], shift / 300.0, 1e-6);
  }
  const Eigen::VectorXd each =
    responseTo(ramp, { "filter_shift", "per_channel", "", { 1.0, -2.0, 0.0 } }) - ideal;
  EXPECT_NEAR(each[0], 1.0 / 300.0, 1e-6);
  EXPECT_NEAR(each[1], -2.0 / 300.0, 1e-6);
  EXPECT_EQ(each[2], 0.0);
}

TEST(FilterShift, KeepsTheResponseToWhite)
{
  const Eigen::VectorXd white = Eigen::VectorXd::Ones(fineGrid().size());
  EXPECT_LT(
    (responseTo(white, { "filter_shift", "", "", { 15.0 } }).array() - 1.0).abs().maxCoeff(),
    1e-13);
}

TEST(FilterBandwidth, WidensAGaussianPassband)
{
  const Eigen::VectorXd band = gaussian(fineGrid(), 550.0, BandDeviation);
  for (const double factor : { 0.6, 0.9, 1.3, 1.8 })
  {
    const double expected = overlap(factor * FilterDeviation, BandDeviation, 0.0);
    EXPECT_NEAR(responseTo(band, { "filter_bandwidth", "", "", { factor } })[1], expected, 2e-5);
    EXPECT_NEAR(responseTo(band, { "filter_bandwidth", "fixed_peak", "", { factor } })[1],
      factor * expected, 2e-5);
  }
}

// Under the light exp(rate wavelength) a Gaussian filter at c of deviation d is a passband at c + rate d^2, and one of deviation f d at
// c + rate f^2 d^2: the stretched passband about c - rate f d^2. With the same area it is exp(rate^2 (f^2 - 1) d^2 / 2) as bright.
TEST(FilterBandwidth, StretchesAboutMiddlesThatAreNotTheCentroids)
{
  constexpr double Rate = 0.02;
  constexpr double Variance = FilterDeviation * FilterDeviation;
  const Eigen::VectorXd band = gaussian(fineGrid(), 550.0, BandDeviation);
  for (const double factor : { 0.6, 0.9, 1.3, 1.8 })
  {
    // Of the camera's second channel the centroid is 550 nm.
    const double middle = -Rate * Variance * (1.0 + factor);
    const double moved = Rate * Variance * (factor * factor - 1.0);
    const double added = (factor * factor - 1.0) * Variance;
    constexpr double Level = 0.5 * Rate * Rate;
    const double expected =
      std::exp(Level * added) * overlap(factor * FilterDeviation, BandDeviation, moved);
    const auto response = [&](double wider, double more)
    {
      return responseTo(band,
        { "filter_bandwidth", "own_middles", "",
          { wider, 0.0, middle, 0.0, 0.0, Level, 0.0, more } })[1];
    };
    EXPECT_NEAR(response(factor, 0.0), expected, 2e-5) << factor;
    EXPECT_NEAR(response(1.0, added), expected, 2e-5) << factor;
  }
}

// Under the light exp(rate wavelength) a filter that moves by some nm is its passband moved, exp(rate shift) as bright.
TEST(FilterShift, IsAsBrightAsTheLightThere)
{
  constexpr double Rate = 0.02;
  constexpr double Shift = 3.0;
  constexpr double Slope = 1.5;
  const Eigen::VectorXd band = gaussian(fineGrid(), 550.0, BandDeviation);
  const Eigen::VectorXd response = responseTo(
    band, { "filter_shift", "own_levels", "", { Shift, Rate, -Rate, 0.5 * Rate, Slope } });
  const std::array<double, 3> level{ Rate, -Rate, 0.5 * Rate };
  for (int k = 0; k < 3; ++k)
  {
    const double off = 70.0 * (k - 1);
    const double shift = Shift + Slope * off / 100.0;
    EXPECT_NEAR(response[k],
      std::exp(level[static_cast<std::size_t>(k)] * shift) *
        overlap(FilterDeviation, BandDeviation, off + shift),
      2e-5)
      << k;
  }
}

// Passbands of one shape at uneven places, of different brightness. Over such channels the response to a spectrum that is linear in
// the wavelength, relative to that to white, is a line through the centers, and to one that is quadratic a parabola: exact between
// three neighbours.
class PassbandsOfNeighbours : public ::testing::Test
{
protected:
  static constexpr std::array<double, 5> Center{ 470.0, 500.0, 540.0, 560.0, 610.0 };
  static msi::CameraModel camera()
  {
    Eigen::MatrixXd responsivity(5, fineGrid().size());
    for (Eigen::Index k = 0; k < 5; ++k)
    {
      responsivity.row(k) = (1.0 + 0.3 * static_cast<double>(k)) *
        gaussian(fineGrid(), Center[static_cast<std::size_t>(k)], 8.0).transpose();
    }
    return { fineGrid(), responsivity, Eigen::VectorXd::Zero(5) };
  }
  // What the effect adds, relative to white.
  static Eigen::VectorXd added(const Eigen::ArrayXd& spectrum, const CameraEffect& effect)
  {
    msi::SceneSamples samples;
    samples.reflectance = spectrum.matrix();
    const msi::SampleScene scene(fineGrid(), samples);
    const Eigen::VectorXd change = CameraSimulator(camera(), { effect }).respond(scene) -
      CameraSimulator(camera(), {}).respond(scene);
    return change.cwiseQuotient(camera().responsivity().rowwise().sum());
  }
};

TEST_F(PassbandsOfNeighbours, AShiftMovesTheResponseAlongALine)
{
  const Eigen::ArrayXd ramp = (fineGrid().vector().array() - 400.0) / 300.0;
  for (const double shift : { -6.0, 0.5, 3.0 })
  {
    const Eigen::VectorXd change = added(ramp, { "filter_shift", "of_neighbours", "", { shift } });
    EXPECT_LT((change.array() - shift / 300.0).abs().maxCoeff(), 1e-9) << shift;
  }
}

TEST_F(PassbandsOfNeighbours, AWidthAddsItsVarianceToASquare)
{
  const Eigen::ArrayXd square = ((fineGrid().vector().array() - 550.0) / 150.0).square();
  for (const double variance : { -40.0, 90.0 })
  {
    const Eigen::VectorXd change =
      added(square, { "filter_bandwidth", "of_neighbours", "", { variance } });
    EXPECT_LT((change.array() - variance / (150.0 * 150.0)).abs().maxCoeff(), 1e-9) << variance;
  }
}

// A Gaussian passband dims a cosine of the wavelength by exp(-w^2 sigma^2 / 2); over channels at a distance h the second derivative
// of such responses is -(2 - 2 cos w h) / h^2 times them.
TEST(FilterBandwidth, OfNeighboursIsAWiderGaussianHoweverMuchWider)
{
  constexpr double Distance = 10.0;
  constexpr double Variance = 250.0; // from a width of 20 nm to one of 42
  constexpr Eigen::Index Channels = 31;
  constexpr Eigen::Index Middle = Channels / 2;
  const WavelengthGrid grid = fineGrid();
  Eigen::MatrixXd responsivity(Channels, grid.size());
  for (Eigen::Index k = 0; k < Channels; ++k)
  {
    responsivity.row(k) =
      gaussian(grid, 400.0 + Distance * static_cast<double>(k), 8.5).transpose();
  }
  const msi::CameraModel camera(grid, responsivity, Eigen::VectorXd::Zero(Channels));
  for (const double period : { 150.0, 75.0 })
  {
    const double w = 2.0 * std::acos(-1.0) / period;
    msi::SceneSamples samples;
    samples.reflectance = Eigen::MatrixXd::Constant(grid.size(), 2, 0.5); // the second one stays so
    samples.reflectance.col(0).array() += 0.4 * (w * (grid.vector().array() - 550.0)).cos();
    const msi::SampleScene scene(grid, samples);
    const auto contrast = [&](const std::vector<CameraEffect>& effects)
    {
      const Eigen::MatrixXd u = CameraSimulator(camera, effects).respond(scene);
      return u(Middle, 0) / u(Middle, 1) - 1.0;
    };
    const double factor =
      contrast({ { "filter_bandwidth", "of_neighbours", "", { Variance } } }) / contrast({});
    const double curvature = (2.0 - 2.0 * std::cos(w * Distance)) / (Distance * Distance);
    EXPECT_NEAR(factor, std::exp(-0.5 * Variance * curvature), 1e-4) << period;
    EXPECT_NEAR(factor, std::exp(-0.5 * Variance * w * w), 0.025) << period;
  }
}

// Passbands of one wavelength at both ends of the grid and two between leave it no room for another one: at the ends v / 2 h^2 of
// the difference to the neighbour is exchanged, to first order.
TEST(FilterBandwidth, OfNeighboursKeepsWhatWouldGoBeyondTheGrid)
{
  const WavelengthGrid grid = fineGrid();
  const Eigen::Index last = grid.size() - 1;
  Eigen::MatrixXd responsivity = Eigen::MatrixXd::Zero(4, grid.size());
  const std::array<Eigen::Index, 4> center{ 0, last / 3, 2 * last / 3, last };
  for (std::size_t k = 0; k < 4; ++k)
  {
    responsivity(static_cast<Eigen::Index>(k), center[k]) = 1.0;
  }
  const msi::CameraModel camera(grid, responsivity, Eigen::VectorXd::Zero(4));
  msi::SceneSamples samples;
  samples.reflectance = ((grid.vector().array() - grid.front()) / 300.0).square().matrix();
  const msi::SampleScene scene(grid, samples);
  const double variance = 0.5;
  const Eigen::VectorXd nominal = CameraSimulator(camera, {}).respond(scene);
  const Eigen::VectorXd change =
    CameraSimulator(camera, { { "filter_bandwidth", "of_neighbours", "", { variance } } })
      .respond(scene) -
    nominal;
  const auto exchanged = [&](Eigen::Index own, Eigen::Index inner)
  {
    const double step =
      grid[center[static_cast<std::size_t>(own)]] - grid[center[static_cast<std::size_t>(inner)]];
    return 0.5 * variance / (step * step) * (nominal[inner] - nominal[own]);
  };
  EXPECT_NEAR(change[0] / exchanged(0, 1), 1.0, 1e-4);
  EXPECT_NEAR(change[3] / exchanged(3, 2), 1.0, 1e-4);
}

TEST_F(PassbandsOfNeighbours, WhiteKeepsItsResponse)
{
  const Eigen::ArrayXd white = Eigen::ArrayXd::Ones(fineGrid().size());
  EXPECT_LT(
    added(white, { "filter_shift", "of_neighbours", "", { 5.0 } }).cwiseAbs().maxCoeff(), 1e-13);
  EXPECT_LT(
    added(white, { "filter_bandwidth", "of_neighbours", "", { 60.0 } }).cwiseAbs().maxCoeff(),
    1e-13);
}

// Two channels have no parabola: nothing changes.
TEST(FilterShift, NeedsThreeChannelsToGoByNeighbours)
{
  const msi::CameraModel camera(
    fineGrid(), Eigen::MatrixXd::Ones(2, fineGrid().size()), Eigen::VectorXd::Zero(2));
  msi::SceneSamples samples;
  samples.reflectance = gaussian(fineGrid(), 550.0, BandDeviation);
  const msi::SampleScene scene(fineGrid(), samples);
  EXPECT_EQ(
    CameraSimulator(camera, { { "filter_shift", "of_neighbours", "", { 5.0 } } }).respond(scene),
    CameraSimulator(camera, {}).respond(scene));
}

TEST(FilterLeak, LetsALongPassTileThroughABlueChannel)
{
  const Eigen::VectorXd longPass = (fineGrid().vector().array() > 600.0).cast<double>();
  const double above = longPass.mean();
  EXPECT_NEAR(responseTo(longPass, { "filter_leak", "", "", { 0.04, 0.0, 0.0, 0.0 } })[0],
    0.04 * above, 1e-12);
  // Tilted to the long waves: mean of 1 + x over 602..700 nm, where x is the position from -1 to 1.
  const double x = (651.0 - 550.0) / 150.0;
  EXPECT_NEAR(responseTo(longPass, { "filter_leak", "", "", { 0.04, 1.0, 0.0, 0.0 } })[0],
    0.04 * above * (1.0 + x), 1e-12);
}

// Of the part of the response to white that is leaked, what falls on the middle 40 nm of the grid.
TEST(FilterLeak, LeaksAtTheEndsOfTheGridWhereItIsBent)
{
  const WavelengthGrid grid = fineGrid();
  const Eigen::VectorXd middle = ((grid.vector().array() - 550.0).abs() < 21.0).cast<double>();
  const Eigen::ArrayXd x = (grid.vector().array() - 550.0) / 150.0;
  const auto leaked = [](const Eigen::VectorXd& reflectance, double bend) -> Eigen::VectorXd
  {
    return responseTo(reflectance, { "filter_leak", "", "", { 0.04, 0.0, bend, 0.0 } }) -
      responseTo(reflectance, { "filter_leak", "", "", { 0.0, 0.0, 0.0, 0.0 } });
  };
  for (const double bend : { -2.0, 1.0, 4.0 })
  {
    const Eigen::ArrayXd spectrum = (bend * (1.5 * x.square() - 0.5)).exp();
    const double expected = 0.04 * (spectrum * middle.array()).sum() / spectrum.sum();
    EXPECT_NEAR(leaked(middle, bend)[0], expected, 1e-12) << bend;
    EXPECT_NEAR(leaked(Eigen::VectorXd::Ones(grid.size()), bend)[0], 0.04, 1e-12) << bend;
  }
}

// The effect is the same as designing the camera under the lamp times `change`.
void expectOtherLamp(const CameraEffect& effect, const Eigen::ArrayXd& change)
{
  const WavelengthGrid grid = fineGrid();
  msi::CameraParts parts;
  parts.detector = msi::siliconDetector(grid);
  parts.light = msi::planckianLight(grid, 2850.0);
  parts.filters = { { 470.0, 30.0 }, { 560.0, 50.0 }, { 640.0, 30.0 } };
  const msi::CameraModel nominal = msi::designCamera(grid, parts);
  parts.light = parts.light.array() * change;
  const msi::CameraModel real = msi::designCamera(grid, parts);
  const CameraSimulator simulator(nominal, { effect }, { true });
  EXPECT_LT((simulator.effectiveResponsivity() - real.responsivity()).cwiseAbs().maxCoeff(), 1e-15);
}

TEST(IlluminantDrift, IsTheCameraUnderTheOtherLamp)
{
  const Eigen::ArrayXd x = (fineGrid().vector().array() - 550.0) / 150.0;
  const Eigen::ArrayXd cubic =
    0.2 * x - 0.1 * (1.5 * x.square() - 0.5) + 0.05 * (2.5 * x.cube() - 1.5 * x);
  expectOtherLamp({ "illuminant_drift", "smooth", "", { 0.2, -0.1, 0.05 } }, cubic.exp());
}

TEST(IlluminantDrift, IsAGainOfEachChannelWhereImagesTellNoMore)
{
  const Eigen::VectorXd gray = Eigen::VectorXd::Constant(fineGrid().size(), 0.5);
  const Eigen::VectorXd response =
    responseTo(gray, { "illuminant_drift", "over_channels", "", { 0.2, 0.1, -0.06, 0.05 } });
  EXPECT_NEAR(response[0], 0.5 * std::exp(-0.2 + 0.1 - 0.06 - 0.05), 1e-12);
  EXPECT_NEAR(response[1], 0.5 * std::exp(0.1 + 0.03), 1e-12);
  EXPECT_NEAR(response[2], 0.5 * std::exp(0.2 + 0.1 - 0.06 + 0.05), 1e-12);
}

TEST(IlluminantDrift, IsABandMoreOfTheLamp)
{
  const Eigen::ArrayXd z = (fineGrid().vector().array() - 530.0) / 25.0;
  expectOtherLamp({ "illuminant_drift", "band", "", { -0.15, 530.0, 25.0 } },
    1.0 - 0.15 * (-0.5 * z.square()).exp());
}

// Expected: the singular value decomposition of numpy 1.24, of the same lamps.
TEST(IlluminantDrift, AnotherLampHasTheDirectionsInWhichStandardLampsDiffer)
{
  const WavelengthGrid grid({ 400.0, 450.0, 545.0, 600.0, 700.0 });
  const double expected[6][5] = { { 2.27956, -0.15468, 0.33552, -0.24503, -0.45426 },
    { 0.7383, -0.60102, -0.64108, -0.24639, 0.87921 },
    { 0.19946, -0.49606, 0.50229, 0.22857, 0.2857 },
    { -0.23408, 0.43133, 0.17715, -0.30276, 0.46153 },
    { 0.06238, 0.06558, -0.03553, 0.14464, 0.16989 },
    { 0.33028, -0.08197, 0.04887, -0.0614, -0.02397 } };
  const msi::CameraModel camera(
    grid, Eigen::MatrixXd::Ones(1, 5), Eigen::VectorXd::Zero(1), { "C1" });
  for (std::size_t shape = 0; shape < 6; ++shape)
  {
    CameraEffect effect{ "illuminant_drift", "another_lamp", "", std::vector<double>(6, 0.0) };
    effect.parameters[shape] = 0.5;
    const Eigen::MatrixXd seen = CameraSimulator(camera, { effect }).effectiveResponsivity();
    for (Eigen::Index i = 0; i < 5; ++i)
    {
      EXPECT_NEAR(std::log(seen(0, i)), 0.5 * expected[shape][i], 1e-4) << shape << ' ' << grid[i];
    }
  }
}

TEST(MovedSpectrum, IsExactForCubicsAndComesToRestOutside)
{
  const WavelengthGrid grid({ 400.0, 410.0, 425.0, 440.0, 460.0, 470.0 });
  const auto cubic = [](double w)
  {
    const double t = (w - 430.0) / 30.0;
    return 0.3 + 0.2 * t - 0.1 * t * t + 0.05 * t * t * t;
  };
  const Eigen::VectorXd values = grid.vector().unaryExpr(cubic);
  Eigen::ArrayXd at(4);
  at << 403.0, 425.0, 436.0, 465.5;
  const Eigen::VectorXd moved = msi::MovedSpectrum(grid).operation(at) * values;
  for (Eigen::Index i = 0; i < at.size(); ++i)
  {
    EXPECT_NEAR(moved[i], cubic(at[i]), 1e-14) << at[i];
  }
  const Eigen::ArrayXd weights = Eigen::ArrayXd::LinSpaced(4, -1.0, 2.0);
  EXPECT_LT((msi::MovedSpectrum(grid).weighted(weights, at) -
              weights.matrix().transpose() * msi::MovedSpectrum(grid).operation(at))
              .norm(),
    1e-14);
  Eigen::ArrayXd outside(3);
  outside << 399.9, 300.0, 480.0;
  const Eigen::MatrixXd operation = msi::MovedSpectrum(grid).operation(outside);
  EXPECT_LT((operation.rowwise().sum().array() - 1.0).abs().maxCoeff(), 1e-12);
  const double slope = (0.2 + 0.2 * 1.0 + 0.15 * 1.0) / 30.0; // of the cubic at 400 nm, t = -1
  EXPECT_NEAR((operation * values)[0], cubic(400.0) - slope * 0.1 / 1.005, 1e-12);
  EXPECT_NEAR((operation * values)[1], cubic(400.0) - slope * 100.0 / 6.0, 1e-12);
}

}
