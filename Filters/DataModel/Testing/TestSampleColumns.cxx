#include "SampleColumns.h"

#include "Support/vtk/ErrorText.h"
#include "Support/vtk/Tables.h"

#include "vtkFieldData.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
using namespace msi;
using namespace msi::testing;

TEST(SampleColumns, OrdersSpectraByWavelength)
{
  const auto table = newTable({ { "R500", { 2.0, 5.0 } }, { "C1", { 9.0, 9.0 } },
    { "R402.5", { 1.0, 4.0 } }, { "Red", { 0.0, 0.0 } }, { "R700", { 3.0, 6.0 } } });
  const auto spectra = findSpectra(table, SampleQuantity::Reflectance);
  ASSERT_TRUE(spectra);
  EXPECT_EQ(spectra->axis.wavelengths->values(), (std::vector<double>{ 402.5, 500.0, 700.0 }));
  EXPECT_EQ(spectra->columns, (std::vector<std::string>{ "R402.5", "R500", "R700" }));
  EXPECT_EQ(spectra->values.col(0), Eigen::Vector3d(1.0, 2.0, 3.0));
  EXPECT_EQ(spectra->values.col(1), Eigen::Vector3d(4.0, 5.0, 6.0));
}

TEST(SampleColumns, OrdersNumberedChannelsByNumber)
{
  const auto table = newTable({ { "C10", { 10.0 } }, { "C2", { 2.0 } }, { "C1", { 1.0 } } });
  const auto spectra = findSpectra(table, SampleQuantity::Response);
  ASSERT_TRUE(spectra);
  EXPECT_FALSE(spectra->axis.wavelengths);
  EXPECT_EQ(spectra->axis.names, (std::vector<std::string>{ "C1", "C2", "C10" }));
  EXPECT_EQ(spectra->values.col(0), Eigen::Vector3d(1.0, 2.0, 10.0));
}

TEST(SampleColumns, FindsNoneWhereNoNameFits)
{
  const auto table = newTable(
    { { "R", { 1.0 } }, { "R400nm", { 1.0 } }, { "r400", { 1.0 } }, { "xR400", { 1.0 } } });
  EXPECT_FALSE(findSpectra(table, SampleQuantity::Reflectance));
}

TEST(SampleColumns, NamesAColumnThatIsNotNumeric)
{
  const auto table = newTable({ { "R400", { 1.0 } } });
  addTextColumn(table, "R410", { "n/a" });
  EXPECT_EQ(argumentError([&] { findSpectra(table, SampleQuantity::Reflectance); }),
    "column 'R410' is not a column of numbers, one per sample");
}

TEST(SampleColumns, NamesAColumnOfSeveralComponents)
{
  const auto table = newTable({ { "R400", { 1.0 } } });
  vtkNew<vtkDoubleArray> vectors;
  vectors->SetName("R410");
  vectors->SetNumberOfComponents(3);
  vectors->SetNumberOfTuples(1);
  table->AddColumn(vectors);
  EXPECT_EQ(argumentError([&] { findSpectra(table, SampleQuantity::Reflectance); }),
    "column 'R410' is not a column of numbers, one per sample");
}

TEST(SampleColumns, NamesTwoColumnsOfOneWavelength)
{
  const auto table = newTable({ { "C400", { 1.0 } }, { "C400.0", { 1.0 } } });
  const auto error = argumentError([&] { findSpectra(table, SampleQuantity::Response); });
  EXPECT_NE(error.find("'C400'"), std::string::npos);
  EXPECT_NE(error.find("'C400.0'"), std::string::npos);
  EXPECT_NE(error.find("name the same wavelength"), std::string::npos);
}

TEST(SampleColumns, RefusesReflectanceThatIsNumbered)
{
  EXPECT_EQ(argumentError(
              [&] {
                findSpectra(newTable({ { "R1", { 1.0 } } }), SampleQuantity::Reflectance);
              }),
    "column 'R1' is no wavelength; expected measured reflectance (R400, R410, ..) from 100 nm on");
}

