#include "DemoCamera.h"

#include <gtest/gtest.h>

namespace
{
namespace scenes = msi::scenes;

TEST(DemoCamera, AnswersAWhiteWithOne)
{
  const msi::CameraModel camera = scenes::demoCamera();
  EXPECT_EQ(camera.channelCount(), 16);
  EXPECT_LT((camera.whiteResponse().array() - 1.0).abs().maxCoeff(), 1e-14);
  for (Eigen::Index k = 0; k < 16; ++k)
  {
    EXPECT_NEAR(camera.centroids()[k], 400.0 + 20.0 * double(k), 3.0);
  }
}

}
