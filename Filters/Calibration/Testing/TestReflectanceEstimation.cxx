#include "vtkReflectanceEstimation.h"

#include "vtkReflectanceCalibration.h"

#include "ExpectedSamples.h"
#include "Support/vtk/Images.h"
#include "Support/vtk/PieceSource.h"
#include "Support/vtk/Runs.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
using namespace msi;
using namespace msi::testing;
using msi::test::ExpectedEstimation;
using msi::test::largestDifference;

// The direct calibration of problem 0, and an image of other responses.
class ImageEstimation : public ::testing::Test
{
protected:
  ExpectedEstimation Expected{ 0 };
  WavelengthGrid Channels = channelsOf(Expected.calibration());
  vtkNew<vtkReflectanceCalibration> Fit;
  vtkNew<vtkReflectanceEstimation> Estimation;

  void SetUp() override
  {
    this->Fit->SetInputData(0, tableOf(this->Expected.calibration()));
    this->Estimation->SetInputConnection(1, this->Fit->GetOutputPort(0));
  }
  Eigen::MatrixXd responses(Eigen::Index pixels) const
  {
    return patternValues(this->Channels.size(), pixels);
  }
  Eigen::MatrixXd run(vtkImageData* image)
  {
    this->Estimation->SetInputData(0, image);
    EXPECT_EQ(errorOf(this->Estimation), "");
    return valuesOf(
      vtkImageData::SafeDownCast(this->Estimation->GetOutputDataObject(0)), ReflectanceArray);
  }
};

// The model of the last run is kept for the next one, but not longer than its table stays as it is.
TEST_F(ImageEstimation, FollowsATransformThatChanges)
{
  const auto response = this->responses(12);
  const auto image = newImage<vtkDoubleArray>(4, 3, ResponsesArray, response, this->Channels);
  this->Fit->Update();
  vtkNew<vtkTable> table;
  table->DeepCopy(this->Fit->GetOutputDataObject(0));
  this->Estimation->SetInputData(1, table);
  const Eigen::MatrixXd before = this->run(image);
  this->Estimation->Modified();
  EXPECT_EQ(this->run(image), before);
  // Another constant in the first band.
  auto* constants = vtkDataArray::SafeDownCast(table->GetColumn(table->GetNumberOfColumns() - 1));
  constants->SetComponent(0, 0, constants->GetComponent(0, 0) + 0.25);
  constants->Modified();
  table->Modified();
  const Eigen::MatrixXd change = this->run(image) - before;
  EXPECT_LT((change.row(0).array() - 0.25).abs().maxCoeff(), 1e-12);
  EXPECT_EQ(change.bottomRows(change.rows() - 1).cwiseAbs().maxCoeff(), 0.0);
}

TEST_F(ImageEstimation, ComputesEveryPixelAsNumPyWould)
{
  const auto response = this->responses(12);
  const auto expected = estimated(this->Expected["direct"], response);
  EXPECT_LT(largestDifference(
              this->run(newImage<vtkDoubleArray>(4, 3, ResponsesArray, response, this->Channels)),
              expected),
    1e-9);
  // Single precision: 24 bits of responses up to 1, amplified by the coefficients.
  const double gain = this->Expected["direct"].cwiseAbs().rowwise().sum().maxCoeff();
  EXPECT_LT(largestDifference(
              this->run(newImage(4, 3, ResponsesArray, response, this->Channels)), expected),
    gain * 1e-6);
}

TEST_F(ImageEstimation, ReplacesTheResponsesAndNamesTheBands)
{
  this->run(newImage(2, 1, ResponsesArray, this->responses(2), this->Channels));
  auto* output = vtkImageData::SafeDownCast(this->Estimation->GetOutputDataObject(0));
  EXPECT_EQ(output->GetPointData()->GetArray(ResponsesArray), nullptr);
  const auto axis = axisOf(output, output->GetPointData()->GetArray(ReflectanceArray));
  ASSERT_TRUE(axis.wavelengths);
  EXPECT_EQ(axis.names, axisOf(bandsOf(this->Expected.calibration())).names);
}

TEST_F(ImageEstimation, KeepsANaNInItsPixel)
{
  auto response = this->responses(6);
  response(2, 4) = std::numeric_limits<double>::quiet_NaN();
  const auto reflectance = this->run(newImage(3, 2, ResponsesArray, response, this->Channels));
  ASSERT_EQ(reflectance.cols(), 6);
  for (Eigen::Index pixel = 0; pixel < 6; ++pixel)
  {
    EXPECT_EQ(reflectance.col(pixel).array().isNaN().all(), pixel == 4) << pixel;
    EXPECT_EQ(reflectance.col(pixel).array().isNaN().any(), pixel == 4) << pixel;
  }
}

TEST_F(ImageEstimation, PiecesAndThreadsGiveTheSameBytes)
{
  vtkNew<PieceSource> source;
  source->SetImage(newImage(40, 30, ResponsesArray, this->responses(1200), this->Channels));
  this->Estimation->SetInputConnection(0, source->GetOutputPort());
  expectSameBytesInThreads(this->Estimation);
  expectSameBytesInPieces(this->Estimation, 4);
}

TEST_F(ImageEstimation, RefusesAnImageOfOtherChannels)
{
  const auto other = WavelengthGrid::uniform(400, 460, 20);
  this->Estimation->SetInputData(
    0, newImage(2, 1, ResponsesArray, patternValues(other.size(), 2), other));
  EXPECT_EQ(errorOf(this->Estimation),
    "the image has 4 channels (400, 420, 440, 460 nm), but the reflectance transform has 5 "
    "channels "
    "(400, 420, .., 480 nm); both must come from the same camera with the same channels");
}

TEST_F(ImageEstimation, NamesTheArrayThatIsMissing)
{
  this->Estimation->SetInputData(
    0, newImage(2, 1, ResponsesArray, this->responses(2), this->Channels));
  this->Estimation->SetResponseArray("raw");
  EXPECT_EQ(errorOf(this->Estimation), "the image has no point array 'raw'; it has 'Responses'");
}
}