TEST(SampleColumns, NamesTheColumnsThatAreMissing)
{
  const auto table = newTable({ { "x", { 1.0 } } });
  const auto without = [&](SampleQuantity quantity)
  { return argumentError([&] { requireSpectra(table, quantity, "the table"); }); };
  EXPECT_EQ(without(SampleQuantity::Reflectance),
    "the table has no columns of measured reflectance (R400, R410, ..); it has 1 other columns");
  EXPECT_EQ(without(SampleQuantity::Response),
    "the table has no columns of camera responses (C400, C420, .. or C1, C2, ..); it has 1 other "
    "columns");
  EXPECT_EQ(without(SampleQuantity::Estimate),
    "the table has no columns of estimated reflectance (E400, E410, ..); it has 1 other columns");
  EXPECT_EQ(without(SampleQuantity::Uncertainty),
    "the table has no columns of uncertainty (U400, U410, ..); it has 1 other columns");
}

TEST(SampleColumns, NamesATableThatIsEmptyOrNotThere)
{
  const auto require = [](vtkTable* table)
  { return argumentError([&] { requireSpectra(table, SampleQuantity::Response, "the table"); }); };
  EXPECT_EQ(require(newTable({})), "the table is empty; expected a table of samples");
  EXPECT_EQ(
    require(newTable({ { "C400", {} } })), "the table is empty; expected a table of samples");
  EXPECT_EQ(require(nullptr), "the table is empty; expected a table of samples");
}

TEST(SampleColumns, ReplacesColumnsOfTheSameName)
{
  const auto table = newTable({ { "E400", { 9.0 } }, { "x", { 1.0 } } });
  setSpectra(table, SampleQuantity::Estimate, axisOf(WavelengthGrid({ 400.0, 410.0 })),
    Eigen::Vector2d(0.25, 0.5));
  EXPECT_EQ(columnNames(table), (std::vector<std::string>{ "x", "E400", "E410" }));
  EXPECT_EQ(cell(table, 0, "E400"), 0.25);
  EXPECT_EQ(cell(table, 0, "E410"), 0.5);
}

TEST(SampleColumns, NamesTheSampleThatIsNotFinite)
{
  const auto table = newTable({ { "R400", { 0.1, 0.2, 0.3 } }, { "R410", { 0.1, 0.2, 0.3 } },
    { "C400", { 0.5, 0.5, std::numeric_limits<double>::quiet_NaN() } } });
  const auto error = argumentError([&] { requireMeasuredSamples(table, "the chart"); });
  EXPECT_EQ(error.rfind("the chart", 0), 0u) << error;
  EXPECT_NE(error.find("sample 3"), std::string::npos) << error;
  EXPECT_NE(error.find("channel 1"), std::string::npos) << error;
}

TEST(SampleColumns, TakesReflectanceAndResponseTogether)
{
  const auto table =
    newTable({ { "C450", { 0.5, 0.75 } }, { "R400", { 0.1, 0.2 } }, { "R410", { 0.3, 0.4 } } });
  const auto measured = requireMeasuredSamples(table, "the chart");
  EXPECT_EQ(measured.bands.size(), 2u);
  EXPECT_EQ(measured.channels.names, (std::vector<std::string>{ "450" }));
  EXPECT_EQ(measured.samples.reflectance.col(1), Eigen::Vector2d(0.2, 0.4));
  EXPECT_EQ(measured.samples.response(0, 1), 0.75);
}

TEST(SampleColumns, CopiesChosenRowsOfAllColumnsInOrder)
{
  const auto table = newTable({ { "R400", { 0.0, 1.0, 2.0 } } });
  addTextColumn(table, "sample", { "a", "b", "c" });
  vtkNew<vtkTable> chosen;
  copyRows(table, { 2, 0 }, chosen);
  ASSERT_EQ(chosen->GetNumberOfRows(), 2);
  EXPECT_EQ(textCell(chosen, 0, "sample"), "c");
  EXPECT_EQ(cell(chosen, 1, "R400"), 0.0);
  vtkNew<vtkTable> none;
  copyRows(table, {}, none);
  EXPECT_EQ(none->GetNumberOfRows(), 0);
  EXPECT_EQ(none->GetNumberOfColumns(), 2);
}
}
