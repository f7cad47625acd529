#include "Kernels/Difference/CIEDE2000.h"
#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/ResponseColor.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdlib>
#include <cstring>
#include <limits>
#include <stdexcept>
#include <string>

namespace
{

constexpr Eigen::Index Channels = 16;
constexpr Eigen::Index Pixels = 20'003;

const msi::TristimulusTransform& tristimulus()
{
  static const msi::TristimulusTransform transform(
    msi::WavelengthGrid::uniform(400.0, 700.0, 10.0), msi::Illuminant::named("D65"));
  return transform;
}

// Coefficients of both signs that add up to 20 a band, and 1 with their signs: what an ill-conditioned fit gives.
msi::AffineTransform affine()
{
  std::srand(5);
  Eigen::MatrixXd coefficients = Eigen::MatrixXd::Random(31, Channels + 1);
  coefficients.col(Channels).setConstant(0.01);
  for (Eigen::Index band = 0; band < coefficients.rows(); ++band)
  {
    auto row = coefficients.row(band).head(Channels);
    row.array() -= row.mean();
    row *= 19.0 / row.cwiseAbs().sum();
    row.array() += 1.0 / Channels;
  }
  return msi::AffineTransform(coefficients);
}

Eigen::MatrixXf responses()
{
  std::srand(6);
  return Eigen::MatrixXf::Random(Channels, Pixels).array() + 0.5F;
}

// By reflectance, all in double.
Eigen::Matrix3Xd expectedLab()
{
  Eigen::Matrix3Xd lab = tristimulus()(affine()(responses().cast<double>()));
  msi::CIELAB(tristimulus().whitePoint()).fromXYZ(lab, lab);
  return lab;
}

Eigen::Matrix3Xf fusedLab()
{
  Eigen::Matrix3Xf lab(3, Pixels);
  msi::ResponseColor(affine(), tristimulus()).lab(responses().data(), lab.data(), Pixels);
  return lab;
}

TEST(ResponseColor, IsThatOfTheReflectanceWithinTheBound)
{
  const Eigen::Matrix3Xd expected = expectedLab();
  const Eigen::Matrix3Xd got = fusedLab().cast<double>();
  const double worst = (got - expected).cwiseAbs().maxCoeff();
  EXPECT_LT(worst, 3e-3); // as ResponseColor.h states
  ::testing::Test::RecordProperty("worst", std::to_string(worst));
  EXPECT_GT((expected.colwise() - expected.col(0)).norm(), 1000.0); // colors all over
  const Eigen::Matrix3Xd measured = expected.rowwise().reverse();
  Eigen::VectorXd fused(Pixels);
  Eigen::VectorXd unfused(Pixels);
  msi::CIEDE2000().apply(measured, got, fused);
  msi::CIEDE2000().apply(measured, expected, unfused);
  EXPECT_LT((fused - unfused).cwiseAbs().maxCoeff(), 4e-3);
}

TEST(ResponseColor, TheSameBytesForEverySplitAndANaNInItsOwnPixel)
{
  const msi::ResponseColor color(affine(), tristimulus());
  const Eigen::Matrix3Xf whole = fusedLab();
  Eigen::MatrixXf in = responses();
  in(Channels - 1, 7) = std::numeric_limits<float>::quiet_NaN();
  Eigen::Matrix3Xf pieces(3, Pixels);
  for (Eigen::Index first = 0, size = 1; first < Pixels; first += size, size = size % 7 + 1)
  {
    color.lab(in.col(first).data(), pieces.col(first).data(), std::min(size, Pixels - first));
  }
  EXPECT_TRUE(pieces.col(7).array().isNaN().all());
  pieces.col(7) = whole.col(7);
  EXPECT_EQ(pieces, whole);
}

TEST(ResponseColor, DifferencesAreThoseOfItsColorsToTheByte)
{
  const msi::ResponseColor color(affine(), tristimulus());
  const msi::CIEDE2000Factors factors{ 2.0, 1.0, 0.5 };
  Eigen::MatrixXf in = responses();
  in(3, 1000) = std::numeric_limits<float>::quiet_NaN();
  in.col(1001).setConstant(1e12F); // beyond what is computed in single precision
  Eigen::Matrix3Xf colors(3, Pixels);
  color.lab(in.data(), colors.data(), Pixels);
  Eigen::Matrix3Xf measured = fusedLab().rowwise().reverse();
  measured.col(2000) = Eigen::Vector3f(50.0F, 20.0F, -10.0F);
  Eigen::VectorXf expected(Pixels);
  msi::CIEDE2000(factors).apply(measured, colors, expected);
  EXPECT_TRUE(std::isnan(expected(1000)));
  EXPECT_TRUE(std::isfinite(expected(1001)));
  const auto differences = [&](Eigen::Index longest)
  {
    Eigen::VectorXf got(Pixels);
    for (Eigen::Index first = 0, size = 1; first < Pixels; first += size, size = size % longest + 1)
    {
      color.differences(factors, in.col(first).data(), measured.col(first).data(), &got(first),
        std::min(size, Pixels - first));
    }
    return got;
  };
  const auto expectSame = [&](const Eigen::VectorXf& got)
  { EXPECT_EQ(std::memcmp(got.data(), expected.data(), sizeof(float) * Pixels), 0); };
  expectSame(differences(300));
  msi::test::withLesserInstructionSets([&] { expectSame(differences(300)); });
}

TEST(ResponseColor, RefusesOtherBands)
{
  try
  {
    msi::ResponseColor(msi::AffineTransform::identity(16), tristimulus());
    FAIL() << "accepted";
  }
  catch (const std::invalid_argument& error)
  {
    EXPECT_STREQ(error.what(), "the estimator gives 16 bands; the tristimulus weights are for 31");
  }
}

}
