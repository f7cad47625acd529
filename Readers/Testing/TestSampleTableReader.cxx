#include "vtkSampleTableReader.h"

#include "Support/formats/TestFiles.h"

#include "vtkNew.h"
#include "vtkTable.h"
#include "vtkVariant.h"

#include <chrono>

namespace
{

class WideTables : public msi::testing::TemporaryFolder
{
};

// VTK alone takes a minute and a half for them: it compares the name of each new column with all before it.
TEST_F(WideTables, TakeTimeInProportionToTheirColumns)
{
  constexpr int columns = 20000; // of each kind
  std::string text;
  for (int i = 0; i < columns; ++i)
  {
    text += "m" + std::to_string(i) + ",C" + std::to_string(i + 1) + ",";
  }
  text += "R400\n";
  for (int i = 0; i < columns; ++i)
  {
    text += std::to_string(i) + ",0.5,";
  }
  text += "0.25\n";
  vtkNew<vtkSampleTableReader> reader;
  reader->SetFileName(write("wide.csv", text).c_str());
  const auto begin = std::chrono::steady_clock::now();
  reader->Update();
  const std::chrono::duration<double> seconds = std::chrono::steady_clock::now() - begin;
  auto* table = reader->GetOutput();
  ASSERT_EQ(table->GetNumberOfColumns(), 2 * columns + 1);
  EXPECT_EQ(table->GetValueByName(0, "m19999").ToDouble(), 19999.0);
  EXPECT_EQ(table->GetValueByName(0, "C20000").ToDouble(), 0.5);
  EXPECT_EQ(table->GetValueByName(0, "R400").ToDouble(), 0.25);
  EXPECT_LT(seconds.count(), 10.0);
}

}
