#include "Kernels/Estimation/EstimationMethod.h"
#include "Kernels/Estimation/EstimationTestData.h"
#include "Kernels/Estimation/KernelSystem.h"
#include "Kernels/Numerics/Lasso.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>
#include <set>
#include <string>

namespace
{

using msi::test::ExpectedEstimation;
using msi::test::largestDifference;
using msi::test::messageOf;
using msi::test::randomMatrix;

using msi::test::NaN;

// Responses of 4 channels to smooth spectra of 6 bands, of two media that differ by a gain.
msi::SampleSet smoothSamples(Eigen::Index count, double gain, unsigned seed)
{
  const Eigen::ArrayXd band = Eigen::ArrayXd::LinSpaced(6, -1.0, 1.0);
  Eigen::MatrixXd basis(6, 3);
  basis << Eigen::VectorXd::Ones(6), band.matrix(), band.square().matrix();
  Eigen::MatrixXd reflectance = 0.1 * basis * randomMatrix(3, count, seed);
  reflectance.array() += 0.5;
  Eigen::MatrixXd camera(4, 6);
  camera << 0.7, 0.3, 0, 0, 0, 0, 0, 0.4, 0.5, 0.1, 0, 0, 0, 0, 0.1, 0.5, 0.4, 0, 0, 0, 0, 0, 0.3,
    0.7;
  return { reflectance, gain * camera * reflectance + 0.001 * randomMatrix(4, count, seed + 1) };
}

class EveryMethod : public testing::TestWithParam<std::string>
{
protected:
  const msi::EstimationMethod& Method = msi::estimationMethodNamed(GetParam());
  msi::SampleSet Calibration = smoothSamples(40, 1.0, 1);
  msi::SampleSet Tuning = smoothSamples(12, 1.05, 3);

