// Responses that are none: a result that looks like one must not come out of them without a word.
#include "vtkMetamerismCorrection.h"
#include "vtkReflectanceCalibration.h"
#include "vtkReflectanceEstimation.h"

#include "ExpectedSamples.h"
#include "Support/vtk/Images.h"
#include "Support/vtk/Runs.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
using namespace msi;
using namespace msi::testing;
using msi::test::ExpectedEstimation;

class Judgement : public ::testing::Test
{
protected:
  ExpectedEstimation Expected{ 0 };
  vtkNew<vtkReflectanceCalibration> Fit;
  vtkNew<vtkReflectanceEstimation> Estimation;

  void SetUp() override
  {
    this->Fit->SetInputData(0, tableOf(this->Expected.calibration()));
    this->Estimation->SetInputConnection(1, this->Fit->GetOutputPort(0));
  }
  // The calibration's own responses as an image, changed.
  void look(const std::function<void(Eigen::MatrixXd&)>& change)
  {
    const auto samples = this->Expected.calibration();
    Eigen::MatrixXd pixels = samples.response;
    change(pixels);
    this->Estimation->SetInputData(0,
      newImage<vtkDoubleArray>(
        static_cast<int>(pixels.cols()), 1, ResponsesArray, pixels, channelsOf(samples)));
  }
  std::string error(const std::function<void(Eigen::MatrixXd&)>& change)
  {
    this->look(change);
    return errorOf(this->Estimation);
  }
  std::string warning(const std::function<void(Eigen::MatrixXd&)>& change)
  {
    this->look(change);
    MessageLog log(this->Estimation);
    this->Estimation->Update();
    EXPECT_EQ(log.firstError(), "");
    return log.firstWarning();
  }
};

TEST_F(Judgement, TheCalibrationsOwnResponsesAreNotRemarkedOn)
{
  EXPECT_EQ(this->warning([](Eigen::MatrixXd&) {}), "");
  EXPECT_EQ(this->warning([](Eigen::MatrixXd& pixels)
              { pixels.col(0).setConstant(std::numeric_limits<double>::quiet_NaN()); }),
    "");
}

TEST_F(Judgement, NoFinitePixel)
{
  EXPECT_EQ(this->error([](Eigen::MatrixXd& pixels)
              { pixels.row(0).setConstant(std::numeric_limits<double>::quiet_NaN()); }),
    "no pixel of the image has finite responses in all channels; expected the responses of a "
    "camera; where they were "
    "divided by a white image: is it brighter than the dark image, and of the same camera?");
}

TEST_F(Judgement, AllZero)
{
  EXPECT_EQ(this->error([](Eigen::MatrixXd& pixels) { pixels.setZero(); }),
    "the image is 0 in every pixel; expected the responses of a camera; check the file and the "
    "channels that were read");
}

TEST_F(Judgement, ADeadChannel)
{
  const auto text = this->warning([](Eigen::MatrixXd& pixels) { pixels.row(1).setZero(); });
  EXPECT_NE(text.find(" is 0 in every pixel of the image"), std::string::npos) << text;
}

TEST_F(Judgement, RawCounts)
{
  const auto bright = this->error([](Eigen::MatrixXd& pixels) { pixels *= 4095.0; });
  EXPECT_NE(bright.find("exceed the largest ones of the calibration samples"), std::string::npos)
    << bright;
  EXPECT_NE(bright.find("are they raw counts?"), std::string::npos) << bright;
  // Integers of 16 bits are divided by 65535, whatever the camera's own largest count.
  const auto dim = this->error([](Eigen::MatrixXd& pixels) { pixels *= 0.05; });
  EXPECT_NE(dim.find("are they raw counts?"), std::string::npos) << dim;
  EXPECT_NE(dim.find("set Trust Responses"), std::string::npos) << dim;
}

TEST_F(Judgement, ResponsesThatTheUserTrustsAreOnlyRemarkedOn)
{
  this->Estimation->TrustResponsesOn();
  for (const double factor : { 0.05, 40.0 })
  {
    const auto text = this->warning([factor](Eigen::MatrixXd& pixels) { pixels *= factor; });
    EXPECT_NE(text.find("are they raw counts?"), std::string::npos) << text;
    EXPECT_EQ(text.find("Trust Responses"), std::string::npos) << text;
  }
}

