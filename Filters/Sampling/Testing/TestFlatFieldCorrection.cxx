#include "vtkFlatFieldCorrection.h"

#include "Support/vtk/Images.h"
#include "Support/vtk/PieceSource.h"
#include "Support/vtk/Runs.h"

#include "vtkNew.h"
#include "vtkUnsignedShortArray.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
using namespace msi;
using namespace msi::testing;

const WavelengthGrid FrameGrid({ 450.0, 550.0 });

Eigen::MatrixXd row(std::initializer_list<double> first, std::initializer_list<double> second)
{
  Eigen::MatrixXd values(2, static_cast<Eigen::Index>(first.size()));
  std::copy(first.begin(), first.end(), values.row(0).begin());
  std::copy(second.begin(), second.end(), values.row(1).begin());
  return values;
}

vtkSmartPointer<vtkImageData> frame(const Eigen::MatrixXd& values)
{
  return newImage(static_cast<int>(values.cols()), 1, "counts", values, FrameGrid);
}

Eigen::MatrixXd responses(vtkFlatFieldCorrection* correction)
{
  return valuesOf(correction->GetOutput(), ResponsesArray);
}

TEST(FlatFieldCorrection, DividesByWhiteAboveDark)
{
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputData(0, frame(row({ 100.0, 600.0, 1100.0 }, { 50.0, 150.0, 250.0 })));
  correction->SetInputData(1, frame(row({ 1100.0, 1100.0, 1100.0 }, { 250.0, 450.0, 850.0 })));
  correction->SetInputData(2, frame(row({ 100.0, 100.0, 100.0 }, { 50.0, 50.0, 50.0 })));
  ASSERT_EQ(errorOf(correction), "");
  EXPECT_EQ(responses(correction), row({ 0.0, 0.5, 1.0 }, { 0.0, 0.25, 0.25 }));
  EXPECT_EQ(correction->GetDeadCount(), 0);

  correction->SetWhiteReflectance(0.5);
  ASSERT_EQ(errorOf(correction), "");
  EXPECT_EQ(responses(correction), row({ 0.0, 0.25, 0.5 }, { 0.0, 0.125, 0.125 }));
}

TEST(FlatFieldCorrection, TakesTheOutputsNameAndAxis)
{
  const auto raw = frame(row({ 1.0 }, { 2.0 }));
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputData(0, raw);
  correction->SetPreview(false);
  correction->SetWhiteLevel(2.0);
  ASSERT_EQ(errorOf(correction), "");
  auto* output = correction->GetOutput();
  EXPECT_EQ(output->GetPointData()->GetNumberOfArrays(), 1);
  auto* array = requireSpectralArray(output, "the output");
  EXPECT_STREQ(array->GetName(), ResponsesArray);
  EXPECT_EQ(axisOf(output, array).wavelengths, FrameGrid);
  EXPECT_NE(raw->GetPointData()->GetArray("counts"), nullptr) << "the input was changed";
}

TEST(FlatFieldCorrection, TakesALevelWhereNoWhiteIsConnected)
{
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputData(
    0, newImage<vtkUnsignedShortArray>(2, 1, "counts", row({ 0.0, 4000.0 }, { 1000.0, 2000.0 })));
  correction->SetWhiteLevel(4000.0);
  ASSERT_EQ(errorOf(correction), "");
  EXPECT_EQ(responses(correction), row({ 0.0, 1.0 }, { 0.25, 0.5 }));
}

TEST(FlatFieldCorrection, MarksAndCountsPixelsWhoseWhiteIsNotAboveDark)
{
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputData(0, frame(row({ 1.0, 1.0, 1.0 }, { 1.0, 1.0, 1.0 })));
  correction->SetInputData(1, frame(row({ 2.0, 0.0, 2.0 }, { 2.0, 2.0, -3.0 })));
  ASSERT_EQ(errorOf(correction), "");
  const auto values = responses(correction);
  EXPECT_EQ(correction->GetDeadCount(), 2);
  EXPECT_TRUE(std::isnan(values(0, 1)));
  EXPECT_TRUE(std::isnan(values(1, 2)));
  EXPECT_EQ(values.array().isNaN().count(), 2);
  EXPECT_EQ(values(0, 0), 0.5);
}

TEST(FlatFieldCorrection, KeepsANaNInItsValue)
{
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputData(0, frame(row({ 1.0, NaN, 1.0 }, { 1.0, 1.0, 1.0 })));
  correction->SetInputData(1, frame(row({ 2.0, 2.0, 2.0 }, { 2.0, 2.0, NaN })));
  ASSERT_EQ(errorOf(correction), "");
  const auto values = responses(correction);
  EXPECT_TRUE(std::isnan(values(0, 1)));
  EXPECT_TRUE(std::isnan(values(1, 2)));
  EXPECT_EQ(values.array().isNaN().count(), 2);
}

