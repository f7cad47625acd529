#include "Kernels/Camera/Effects/TailWeights.h"

#include "Kernels/Camera/CameraTestData.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using msi::test::rasterScene;

// By the definition, one sample after the other.
Eigen::MatrixXd meanOf(const Eigen::MatrixXd& signal, const msi::SampleScene& scene, double reach,
  const std::vector<char>& usable)
{
  Eigen::MatrixXd mean(signal.rows(), signal.cols());
  for (Eigen::Index j = 0; j < signal.cols(); ++j)
  {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(signal.rows());
    double weights = 0.0;
    for (const auto& other : scene.surround()[static_cast<std::size_t>(j)])
    {
      if (usable[static_cast<std::size_t>(other.sample)] != 0)
      {
        const double weight =
          std::exp(-scene.distances()[static_cast<std::size_t>(other.distance)] / reach);
        sum += weight * signal.col(other.sample);
        weights += weight;
      }
    }
    mean.col(j) = weights > 0.0 ? Eigen::VectorXd(sum / weights) : Eigen::VectorXd(signal.col(j));
  }
  return mean;
}

TEST(TailWeights, MeanIsByTheDefinitionForAnyNumberOfChannels)
{
  const msi::SampleScene scene = rasterScene();
  std::vector<char> usable(48, 1);
  usable[5] = 0;
  for (const Eigen::Index channels : { 1, 2, 3, 7, 8, 9, 15, 16, 31, 40 })
  {
    const Eigen::MatrixXd signal = Eigen::MatrixXd::Random(channels, 48);
    EXPECT_EQ(msi::TailWeights(scene, 2.0, usable).mean(signal), meanOf(signal, scene, 2.0, usable))
      << channels << " channels";
  }
}

TEST(TailWeights, ASampleWithoutUsableSurroundKeepsItsOwn)
{
  const msi::SampleScene scene = rasterScene();
  const Eigen::MatrixXd signal = Eigen::MatrixXd::Random(4, 48);
  EXPECT_EQ(msi::TailWeights(scene, 1.0, std::vector<char>(48, 0)).mean(signal), signal);
}

TEST(TailWeights, KnowWhatTheyAreFor)
{
  const std::vector<char> all(48, 1);
  std::vector<char> most = all;
  most[3] = 0;
  const msi::TailWeights weights(rasterScene(), 2.0, all);
  EXPECT_TRUE(weights.areFor(2.0, all));
  EXPECT_FALSE(weights.areFor(2.1, all));
  EXPECT_FALSE(weights.areFor(2.0, most));
}
}
