#include "vtkChannelSelection.h"

#include "Support/vtk/Images.h"
#include "Support/vtk/PieceSource.h"
#include "Support/vtk/Runs.h"
#include "Support/vtk/Tables.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using namespace msi::testing;

const WavelengthGrid ChannelGrid({ 400.0, 450.0, 500.0, 650.0 });

TEST(ChannelSelection, KeepsTheChosenComponentsInOrderOfWavelength)
{
  const Eigen::MatrixXd values = patternValues(4, 6);
  const auto image = newImage(3, 2, ResponsesArray, values, ChannelGrid);
  vtkNew<vtkChannelSelection> selection;
  selection->SetInputData(image);
  for (const char* channel : { "4", "400 nm", "650 nm" })
  {
    selection->AddChannel(channel);
  }
  ASSERT_EQ(errorOf(selection), "");
  auto* output = vtkImageData::SafeDownCast(selection->GetOutputDataObject(0));
  const auto cut = valuesOf(output, ResponsesArray);
  ASSERT_EQ(cut.rows(), 2);
  EXPECT_EQ(cut.row(0), values.row(0).cast<float>().cast<double>());
  EXPECT_EQ(cut.row(1), values.row(3).cast<float>().cast<double>());
  auto* array = requireSpectralArray(output, "the output");
  EXPECT_EQ(axisOf(output, array).wavelengths->values(), (std::vector<double>{ 400.0, 650.0 }));
  EXPECT_STREQ(array->GetComponentName(1), "650 nm");

  auto* input = requireSpectralArray(image, "the input");
  EXPECT_EQ(axisOf(image, input).size(), 4u) << "the input was changed";
  EXPECT_EQ(axisOf(image, input).wavelengths, ChannelGrid);
}

TEST(ChannelSelection, KeepsAllWhereNoneIsChosen)
{
  const auto image = newImage(3, 2, ResponsesArray, patternValues(4, 6), ChannelGrid);
  vtkNew<vtkChannelSelection> selection;
  selection->SetInputData(image);
  selection->AddChannel("2");
  selection->ClearChannels();
  selection->SetPreview(false);
  ASSERT_EQ(errorOf(selection), "");
  EXPECT_EQ(bytesOf(selection->GetOutputDataObject(0)), bytesOf(image));
}

TEST(ChannelSelection, CutsNumberedChannelsOfAnImage)
{
  const auto image = newImage(2, 1, ResponsesArray, patternValues(3, 2));
  vtkNew<vtkChannelSelection> selection;
  selection->SetInputData(image);
  selection->AddChannel("2");
  selection->AddChannel("C3");
  ASSERT_EQ(errorOf(selection), "");
  auto* output = vtkImageData::SafeDownCast(selection->GetOutputDataObject(0));
  auto* array = requireSpectralArray(output, "the output");
  EXPECT_EQ(axisOf(output, array).names, (std::vector<std::string>{ "C2", "C3" }));
}

TEST(ChannelSelection, CutsTheResponsesOfATableAndNothingElse)
{
  const auto table = newTable({ { "C500", { 3.0 } }, { "R400", { 9.0 } }, { "C400", { 1.0 } },
    { "x", { 7.0 } }, { "C450", { 2.0 } } });
  vtkNew<vtkChannelSelection> selection;
  selection->SetInputData(table);
  selection->AddChannel("2");
  ASSERT_EQ(errorOf(selection), "");
  auto* output = vtkTable::SafeDownCast(selection->GetOutputDataObject(0));
  EXPECT_EQ(columnNames(output), (std::vector<std::string>{ "R400", "x", "C450" }));
  EXPECT_EQ(table->GetNumberOfColumns(), 5) << "the input was changed";
}

TEST(ChannelSelection, CutsColumnsWhoseNamesAreWrittenOtherwise)
{
  const auto table = newTable({ { "C400.0", { 1.0 } }, { "C450.50", { 2.0 } } });
  vtkNew<vtkChannelSelection> selection;
  selection->SetInputData(table);
  selection->AddChannel("2");
  ASSERT_EQ(errorOf(selection), "");
  auto* output = vtkTable::SafeDownCast(selection->GetOutputDataObject(0));
  EXPECT_EQ(columnNames(output), (std::vector<std::string>{ "C450.50" }));
}

TEST(ChannelSelection, NamesAChannelThatIsNotThere)
{
  for (const std::string channel : { "0", "5", "-1", "555 nm", "", "1.5" })
  {
    vtkNew<vtkChannelSelection> selection;
    selection->SetInputData(newImage(3, 2, ResponsesArray, patternValues(4, 6), ChannelGrid));
    selection->AddChannel(channel.c_str());
    EXPECT_EQ(errorOf(selection),
      "channel " + channel + " was chosen; the input has 4 channels (400, 450, 500, 650 nm)");
  }
}

TEST(ChannelSelection, SaysWhatIsMissing)
{
  vtkNew<vtkChannelSelection> selection;
  selection->SetInputData(newTable({ { "R400", { 1.0 } } }));
  EXPECT_EQ(errorOf(selection),
    "the sample table has no columns of camera responses "
    "(C400, C420, .. or C1, C2, ..); it has 1 other columns");
  selection->SetInputData(newTable({}));
  EXPECT_EQ(errorOf(selection), "the sample table is empty; expected a table of samples");
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(2, 2, 1);
  selection->SetInputData(bare);
  EXPECT_EQ(errorOf(selection), "the image has no point array; expected a spectral image");
}

TEST(ChannelSelection, GivesTheSameBytesInPieces)
{
  vtkNew<PieceSource> source;
  source->SetImage(newImage(7, 5, ResponsesArray, patternValues(4, 35), ChannelGrid));
  vtkNew<vtkChannelSelection> selection;
  selection->SetInputConnection(source->GetOutputPort());
  selection->AddChannel("3");
  expectSameBytesInPieces(selection, 3);
}

TEST(ChannelSelection, PrintsItsChannels)
{
  vtkNew<vtkChannelSelection> selection;
  selection->AddChannel("3");
  selection->AddChannel("12");
  EXPECT_NE(printed(selection).find("Channels: 3 12\n"), std::string::npos);
}
}
