#include "vtkSampleSplit.h"

#include "Support/vtk/Runs.h"
#include "Support/vtk/Tables.h"

#include "vtkNew.h"

#include "Kernels/Estimation/SampleDraw.h"

#include <gtest/gtest.h>

#include <numeric>

namespace
{
using namespace msi;
using namespace msi::testing;

// A column "R400" that counts from 0, and names.
vtkSmartPointer<vtkTable> countingTable(int rows)
{
  std::vector<double> numbers(static_cast<std::size_t>(rows));
  std::iota(numbers.begin(), numbers.end(), 0.0);
  std::vector<std::string> names;
  for (int i = 0; i < rows; ++i)
  {
    names.push_back("sample " + std::to_string(i));
  }
  auto table = newTable({ { "R400", numbers } });
  addTextColumn(table, "sample", names);
  return table;
}

std::vector<Eigen::Index> rowsOf(vtkSampleSplit* split, int port)
{
  auto* table = vtkTable::SafeDownCast(split->GetOutputDataObject(port));
  std::vector<Eigen::Index> rows;
  for (vtkIdType i = 0; i < table->GetNumberOfRows(); ++i)
  {
    rows.push_back(static_cast<Eigen::Index>(cell(table, i, "R400")));
    EXPECT_EQ(textCell(table, i, "sample"), "sample " + std::to_string(rows.back()));
  }
  return rows;
}

using Rows = std::vector<Eigen::Index>;

TEST(SampleSplit, TakesEveryOtherRow)
{
  vtkNew<vtkSampleSplit> split;
  split->SetInputData(countingTable(5));
  ASSERT_EQ(errorOf(split), "");
  EXPECT_EQ(rowsOf(split, 0), (Rows{ 0, 2, 4 }));
  EXPECT_EQ(rowsOf(split, 1), (Rows{ 1, 3 }));
}

TEST(SampleSplit, DrawsAsTheKernelDoes)
{
  vtkNew<vtkSampleSplit> split;
  split->SetInputData(countingTable(40));
  split->SetMode(vtkSampleSplit::RANDOM);
  split->SetCount(7);
  split->SetSeed(3);
  split->SetDraw(2);
  ASSERT_EQ(errorOf(split), "");
  const auto chosen = drawSamples(40, 7, 3, 2);
  EXPECT_EQ(rowsOf(split, 0), chosen);
  EXPECT_EQ(rowsOf(split, 1), remainingSamples(40, chosen));
}

TEST(SampleSplit, ChoosesAnewForAnotherDrawOrSeed)
{
  vtkNew<vtkSampleSplit> split;
  split->SetInputData(countingTable(40));
  split->SetMode(vtkSampleSplit::RANDOM);
  ASSERT_EQ(errorOf(split), "");
  const auto first = rowsOf(split, 0);
  EXPECT_EQ(first.size(), 16u);
  split->SetDraw(1);
  ASSERT_EQ(errorOf(split), "");
  EXPECT_NE(rowsOf(split, 0), first);
  split->SetDraw(0);
  split->SetSeed(2);
  ASSERT_EQ(errorOf(split), "");
  EXPECT_NE(rowsOf(split, 0), first);
  split->SetSeed(1);
  ASSERT_EQ(errorOf(split), "");
  EXPECT_EQ(rowsOf(split, 0), first);
}

TEST(SampleSplit, NamesTheNumbersThatDoNotFit)
{
  vtkNew<vtkSampleSplit> split;
  split->SetInputData(countingTable(16));
  split->SetMode(vtkSampleSplit::RANDOM);
  EXPECT_EQ(errorOf(split),
    "the table has 16 samples and 16 are to be chosen; expected at least one sample on each side");
  split->SetMode(vtkSampleSplit::EVERY_OTHER);
  split->SetInputData(countingTable(1));
  EXPECT_EQ(errorOf(split),
    "the table has 1 sample and 1 is to be chosen; expected at least one sample on each side");
  split->SetInputData(newTable({}));
  EXPECT_EQ(errorOf(split),
    "the table has 0 samples and 0 are to be chosen; expected at least one sample on each side");
}

TEST(SampleSplit, GivesAllColumnsAndTheNotes)
{
  const auto table = countingTable(3);
  vtkNew<vtkStringArray> notes;
  notes->SetName("Notes");
  notes->InsertNextValue("percent");
  table->GetFieldData()->AddArray(notes);
  vtkNew<vtkSampleSplit> split;
  split->SetInputData(table);
  ASSERT_EQ(errorOf(split), "");
  for (int port = 0; port < 2; ++port)
  {
    auto* half = vtkTable::SafeDownCast(split->GetOutputDataObject(port));
    EXPECT_EQ(columnNames(half), (std::vector<std::string>{ "R400", "sample" }));
    EXPECT_NE(half->GetFieldData()->GetAbstractArray("Notes"), nullptr);
  }
}

TEST(SampleSplit, PrintsItself)
{
  vtkNew<vtkSampleSplit> split;
  split->SetMode(vtkSampleSplit::RANDOM);
  split->SetCount(9);
  split->SetSeed(4);
  split->SetDraw(5);
  const auto text = printed(split);
  for (const char* line : { "Mode: 1\n", "Count: 9\n", "Seed: 4\n", "Draw: 5\n" })
  {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}
}
