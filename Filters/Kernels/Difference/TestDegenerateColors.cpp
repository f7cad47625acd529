// The way from a spectrum to a color difference, for spectra that no instrument gives: what is finite goes through finite,
// the same color has no difference, and neither depends on how small or large the numbers are.
#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"
#include "Kernels/Difference/ColorDifference.h"
#include "Kernels/Difference/SpectralRms.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{

const msi::WavelengthGrid& coarseBands()
{
  static const msi::WavelengthGrid grid = msi::WavelengthGrid::uniform(400.0, 700.0, 20.0);
  return grid;
}

// Nothing, white, below zero, one band alone, and ramps: each times 1e-30, 1 and `largest`.
Eigen::MatrixXd impossibleSpectra(double largest)
{
  const Eigen::Index bands = coarseBands().size();
  Eigen::MatrixXd spectra(bands, 6);
  spectra.col(0).setZero();
  spectra.col(1).setOnes();
  spectra.col(2).setConstant(-1.0);
  spectra.col(3) = Eigen::VectorXd::Unit(bands, 8);
  spectra.col(4).setLinSpaced(0.0, 1.0);
  spectra.col(5).setLinSpaced(1.0, -1.0);
  Eigen::MatrixXd all(bands, 18);
  all << 1e-30 * spectra, spectra, largest * spectra;
  return all;
}

template <typename Scalar>
void expectDefined(double largest)
{
  using Colors = Eigen::Matrix<Scalar, 3, Eigen::Dynamic>;
  using Numbers = Eigen::Matrix<Scalar, Eigen::Dynamic, 1>;
  const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic> spectra =
    impossibleSpectra(largest).cast<Scalar>();
  const msi::TristimulusTransform transform(coarseBands(), msi::Illuminant::named("D65"));
  const msi::CIELAB cielab(transform.whitePoint());
  Colors xyz(3, spectra.cols());
  transform.apply(spectra, xyz);
  ASSERT_TRUE(xyz.allFinite());
  Colors lab(3, spectra.cols());
  cielab.fromXYZ(xyz, lab);
  ASSERT_TRUE(lab.allFinite());
  for (const auto& formula : msi::colorDifferences())
  {
    const msi::ColorDifference difference(formula);
    Numbers apart(spectra.cols());
    difference.apply(lab, lab, apart);
    EXPECT_EQ(apart.cwiseAbs().maxCoeff(), Scalar(0)) << formula.name;
    for (Eigen::Index other = 0; other < spectra.cols(); ++other)
    {
      const Colors standard = lab.col(other).replicate(1, spectra.cols());
      difference.apply(standard, lab, apart);
      EXPECT_TRUE(apart.allFinite()) << formula.name << ", spectrum " << other;
      EXPECT_GE(apart.minCoeff(), Scalar(0)) << formula.name << ", spectrum " << other;
    }
  }
}

TEST(DegenerateColors, WhatIsFiniteStaysFinite)
{
  expectDefined<double>(1e30);
}

TEST(DegenerateColors, SinglePrecisionGoesAsFarAsSensorsDo)
{
  expectDefined<float>(1e9);
}

TEST(DegenerateColors, TheRmsIsAsLargeAsTheSpectra)
{
  const Eigen::MatrixXd spectra = impossibleSpectra(1e30);
  const Eigen::MatrixXd none = Eigen::MatrixXd::Zero(spectra.rows(), spectra.cols());
  Eigen::VectorXd rms(spectra.cols());
  msi::spectralRms(spectra, none, rms);
  EXPECT_EQ(rms[0], 0.0);
  EXPECT_DOUBLE_EQ(rms[1], 1e-30);
  EXPECT_DOUBLE_EQ(rms[7], 1.0);
  EXPECT_DOUBLE_EQ(rms[13], 1e30);
  EXPECT_DOUBLE_EQ(rms[15], 1e30 / 4.0); // one band of 16
}

}
