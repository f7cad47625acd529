#include "vtkSpectralCubeVolume.h"
#include "vtkSpectralProfile.h"

#include "Support/vtk/Images.h"
#include "Support/vtk/PieceSource.h"
#include "Support/vtk/Runs.h"
#include "Support/vtk/Tables.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace msi;
using namespace msi::testing;

const WavelengthGrid ProfileGrid({ 400.0, 500.0 });

// 3 x 2 pixels: 1 .. 6 in the first band, ten times as much in the second.
vtkSmartPointer<vtkImageData> image(const std::optional<WavelengthGrid>& grid = ProfileGrid)
{
  Eigen::MatrixXd values(2, 6);
  values.row(0) << 1, 2, 3, 4, 5, 6;
  values.row(1) = 10.0 * values.row(0);
  return newImage(3, 2, ResponsesArray, values, grid);
}

TEST(SpectralProfile, GivesTheSpectraOfPoints)
{
  vtkNew<vtkSpectralProfile> profile;
  profile->SetInputData(0, image());
  profile->AddPoint(2.3, 0.4);
  profile->AddPoint(0.0, 1.0);
  ASSERT_EQ(errorOf(profile), "");
  auto* table = profile->GetOutput();
  EXPECT_EQ(columnNames(table), (std::vector<std::string>{ "wavelength", "point 1", "point 2" }));
  ASSERT_EQ(table->GetNumberOfRows(), 2);
  EXPECT_EQ(cell(table, 1, "wavelength"), 500.0);
  EXPECT_EQ(cell(table, 0, "point 1"), 3.0);
  EXPECT_EQ(cell(table, 1, "point 1"), 30.0);
  EXPECT_EQ(cell(table, 1, "point 2"), 40.0);
}

TEST(SpectralProfile, GivesMeanAndDeviationOfARegion)
{
  vtkNew<vtkSpectralProfile> profile;
  profile->SetInputData(0, image(std::nullopt));
  profile->SetRegion(0.5, 2.5, -0.5, 1.5);
  ASSERT_EQ(errorOf(profile), "");
  auto* table = profile->GetOutput();
  EXPECT_EQ(columnNames(table),
    (std::vector<std::string>{
      "channel", "region", "region deviation", "region -s", "region +s" }));
  // 2, 3, 5, 6: mean 4, squares about it 4 + 1 + 1 + 4 over 3.
  const double deviation = std::sqrt(10.0 / 3.0);
  EXPECT_EQ(cell(table, 0, "region"), 4.0);
  EXPECT_NEAR(cell(table, 0, "region deviation"), deviation, 1e-12);
  EXPECT_NEAR(cell(table, 1, "region -s"), 40.0 - 10.0 * deviation, 1e-11);
  EXPECT_NEAR(cell(table, 1, "region +s"), 40.0 + 10.0 * deviation, 1e-11);
}

TEST(SpectralProfile, GivesOneProfileALabel)
{
  vtkNew<vtkSpectralProfile> profile;
  profile->SetInputData(0, image());
  profile->SetInputData(1, newLabels(3, 2, { 1, 0, 3, 1, 0, 0 }));
  ASSERT_EQ(errorOf(profile), "");
  auto* table = profile->GetOutput();
  EXPECT_EQ(table->GetNumberOfColumns(), 1 + 2 * 4);
  EXPECT_EQ(cell(table, 0, "label 1"), 2.5);
  EXPECT_EQ(cell(table, 1, "label 3"), 30.0);
  EXPECT_TRUE(std::isnan(cell(table, 1, "label 3 deviation")));
}

TEST(SpectralProfile, ReadsOnlyTheRowsOfItsPoints)
{
  const auto whole = newImage(4, 1000, ResponsesArray, patternValues(2, 4000), ProfileGrid);
  vtkNew<PieceSource> source;
  source->SetImage(whole);
  vtkNew<vtkSpectralProfile> profile;
  profile->SetInputConnection(0, source->GetOutputPort());
  profile->AddPoint(1.0, 700.0);
  ASSERT_EQ(errorOf(profile), "");
  EXPECT_EQ(
    cell(profile->GetOutput(), 1, "point 1"), valuesOf(whole, ResponsesArray)(1, 700 * 4 + 1));
  EXPECT_EQ(source->LargestRequest(), 4);
}

TEST(SpectralProfile, NamesAPointOutsideAndAnEmptyLabelImage)
{
  vtkNew<vtkSpectralProfile> profile;
  profile->SetInputData(0, image());
  profile->AddPoint(3.0, 0.0);
  EXPECT_EQ(
    errorOf(profile), "the point (3, 0) is not in the image, which reaches from (0, 0) to (2, 1)");
  profile->SetInputData(1, newLabels(3, 2, { 0, 0, 0, 0, 0, 0 }));
  EXPECT_EQ(errorOf(profile), "the label image is 0 everywhere; expected labels 1, 2, ..");
}

