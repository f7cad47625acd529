#include "Kernels/Camera/CameraModel.h"

#include "Kernels/Camera/CameraTestData.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;

TEST(CameraResampling, KeepsTheCameraOnItsOwnGrid)
{
  const CameraModel camera = test::sevenChannels();
  EXPECT_EQ(resampled(camera, test::visibleGrid()).responsivity(), camera.responsivity());
}

// Sprague's interpolation is exact for straight lines, and beyond the ends no line is asked for here.
TEST(CameraResampling, AnswersToAStraightLineAsBefore)
{
  const CameraModel camera = test::sevenChannels();
  for (const double step : { 5.0, 20.0 })
  {
    const auto grid = WavelengthGrid::uniform(400.0, 700.0, step);
    const CameraModel other = resampled(camera, grid);
    ASSERT_EQ(other.wavelengths(), grid);
    const auto line = [](const WavelengthGrid& at)
    { return Eigen::VectorXd((at.vector().array() - 300.0) / 500.0); };
    const Eigen::VectorXd expected = camera.responsivity() * line(camera.wavelengths());
    EXPECT_LT((other.responsivity() * line(grid) - expected).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_LT((other.whiteResponse() - camera.whiteResponse()).cwiseAbs().maxCoeff(), 1e-12);
    EXPECT_EQ(other.dark(), camera.dark());
    EXPECT_EQ(other.channels(), camera.channels());
  }
}
}
