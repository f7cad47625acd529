#include "vtkSampleChoice.h"

#include "ExpectedSamples.h"
#include "Support/vtk/Runs.h"
#include "Support/vtk/Tables.h"

#include "vtkNew.h"

#include "Kernels/Estimation/SampleChoice.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using namespace msi::testing;
using msi::test::ExpectedEstimation;

vtkSmartPointer<vtkTable> responsesOf(const SampleSet& samples)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  addSpectra(table, 'C', channelsOf(samples), samples.response);
  std::vector<std::string> names;
  for (Eigen::Index i = 0; i < samples.size(); ++i)
  {
    names.push_back("swatch " + std::to_string(i));
  }
  addTextColumn(table, "sample", names);
  return table;
}

TEST(SampleChoice, KeepsTheRowsOfTheChosenCandidates)
{
  const ExpectedEstimation expected(0);
  const auto candidates = expected.calibration();
  vtkNew<vtkSampleChoice> filter;
  filter->SetInputData(0, responsesOf(expected.tuning()));
  filter->SetInputData(1, responsesOf(candidates));
  filter->SetCount(3);
  ASSERT_EQ(errorOf(filter), "");
  auto* table = vtkTable::SafeDownCast(filter->GetOutputDataObject(0));
  const auto choice = chooseSamples(expected.tuning().response, candidates.response, 3);
  ASSERT_EQ(table->GetNumberOfRows(), 3);
  EXPECT_STREQ(table->GetColumnName(0), "rank");
  for (vtkIdType row = 0; row < 3; ++row)
  {
    const auto index = static_cast<std::size_t>(row);
    EXPECT_EQ(cell(table, row, "rank"), static_cast<double>(row + 1));
    EXPECT_EQ(textCell(table, row, "sample"), "swatch " + std::to_string(choice.samples[index]));
    EXPECT_EQ(cell(table, row, "explained"), choice.explained[index]);
  }
}

TEST(SampleChoice, SaysWhatIsMissing)
{
  const ExpectedEstimation expected(0);
  vtkNew<vtkSampleChoice> filter;
  filter->SetInputData(0, responsesOf(expected.tuning()));
  filter->SetInputData(1, newTable({ { "R400", { 0.1, 0.2 } }, { "R410", { 0.1, 0.2 } } }));
  EXPECT_EQ(errorOf(filter),
    "the candidates table has no columns of camera responses (C400, C420, .. or C1, C2, ..); it "
    "has "
    "2 other columns");
}

}
