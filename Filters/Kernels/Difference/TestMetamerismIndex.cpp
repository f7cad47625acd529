#include "Kernels/Difference/MetamerismIndex.h"

#include "Kernels/Difference/CIE76.h"

#include <Eigen/QR>
#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{

using Eigen::MatrixXd;
using Eigen::Vector3d;
using Eigen::VectorXd;
using msi::Illuminant;
using msi::TristimulusTransform;

const msi::WavelengthGrid Bands = msi::WavelengthGrid::uniform(400.0, 700.0, 10.0);

VectorXd smoothSpectrum(double center)
{
  return (0.2 + 0.5 * (-0.5 * ((Bands.vector().array() - center) / 60.0).square()).exp()).matrix();
}

// The part of a change of the spectrum that the reference illuminant does not show.
VectorXd metamericBlack(const VectorXd& change)
{
  const MatrixXd weights = TristimulusTransform(Bands, Illuminant::named("D65")).weights();
  const VectorXd seen = weights.transpose().colPivHouseholderQr().solve(change);
  return change - weights.transpose() * seen;
}

double indexOf(const VectorXd& standard, const VectorXd& sample)
{
  const msi::MetamerismIndex index(Bands, Illuminant::named("D65"), Illuminant::named("A"));
  VectorXd result(1);
  index.apply(standard, sample, result);
  return result(0);
}

// Where a pair matches under the reference illuminant nothing is corrected: the index is the color difference.
TEST(MetamerismIndex, IsTheColorDifferenceOfMetamers)
{
  const VectorXd standard = smoothSpectrum(520.0);
  const VectorXd sample =
    standard + metamericBlack(0.3 * (smoothSpectrum(450.0) - smoothSpectrum(610.0)));
  const TristimulusTransform reference(Bands, Illuminant::named("D65"));
  ASSERT_LT((reference(standard) - reference(sample)).cwiseAbs().maxCoeff(), 1e-9);
  const TristimulusTransform test(Bands, Illuminant::named("A"));
  const msi::CIELAB lab(test.whitePoint());
  const double expected =
    msi::deltaE76(lab.fromXYZ(Vector3d(test(standard))), lab.fromXYZ(Vector3d(test(sample))));
  EXPECT_GT(expected, 0.5);
  EXPECT_NEAR(indexOf(standard, sample), expected, 1e-8);
}

// A sample of twice the reflectance differs under both illuminants by the same factor: no metamerism.
TEST(MetamerismIndex, LeavesAFactorOutOfAccount)
{
  const VectorXd standard = smoothSpectrum(560.0);
  EXPECT_NEAR(indexOf(standard, 2.0 * standard), 0.0, 1e-12);
  EXPECT_EQ(indexOf(standard, standard), 0.0);
}

TEST(MetamerismIndex, ANaNOrBlackSampleStaysInItsOwnPair)
{
  MatrixXd standard(Bands.size(), 3);
  standard << smoothSpectrum(450.0), smoothSpectrum(550.0), smoothSpectrum(650.0);
  MatrixXd sample = standard;
  sample.col(0).setZero();
  sample(3, 1) = std::numeric_limits<double>::quiet_NaN();
  const msi::MetamerismIndex index(Bands, Illuminant::named("D65"), Illuminant::named("A"));
  VectorXd got(3);
  index.apply(standard, sample, got);
  EXPECT_TRUE(std::isnan(got(0)));
  EXPECT_TRUE(std::isnan(got(1)));
  EXPECT_EQ(got(2), 0.0);
}

}