TEST(SpectralProfile, GivesTheSpectrumOfTheHandle)
{
  vtkNew<vtkSpectralProfile> profile;
  profile->SetInputData(0, image());
  profile->AddPoint(0.0, 1.0);
  profile->SetHandle(2.3, 0.4, 7.0);
  profile->SetPlace(vtkSpectralProfile::HANDLE);
  ASSERT_EQ(errorOf(profile), "");
  EXPECT_EQ(
    columnNames(profile->GetOutput()), (std::vector<std::string>{ "wavelength", "point 1" }));
  EXPECT_EQ(cell(profile->GetOutput(), 1, "point 1"), 30.0);
  profile->SetHandle(0.0, 5.0, 0.0);
  EXPECT_EQ(
    errorOf(profile), "the point (0, 5) is not in the image, which reaches from (0, 0) to (2, 1)");
}

TEST(SpectralProfile, GivesSpectraAlongTheLine)
{
  vtkNew<vtkSpectralProfile> profile;
  profile->SetInputData(0, image());
  profile->SetPlace(vtkSpectralProfile::LINE);
  profile->SetLineStart(0.0, 0.0, 7.0);
  profile->SetLineEnd(2.0, 1.0, -7.0);
  profile->SetLineCount(3);
  ASSERT_EQ(errorOf(profile), "");
  auto* table = profile->GetOutput();
  EXPECT_EQ(columnNames(table),
    (std::vector<std::string>{ "wavelength", "point 1", "point 2", "point 3" }));
  EXPECT_EQ(cell(table, 1, "point 1"), 10.0);
  EXPECT_EQ(cell(table, 1, "point 2"), 50.0); // (1, 0.5): the row above
  EXPECT_EQ(cell(table, 1, "point 3"), 60.0);
}

TEST(SpectralProfile, PrintsItself)
{
  vtkNew<vtkSpectralProfile> profile;
  profile->AddPoint(1.5, 2.0);
  EXPECT_NE(printed(profile).find("Points: (1.5, 2)"), std::string::npos);
}

TEST(SpectralCubeVolume, PutsBandsIntoSlices)
{
  vtkNew<vtkSpectralCubeVolume> cube;
  cube->SetInputData(0, image());
  cube->SetWavelengthScale(0.1);
  ASSERT_EQ(errorOf(cube), "");
  auto* volume = cube->GetOutput();
  const int* size = volume->GetDimensions();
  EXPECT_EQ(std::vector<int>(size, size + 3), (std::vector<int>{ 3, 2, 2 }));
  EXPECT_DOUBLE_EQ(volume->GetOrigin()[2], 40.0);
  EXPECT_DOUBLE_EQ(volume->GetSpacing()[2], 10.0);
  Eigen::RowVectorXd expected(12);
  expected << 1, 2, 3, 4, 5, 6, 10, 20, 30, 40, 50, 60;
  EXPECT_EQ(valuesOf(volume, ResponsesArray), expected);
}

TEST(SpectralCubeVolume, InterpolatesUnevenWavelengths)
{
  Eigen::MatrixXd values(3, 1);
  values << 1.0, 2.0, 6.0;
  vtkNew<vtkSpectralCubeVolume> cube;
  cube->SetInputData(
    0, newImage(1, 1, ReflectanceArray, values, WavelengthGrid({ 400.0, 420.0, 500.0 })));
  ASSERT_EQ(errorOf(cube), "");
  Eigen::RowVectorXd expected(3);
  expected << 1.0, 3.5, 6.0; // at 400, 450 and 500 nm
  EXPECT_EQ(valuesOf(cube->GetOutput(), ReflectanceArray), expected);
}

TEST(SpectralCubeVolume, GivesTheSameBytesInPieces)
{
  vtkNew<PieceSource> source;
  source->SetImage(newImage(40, 30, ResponsesArray, patternValues(5, 1200)));
  vtkNew<vtkSpectralCubeVolume> cube;
  cube->SetInputConnection(0, source->GetOutputPort());
  expectSameBytesInPieces(cube, 7);
}

TEST(SpectralCubeVolume, RefusesAVolume)
{
  vtkNew<vtkSpectralCubeVolume> cube;
  const auto slices = image();
  slices->SetDimensions(1, 2, 3);
  cube->SetInputData(0, slices);
  EXPECT_EQ(
    errorOf(cube), "the image has 3 slices; expected one, whose components are the wavelengths");
}
}