TEST(FlatFieldCorrection, TakesTheOnlyArrayWhereNoneIsActive)
{
  const auto raw = frame(row({ 1.0 }, { 2.0 }));
  raw->GetPointData()->SetActiveScalars(nullptr);
  ASSERT_EQ(raw->GetPointData()->GetScalars(), nullptr);
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputData(0, raw);
  correction->SetWhiteLevel(2.0);
  ASSERT_EQ(errorOf(correction), "");
  EXPECT_EQ(responses(correction), row({ 0.5 }, { 1.0 }));
  EXPECT_EQ(correction->GetOutput()->GetPointData()->GetArray("counts"), nullptr);
}

TEST(FlatFieldCorrection, NamesTheSizesThatDiffer)
{
  for (const int port : { 1, 2 })
  {
    for (const int width : { 2, 4 })
    {
      vtkNew<vtkFlatFieldCorrection> correction;
      correction->SetInputData(0, newImage(3, 2, "raw", patternValues(2, 6), FrameGrid));
      correction->SetWhiteLevel(2.0);
      ASSERT_EQ(errorOf(correction), "");
      correction->SetInputData(
        port, newImage(width, 2, "frame", patternValues(2, 2 * width), FrameGrid));
      EXPECT_EQ(errorOf(correction),
        std::string("the ") + (port == 1 ? "white" : "dark") + " image has " +
          std::to_string(width) +
          " x 2 pixels, but the raw image has 3 x 2"
          "; take both with the same camera settings");
    }
  }
}

TEST(FlatFieldCorrection, NamesTheChannelsThatDiffer)
{
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputData(0, newImage(3, 2, "raw", patternValues(2, 6), FrameGrid));
  correction->SetInputData(1, newImage(3, 2, "white", patternValues(3, 6)));
  EXPECT_EQ(errorOf(correction),
    "the white image has 3 channels (C1, C2, C3), but the raw image has "
    "2 channels (450, 550 nm); both must come from the same camera with "
    "the same channels");
  correction->SetInputData(
    1, newImage(3, 2, "white", patternValues(2, 6), WavelengthGrid({ 450.0, 560.0 })));
  EXPECT_EQ(errorOf(correction),
    "the white image has 2 channels (450, 560 nm), but the raw image has "
    "2 channels (450, 550 nm); both must come from the same camera with "
    "the same channels");
}

TEST(FlatFieldCorrection, RefusesAWhiteLevelOfZero)
{
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputData(0, frame(row({ 1.0 }, { 2.0 })));
  correction->SetWhiteLevel(0.0);
  EXPECT_EQ(errorOf(correction), "WhiteLevel is 0.000000; expected more than 0");
}

TEST(FlatFieldCorrection, RefusesAnImageWithoutArray)
{
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(2, 2, 1);
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetInputData(0, bare);
  EXPECT_EQ(errorOf(correction), "the raw image has no point array; expected a spectral image");
}

class FlatFieldOfThreeFrames : public ::testing::Test
{
protected:
  static constexpr int Width = 401;
  static constexpr int Height = 250;

  FlatFieldOfThreeFrames()
  {
    for (int port = 0; port < 3; ++port)
    {
      const Eigen::MatrixXd values =
        (patternValues(2, Width * Height).array() + (port == 1 ? 2.0 : 0.0)).matrix();
      Sources[port]->SetImage(newImage(Width, Height, "counts", values, FrameGrid));
      Correction->SetInputConnection(port, Sources[port]->GetOutputPort());
    }
  }
  vtkNew<PieceSource> Sources[3];
  vtkNew<vtkFlatFieldCorrection> Correction;
};

TEST_F(FlatFieldOfThreeFrames, GiveTheSameBytesInThreads)
{
  expectSameBytesInThreads(Correction);
}

TEST_F(FlatFieldOfThreeFrames, GiveTheSameBytesInPieces)
{
  expectSameBytesInPieces(Correction, 3);
}

TEST_F(FlatFieldOfThreeFrames, CanBeStopped)
{
  EXPECT_EQ(errorWhenStopped(Correction), "stopped by the user");
}

TEST(FlatFieldCorrection, PrintsItself)
{
  vtkNew<vtkFlatFieldCorrection> correction;
  correction->SetWhiteReflectance(0.9);
  correction->SetWhiteLevel(4095.0);
  const auto text = printed(correction);
  EXPECT_NE(text.find("WhiteReflectance: 0.9\n"), std::string::npos);
  EXPECT_NE(text.find("WhiteLevel: 4095\n"), std::string::npos);
  EXPECT_NE(text.find("DeadCount: 0\n"), std::string::npos);
}
}