  msi::EstimationFit fit() const { return Method.fit(Calibration, Tuning, {}); }
};

TEST(EstimationMethods, NamesAreUniqueAndFoundAgain)
{
  std::set<std::string> names;
  for (const auto& method : msi::estimationMethods())
  {
    EXPECT_EQ(&msi::estimationMethodNamed(method.name), &method);
    names.emplace(method.name);
    EXPECT_FALSE(method.label.empty());
    EXPECT_FALSE(method.description.empty());
  }
  EXPECT_EQ(names.size(), msi::estimationMethods().size());
  EXPECT_EQ(messageOf([] { msi::estimationMethodNamed("magic"); }),
    "there is no estimation method 'magic'; expected one of direct, pinv, pooled, r-model, banded, "
    "transfer, wiener, adaptive-wiener, pca, kernel-ridge, local-linear, polynomial, "
    "root-polynomial, sparse");
}

TEST_P(EveryMethod, EstimatesBetterThanTheMeanOfTheChart)
{
  const auto fitted = fit();
  const auto test = smoothSamples(50, 1.05, 5);
  const Eigen::MatrixXd error = (*fitted.estimator)(test.response) - test.reflectance;
  const Eigen::MatrixXd ofMean =
    test.reflectance.colwise() - Calibration.reflectance.rowwise().mean();
  EXPECT_LT(error.norm(), 0.5 * ofMean.norm());
  EXPECT_FALSE(fitted.summary.status.empty());
}

TEST_P(EveryMethod, IsTheSameAfterItsParametersWereKept)
{
  const auto fitted = fit();
  const auto kept = msi::estimatorFrom(fitted.estimator->parameters());
  const Eigen::MatrixXd responses = smoothSamples(9, 1.0, 6).response;
  EXPECT_EQ((*kept)(responses), (*fitted.estimator)(responses));
  EXPECT_EQ(kept->knowsUncertainty(), fitted.estimator->knowsUncertainty());
}

TEST_P(EveryMethod, GivesAPixelTheSameBytesInAnyBlock)
{
  const auto fitted = fit();
  const Eigen::MatrixXd responses = smoothSamples(23, 1.0, 9).response;
  const Eigen::MatrixXd whole = (*fitted.estimator)(responses);
  for (Eigen::Index i = 0; i < responses.cols(); ++i)
  {
    EXPECT_EQ((*fitted.estimator)(responses.col(i)), whole.col(i));
  }
  const Eigen::MatrixXf single = responses.cast<float>();
  Eigen::MatrixXf estimate(whole.rows(), whole.cols());
  fitted.estimator->apply(single.data(), estimate.data(), nullptr, single.cols());
  // transfer takes fewer points in single precision: at most .0007 on real pairs (Documentation/Decisions/reflectance-estimation.md).
  EXPECT_LT(
    largestDifference(estimate.cast<double>(), whole), GetParam() == "transfer" ? 1e-3 : 1e-4);
}

TEST_P(EveryMethod, KeepsNaNInItsPixel)
{
  const auto fitted = fit();
  Eigen::MatrixXd responses = smoothSamples(5, 1.0, 9).response;
  const Eigen::MatrixXd before = (*fitted.estimator)(responses);
  responses(2, 3) = NaN;
  const Eigen::MatrixXd after = (*fitted.estimator)(responses);
  for (Eigen::Index i = 0; i < 5; ++i)
  {
    if (i == 3)
    {
      EXPECT_TRUE(after.col(i).array().isNaN().any());
    }
    else
    {
      EXPECT_EQ(after.col(i), before.col(i));
    }
  }
}

TEST_P(EveryMethod, RefusesResponsesOfAnotherCamera)
{
  const auto fitted = fit();
  EXPECT_EQ(messageOf([&] { (*fitted.estimator)(Eigen::MatrixXd::Zero(3, 2)); }).substr(0, 43),
    "the block has 3 values per pixel but the es");
}

INSTANTIATE_TEST_SUITE_P(Registry, EveryMethod,
  testing::Values("direct", "pinv", "pooled", "r-model", "banded", "transfer", "wiener",
    "adaptive-wiener", "pca", "kernel-ridge", "local-linear", "polynomial", "root-polynomial",
    "sparse"),
  [](const auto& method)
  {
    std::string name = method.param;
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return name;
  });

// The methods that choose hyperparameters on the tuning samples.
class ChoosingMethod : public EveryMethod
{
};

TEST_P(ChoosingMethod, SaysThatItCouldNotChoose)
{
  Tuning = smoothSamples(2, 1.05, 3);
  const auto fitted = fit();
  EXPECT_FALSE(fitted.summary.complete);
  EXPECT_NE(fitted.summary.status.find(
              "taken as given: 2 tuning samples are too few to choose; expected at least 3"),
    std::string::npos)
    << fitted.summary.status;
}

TEST_P(ChoosingMethod, RefusesSetsThatDisagree)
{
  Tuning.response = Eigen::MatrixXd(Tuning.response.topRows(3));
  EXPECT_EQ(messageOf([&] { fit(); }),
    "calibration has 4 response channels but tuning has 3; expected the same response channels in "
    "both");
}

INSTANTIATE_TEST_SUITE_P(Registry, ChoosingMethod,
  testing::Values("wiener", "adaptive-wiener", "pca", "kernel-ridge", "local-linear", "polynomial",
    "root-polynomial", "sparse"),
  [](const auto& method)
  {
    std::string name = method.param;
    name.erase(std::remove(name.begin(), name.end(), '-'), name.end());
    return name;
  });

TEST(KernelSystem, LeftOutErrorsAreThoseOfFitsWithoutTheSample)
{
  const Eigen::MatrixXd points = randomMatrix(3, 9, 11);
  const Eigen::MatrixXd gram = points.transpose() * points;
  const Eigen::MatrixXd outputs = randomMatrix(9, 2, 12);
  Eigen::VectorXd weights = randomMatrix(9, 1, 13).cwiseAbs();
  weights.array() += 0.5;
  const auto whole = msi::solveKernelSystem(gram, outputs, weights, 0.1);
  for (Eigen::Index left = 0; left < 9; ++left)
  {
    std::vector<Eigen::Index> kept;
    for (Eigen::Index i = 0; i < 9; ++i)
    {
      if (i != left)
      {
        kept.push_back(i);
      }
    }
    const auto part =
      msi::solveKernelSystem(gram(kept, kept), outputs(kept, Eigen::all), weights(kept), 0.1);
    const Eigen::RowVectorXd estimate =
      gram(std::vector<Eigen::Index>{ left }, kept) * part.coefficients + part.constant.transpose();
    EXPECT_LT((outputs.row(left) - estimate - whole.leftOutError.row(left)).norm(), 1e-12);
  }
}

// A chart of any size in bounded memory and time, and a word that it is not used whole.
TEST(KernelRidge, TakesASpreadOfALargeChartAndSaysSo)
{
  const msi::SampleSet chart{ randomMatrix(3, 4000, 1), randomMatrix(4, 4000, 2) };
  const msi::SampleSet tuning{ randomMatrix(3, 2, 3), randomMatrix(4, 2, 4) };
  const auto fit = msi::estimationMethodNamed("kernel-ridge").fit(chart, tuning, {});
  EXPECT_NE(fit.summary.status.find("from 500 of 4000 chart samples"), std::string::npos)
    << fit.summary.status;
  for (const auto& [name, matrix] : fit.estimator->parameters())
  {
    EXPECT_LE(matrix.cols(), 502) << name;
    EXPECT_LE(matrix.rows(), 502) << name;
  }
}

TEST(Lasso, MeetsTheConditionsOfOptimality)
{
  // Correlated channels, as a camera's are.
  const Eigen::MatrixXd x =
    randomMatrix(8, 3, 1) * randomMatrix(3, 40, 2) + 0.1 * randomMatrix(8, 40, 3);
  const Eigen::MatrixXd y = randomMatrix(5, 8, 4) * x + 0.1 * randomMatrix(5, 40, 5);
  const Eigen::MatrixXd a = x * x.transpose() / 40.0;
  const Eigen::MatrixXd b = x * y.transpose() / 40.0;
  const Eigen::VectorXd penalty = Eigen::VectorXd::LinSpaced(5, 1e-4, 0.5);
  const Eigen::MatrixXd w = msi::solveLasso(a, b, penalty);
  const Eigen::MatrixXd gradient = b - a * w;
  Eigen::Index zeros = 0;
  for (Eigen::Index n = 0; n < 5; ++n)
  {
    const double slack = 1e-8 * b.col(n).cwiseAbs().maxCoeff();
    for (Eigen::Index k = 0; k < 8; ++k)
    {
      if (w(k, n) == 0.0)
      {
        ++zeros;
        EXPECT_LE(std::abs(gradient(k, n)), penalty[n] + slack);
      }
      else
      {
        EXPECT_NEAR(gradient(k, n), std::copysign(penalty[n], w(k, n)), slack);
      }
    }
  }
  EXPECT_GT(zeros, 0);
  EXPECT_LT(zeros, 40);
}

TEST(Lasso, IsTheSoftThresholdOfIndependentChannels)
{
  const Eigen::Vector3d b(0.5, -0.2, 0.05);
  const Eigen::MatrixXd w = msi::solveLasso(
    Eigen::Vector3d(1.0, 2.0, 1.0).asDiagonal(), b, Eigen::VectorXd::Constant(1, 0.1));
  EXPECT_LT(largestDifference(w, Eigen::Vector3d(0.4, -0.05, 0.0)), 1e-15);
}

TEST(EstimatorFrom, NamesWhatIsMissing)
{
  EXPECT_EQ(messageOf(
              [] {
                msi::estimatorFrom({ { "kernel.points", randomMatrix(2, 3, 1) } });
              }),
    "the kernel estimator has no matrix 'kernel.channels'");
  EXPECT_EQ(messageOf(
              []
              {
                msi::estimatorFrom({ { "expansion.kind", Eigen::MatrixXd::Constant(1, 1, 7.0) },
                  { "expansion.coefficients", randomMatrix(2, 3, 1) } });
              }),
    "matrix 'expansion.kind' of the expansion estimator holds no known kind; expected 0, 1, 2 or "
    "3");
}

}