TEST_F(Judgement, PixelsWithoutAnEstimateAreCounted)
{
  this->look(
    [](Eigen::MatrixXd& pixels)
    {
      pixels.conservativeResize(Eigen::NoChange, 4);
      pixels(0, 1) = std::numeric_limits<double>::quiet_NaN();
    });
  this->Estimation->Update();
  EXPECT_EQ(this->Estimation->GetMissingShare(), 0.25);
}

TEST_F(Judgement, MostPixelsOutsideOfTheCalibration)
{
  const auto text = this->warning(
    [](Eigen::MatrixXd& pixels) { pixels.row(0).array() += pixels.row(0).maxCoeff(); });
  EXPECT_NE(text.find("their reflectance is extrapolated"), std::string::npos) << text;
}

TEST_F(Judgement, QualityMapsTellHowFarPixelsLieOutside)
{
  this->Estimation->QualityMapsOn();
  this->look(
    [](Eigen::MatrixXd& pixels)
    {
      // In one channel half of its range above the largest response; then one that is not known.
      const double least = pixels.row(1).minCoeff();
      const double most = pixels.row(1).maxCoeff();
      pixels(1, 0) = most + 0.5 * (most - least);
      pixels(1, 1) = std::numeric_limits<double>::quiet_NaN();
    });
  this->Estimation->Update();
  auto* image = vtkImageData::SafeDownCast(this->Estimation->GetOutputDataObject(0));
  auto* outside = image->GetPointData()->GetArray("OutOfRange");
  ASSERT_NE(outside, nullptr);
  EXPECT_NEAR(outside->GetTuple1(0), 0.5, 1e-6);
  EXPECT_TRUE(std::isnan(outside->GetTuple1(1)));
  for (vtkIdType pixel = 2; pixel < outside->GetNumberOfTuples(); ++pixel)
  {
    EXPECT_EQ(outside->GetTuple1(pixel), 0.0);
  }
  // An affine transform knows no uncertainty. Pixels that are not finite are not judged.
  EXPECT_EQ(image->GetPointData()->GetArray("UncertaintyRms"), nullptr);
  EXPECT_NEAR(this->Estimation->GetOutOfRangeShare(),
    1.0 / static_cast<double>(outside->GetNumberOfTuples() - 1), 1e-12);
}

TEST(TablesOfTwoUnits, AreRefused)
{
  const ExpectedEstimation expected(0);
  auto counts = expected.calibration();
  counts.response *= 4095.0;
  vtkNew<vtkMetamerismCorrection> correction;
  correction->SetInputData(0, tableOf(counts));
  correction->SetInputData(1, tableOf(expected.tuning()));
  const auto text = errorOf(correction);
  EXPECT_NE(text.find("expected both relative to white, or both in counts"), std::string::npos)
    << text;
}

TEST(TablesWithMarksForMissingValues, AreRefused)
{
  const ExpectedEstimation expected(0);
  auto samples = expected.calibration();
  samples.response(1, 2) = -9999.0;
  vtkNew<vtkReflectanceCalibration> fit;
  fit->SetInputData(0, tableOf(samples));
  EXPECT_EQ(errorOf(fit),
    "the calibration table sample 3, response channel 2 is -9999; expected -10 to 1000, as the "
    "other responses are; "
    "remove the sample if this marks a missing value");
}

TEST(TablesWithADeadChannel, AreRemarkedOn)
{
  const ExpectedEstimation expected(0);
  auto samples = expected.calibration();
  samples.response.row(1).setZero();
  vtkNew<vtkReflectanceCalibration> fit;
  fit->SetMethod(vtkReflectanceCalibration::RIDGE);
  fit->SetInputData(0, tableOf(samples));
  MessageLog log(fit);
  fit->Update();
  EXPECT_NE(log.firstWarning().find("the calibration table: Dead? Channel "), std::string::npos)
    << log.firstWarning();
}
}
