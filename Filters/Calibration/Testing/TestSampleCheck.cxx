#include "vtkSampleCheck.h"

#include "ExpectedSamples.h"
#include "Support/vtk/Runs.h"
#include "Support/vtk/Tables.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using namespace msi::testing;
using msi::test::ExpectedEstimation;

TEST(SampleCheck, AsksOfSamplesAloneAndBesideAChart)
{
  const ExpectedEstimation expected(0);
  SampleSet samples = expected.calibration();
  vtkNew<vtkSampleCheck> filter;
  filter->SetInputData(0, tableOf(samples));
  filter->SetSamplesName("the swatches");
  ASSERT_EQ(errorOf(filter), "");
  auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_NE(table, nullptr);
  EXPECT_STREQ(table->GetColumnName(0), "question");
  EXPECT_EQ(table->GetNumberOfRows(), 0);

  // A sample of the chart stands in the table, too.
  filter->SetInputData(1, tableOf(samples));
  MessageLog log(filter);
  filter->Update();
  table = vtkTable::SafeDownCast(filter->GetOutputDataObject(0));
  ASSERT_GE(table->GetNumberOfRows(), 1);
  EXPECT_EQ(textCell(table, 0, "question").find("the swatches: Twice? "), 0u);
  EXPECT_NE(log.firstWarning().find("the swatches: Twice? "), std::string::npos);
}

TEST(SampleCheck, PassesOverSamplesWithoutValues)
{
  const ExpectedEstimation expected(0);
  SampleSet samples = expected.calibration();
  samples.response(1, 2) = std::nan("");
  samples.reflectance(0, 3) = std::nan("");
  vtkNew<vtkSampleCheck> filter;
  filter->SetInputData(0, tableOf(samples));
  ASSERT_EQ(errorOf(filter), "");
  EXPECT_EQ(vtkTable::SafeDownCast(filter->GetOutputDataObject(0))->GetNumberOfRows(), 0);
}

TEST(SampleCheck, SaysWhatIsMissing)
{
  vtkNew<vtkSampleCheck> filter;
  filter->SetInputData(0, newTable({ { "R400", { 0.1, 0.2 } }, { "R410", { 0.1, 0.2 } } }));
  EXPECT_NE(
    errorOf(filter).find("the sample table has no columns of camera responses"), std::string::npos)
    << errorOf(filter);
}

} // namespace
