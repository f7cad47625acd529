#include "vtkPatchSampler.h"

#include "Support/vtk/Images.h"
#include "Support/vtk/Runs.h"
#include "Support/vtk/Tables.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <cmath>
#include <limits>

namespace
{
using namespace msi;
using namespace msi::testing;

const WavelengthGrid PatchGrid({ 400.0, 500.0 });

Eigen::MatrixXd twoRows(const std::vector<double>& first, const std::vector<double>& second)
{
  Eigen::MatrixXd values(2, static_cast<Eigen::Index>(first.size()));
  values.row(0) = Eigen::Map<const Eigen::RowVectorXd>(first.data(), values.cols());
  values.row(1) = Eigen::Map<const Eigen::RowVectorXd>(second.data(), values.cols());
  return values;
}

// 4 x 2 pixels; patch 1 has three of them, patch 2 two, patch 4 one.
const std::vector<int> Labels = { 1, 1, 0, 2, //
  1, 4, 0, 2 };
const Eigen::MatrixXd Values =
  twoRows({ 1.0, 2.0, 9.0, 4.0, 6.0, 5.0, 9.0, 8.0 }, { 0.5, 0.5, 9.0, 1.0, 0.5, 7.0, 9.0, 2.0 });

TEST(PatchSampler, GivesMeanDeviationCountAndPlace)
{
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetInputData(0, newImage(4, 2, ResponsesArray, Values, PatchGrid));
  sampler->SetInputData(1, newLabels(4, 2, Labels));
  ASSERT_EQ(errorOf(sampler), "");
  auto* table = sampler->GetOutput();
  EXPECT_EQ(columnNames(table),
    (std::vector<std::string>{ "label", "x", "y", "count", "left_out", "C400", "C500",
      "deviation C400", "deviation C500" }));
  ASSERT_EQ(table->GetNumberOfRows(), 3);
  EXPECT_EQ(cell(table, 0, "label"), 1.0);
  EXPECT_EQ(cell(table, 1, "label"), 2.0);
  EXPECT_EQ(cell(table, 2, "label"), 4.0);
  EXPECT_EQ(cell(table, 0, "count"), 3.0);
  EXPECT_EQ(cell(table, 0, "left_out"), 0.0);
  EXPECT_EQ(cell(table, 0, "C400"), 3.0);
  EXPECT_EQ(cell(table, 0, "C500"), 0.5);
  // The deviation of 1, 2, 6 about their mean 3, over 3 - 1.
  EXPECT_DOUBLE_EQ(cell(table, 0, "deviation C400"), std::sqrt(7.0));
  EXPECT_EQ(cell(table, 0, "deviation C500"), 0.0);
  EXPECT_DOUBLE_EQ(cell(table, 0, "x"), 1.0 / 3.0);
  EXPECT_DOUBLE_EQ(cell(table, 0, "y"), 1.0 / 3.0);
  EXPECT_EQ(cell(table, 1, "C400"), 6.0);
  EXPECT_EQ(cell(table, 1, "x"), 3.0);
  EXPECT_EQ(cell(table, 1, "y"), 0.5);
  EXPECT_EQ(cell(table, 2, "C500"), 7.0);
}

TEST(PatchSampler, LeavesOutPixelsThatAreNotFiniteAndCountsThem)
{
  Eigen::MatrixXd values = Values;
  values(0, 4) = NaN;
  values(1, 7) = std::numeric_limits<double>::infinity();
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetInputData(0, newImage(4, 2, ResponsesArray, values, PatchGrid));
  sampler->SetInputData(1, newLabels(4, 2, Labels));
  ASSERT_EQ(errorOf(sampler), "");
  auto* table = sampler->GetOutput();
  EXPECT_EQ(cell(table, 0, "count"), 2.0);
  EXPECT_EQ(cell(table, 0, "left_out"), 1.0);
  EXPECT_EQ(cell(table, 0, "C400"), 1.5);
  EXPECT_EQ(cell(table, 1, "count"), 1.0);
  EXPECT_EQ(cell(table, 1, "left_out"), 1.0);
  EXPECT_EQ(cell(table, 1, "C400"), 4.0);
  EXPECT_EQ(cell(table, 2, "C400"), 5.0) << "a NaN left its patch";
}

TEST(PatchSampler, UsesTheFrameOfTheImage)
{
  const auto image = newImage(4, 2, ResponsesArray, Values, PatchGrid);
  image->SetOrigin(100.0, -7.0, 0.0);
  image->SetSpacing(2.0, 0.5, 1.0);
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetInputData(0, image);
  sampler->SetInputData(1, newLabels(4, 2, Labels));
  ASSERT_EQ(errorOf(sampler), "");
  EXPECT_EQ(cell(sampler->GetOutput(), 1, "x"), 106.0);
  EXPECT_EQ(cell(sampler->GetOutput(), 1, "y"), -6.75);
}

TEST(PatchSampler, JoinsTheRowsOfATable)
{
  const auto patches = newTable({ { "label", { 4.0, 1.0 } }, { "R400", { 0.1, 0.2 } } });
  addTextColumn(patches, "sample", { "blue", "red" });
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetInputData(0, newImage(4, 2, ResponsesArray, Values, PatchGrid));
  sampler->SetInputData(1, newLabels(4, 2, Labels));
  sampler->SetInputData(2, patches);
  ASSERT_EQ(errorOf(sampler), "");
  auto* table = sampler->GetOutput();
  ASSERT_EQ(table->GetNumberOfRows(), 2);
  EXPECT_EQ(textCell(table, 0, "sample"), "blue");
  EXPECT_EQ(cell(table, 0, "R400"), 0.1);
  EXPECT_EQ(cell(table, 0, "C400"), 5.0);
  EXPECT_EQ(textCell(table, 1, "sample"), "red");
  EXPECT_EQ(cell(table, 1, "C400"), 3.0);
  EXPECT_EQ(patches->GetNumberOfColumns(), 3) << "the input was changed";
}

TEST(PatchSampler, CallsReflectanceReflectanceOrEstimate)
{
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetInputData(0, newImage<vtkDoubleArray>(4, 2, ReflectanceArray, Values, PatchGrid));
  sampler->SetInputData(1, newLabels(4, 2, Labels));
  ASSERT_EQ(errorOf(sampler), "");
  EXPECT_EQ(cell(sampler->GetOutput(), 0, "R400"), 3.0);
  EXPECT_EQ(sampler->GetOutput()->GetColumnByName("C400"), nullptr);

  sampler->SetInputData(2, newTable({ { "label", { 1.0 } }, { "R400", { 0.2 } } }));
  ASSERT_EQ(errorOf(sampler), "");
  EXPECT_EQ(cell(sampler->GetOutput(), 0, "R400"), 0.2) << "the measured value was overwritten";
  EXPECT_EQ(cell(sampler->GetOutput(), 0, "E400"), 3.0);
}

TEST(PatchSampler, SamplesTheChosenArray)
{
  const auto image = newImage(4, 2, ResponsesArray, Values, PatchGrid);
  vtkNew<vtkFloatArray> other;
  other->SetName("other");
  other->SetNumberOfTuples(8);
  other->FillValue(42.0f);
  image->GetPointData()->AddArray(other);
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetInputData(0, image);
  sampler->SetInputData(1, newLabels(4, 2, Labels));
  sampler->SetSpectralArray("other");
  ASSERT_EQ(errorOf(sampler), "");
  EXPECT_EQ(cell(sampler->GetOutput(), 0, "C1"), 42.0);
}

TEST(PatchSampler, TakesAnArrayWithoutName)
{
  const auto image = newImage(4, 2, ResponsesArray, Values, PatchGrid);
  image->GetPointData()->GetScalars()->SetName(nullptr);
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetInputData(0, image);
  sampler->SetInputData(1, newLabels(4, 2, Labels));
  ASSERT_EQ(errorOf(sampler), "");
  EXPECT_EQ(cell(sampler->GetOutput(), 0, "C400"), 3.0);
}

// A chart of 3 x 2 cells of 10 x 10 pixels; the value is the number of the cell, 9 on the borders that a
// fraction of 0.6 leaves out.
vtkSmartPointer<vtkImageData> chart()
{
  Eigen::MatrixXd values(1, 30 * 20);
  for (int y = 0; y < 20; ++y)
  {
    for (int x = 0; x < 30; ++x)
    {
      const bool inside = x % 10 >= 2 && x % 10 < 8 && y % 10 >= 2 && y % 10 < 8;
      // Patch 1 is at the top left, where y is largest.
      values(0, y * 30 + x) = inside ? 1 + x / 10 + 3 * (1 - y / 10) : 9.0;
    }
  }
  return newImage(30, 20, ResponsesArray, values);
}

TEST(PatchSampler, SamplesAGridOverTheWholeImage)
{
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetInputData(0, chart());
  sampler->SetGridColumns(3);
  sampler->SetGridRows(2);
  sampler->SetPatchFraction(0.6);
  MessageLog log(sampler);
  sampler->Update();
  ASSERT_EQ(log.firstError(), "");
  ASSERT_EQ(log.warnings().size(), 1U);
  EXPECT_NE(log.warnings().front().find("a grid of 3 x 2 over the whole image"), std::string::npos)
    << log.warnings().front();
  auto* table = sampler->GetOutput();
  ASSERT_EQ(table->GetNumberOfRows(), 6);
  for (int row = 0; row < 6; ++row)
  {
    EXPECT_EQ(cell(table, row, "C1"), row + 1.0);
    EXPECT_EQ(cell(table, row, "deviation C1"), 0.0);
    EXPECT_EQ(cell(table, row, "count"), 36.0);
  }
  EXPECT_EQ(cell(table, 0, "x"), 4.5);
  EXPECT_EQ(cell(table, 0, "y"), 14.5);
}

TEST(PatchSampler, SamplesAGridBetweenFourCorners)
{
  // The chart turned by half a turn: the first patch is at the bottom right.
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetInputData(0, chart());
  sampler->SetGridColumns(3);
  sampler->SetGridRows(2);
  sampler->SetCorner1(29.5, -0.5);
  sampler->SetCorner2(-0.5, -0.5);
  sampler->SetCorner3(-0.5, 19.5);
  sampler->SetCorner4(29.5, 19.5);
  const MessageLog log(sampler);
  ASSERT_EQ(errorOf(sampler), "");
  EXPECT_TRUE(log.warnings().empty());
  for (int row = 0; row < 6; ++row)
  {
    EXPECT_EQ(cell(sampler->GetOutput(), row, "C1"), 6.0 - row);
  }
}

TEST(PatchSampler, GivesTheSameBytesInThreads)
{
  constexpr int Size = 400;
  std::vector<int> labels(Size * Size);
  for (std::size_t i = 0; i < labels.size(); ++i)
  {
    labels[i] = static_cast<int>(i / 1001 % 5);
  }
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetInputData(0, newImage(Size, Size, ResponsesArray, patternValues(3, Size * Size)));
  sampler->SetInputData(1, newLabels(Size, Size, labels));
  expectSameBytesInThreads(sampler);
}

TEST(PatchSampler, GivesTheWholeTableInTheFirstPieceAndNoRowsInOthers)
{
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetInputData(0, newImage(4, 2, ResponsesArray, Values, PatchGrid));
  sampler->SetInputData(1, newLabels(4, 2, Labels));
  sampler->UpdatePiece(0, 2, 0);
  EXPECT_EQ(sampler->GetOutput()->GetNumberOfRows(), 3);
  sampler->UpdatePiece(1, 2, 0);
  EXPECT_EQ(sampler->GetOutput()->GetNumberOfRows(), 0);
}

TEST(PatchSampler, PrintsItself)
{
  vtkNew<vtkPatchSampler> sampler;
  sampler->SetSpectralArray("raw");
  sampler->SetGridColumns(14);
  sampler->SetGridRows(10);
  sampler->SetPatchFraction(0.25);
  sampler->SetCorner3(1.5, 2.5);
  const auto text = printed(sampler);
  for (const char* line : { "SpectralArray: raw\n", "GridColumns: 14\n", "GridRows: 10\n",
         "PatchFraction: 0.25\n", "Corner3: 1.5, 2.5\n" })
  {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}
}
