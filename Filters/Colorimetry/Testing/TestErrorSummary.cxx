#include "vtkCIEDE2000Evaluator.h"
#include "vtkErrorSummary.h"

#include "GraySpectra.h"
#include "Support/vtk/PieceSource.h"
#include "Support/vtk/Runs.h"

#include "vtkDataSetAttributes.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
using namespace msi;
using namespace msi::testing;

TEST(ErrorSummary, TellsTheFiguresOfAMap)
{
  // 0, 0.125, 0.25, 0.25, 0.5 and one that is not known; the 95th percentile lies at 0.8 between the last two.
  Eigen::RowVectorXd values(6);
  values << 0.25, 0.0, NaN, 0.5, 0.125, 0.25;
  vtkNew<vtkErrorSummary> summary;
  summary->SetInputData(newImage(2, 3, "rms", values));
  ASSERT_EQ(errorOf(summary), "");
  auto* table = summary->GetOutput();
  ASSERT_EQ(table->GetNumberOfRows(), 1);
  EXPECT_EQ(textCell(table, 0, "metric"), "rms");
  EXPECT_DOUBLE_EQ(cell(table, 0, "mean"), 0.225);
  EXPECT_DOUBLE_EQ(cell(table, 0, "median"), 0.25);
  EXPECT_DOUBLE_EQ(cell(table, 0, "p95"), 0.45);
  EXPECT_DOUBLE_EQ(cell(table, 0, "max"), 0.5);
  EXPECT_EQ(cell(table, 0, "count"), 5.0);
  EXPECT_EQ(cell(table, 0, "left_out"), 1.0);
}

TEST(ErrorSummary, EqualsTheEvaluatorInSmallBlocks)
{
  constexpr int Width = 256;
  constexpr int Height = 300;
  const auto pattern = patternValues(2, Width * Height);
  const auto grays = [&](Eigen::Index row)
  {
    auto image = newImage(
      Width, Height, ReflectanceArray, pattern.row(row).replicate(GrayGrid.size(), 1), GrayGrid);
    return image;
  };
  vtkNew<PieceSource> estimate;
  vtkNew<PieceSource> reference;
  estimate->SetImage(grays(0));
  reference->SetImage(grays(1));
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputConnection(0, estimate->GetOutputPort());
  evaluator->SetInputConnection(1, reference->GetOutputPort());
  vtkNew<vtkErrorSummary> summary;
  summary->SetInputConnection(evaluator->GetOutputPort(0));
  summary->SetBlockSize(1);
  ASSERT_EQ(errorOf(summary), "");
  const auto inBlocks = bytesOf(summary->GetOutput()->GetRowData());
  EXPECT_LT(estimate->LargestRequest(), Width * Height / 4) << "the image was not taken in blocks";
  evaluator->UpdateWholeExtent();
  EXPECT_EQ(cell(summary->GetOutput(), 1, "count"), Width * Height);
  auto* whole = vtkTable::SafeDownCast(evaluator->GetOutputDataObject(1));
  EXPECT_EQ(inBlocks, bytesOf(whole->GetRowData()));
}

TEST(ErrorSummary, TakesTheComponentsOfAMapThatWasRead)
{
  Eigen::MatrixXd values(2, 2);
  values << 0.1, 0.3, 1.0, 2.0;
  const auto image = newImage(2, 1, ResponsesArray, values);
  image->GetPointData()->GetScalars()->SetComponentName(0, "rms");
  image->GetPointData()->GetScalars()->SetComponentName(1, "dE00 D65");
  vtkNew<vtkErrorSummary> summary;
  summary->SetInputData(image);
  ASSERT_EQ(errorOf(summary), "");
  EXPECT_EQ(textCell(summary->GetOutput(), 1, "illuminant"), "D65");
  EXPECT_DOUBLE_EQ(cell(summary->GetOutput(), 1, "mean"), 1.5);
}

TEST(ErrorSummary, RefusesAnImageWithoutMaps)
{
  vtkNew<vtkErrorSummary> summary;
  summary->SetInputData(grayImage({ 0.5 }));
  EXPECT_EQ(errorOf(summary),
    "the image has no error map; expected arrays or components named 'rms' or 'dE00 D65', as "
    "CIEDE2000 "
    "Evaluator makes them");
}
}
