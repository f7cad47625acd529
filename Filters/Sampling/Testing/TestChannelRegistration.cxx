#include "vtkChannelDisplacement.h"
#include "vtkChannelRegistration.h"

#include "Support/vtk/Images.h"
#include "Support/vtk/PieceSource.h"
#include "Support/vtk/Runs.h"
#include "Support/vtk/Tables.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkTable.h"

#include "Kernels/Camera/Imaging/DisplacedChart.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <random>

namespace
{
using namespace msi;
using namespace msi::testing;
using msi::test::DisplacedChart;

const WavelengthGrid DisplacedGrid({ 450.0, 550.0, 650.0 });
const std::vector<ChannelDisplacement> Displaced{ { 1.4, -0.6, 1e-3, 0.1 }, {},
  { -2.3, 0.8, -5e-4, -0.15 } };

vtkSmartPointer<vtkImageData> imageOf(const DisplacedChart& chart)
{
  const PixelBuffer pixels = chart.pixels(wholeImage(chart.extent));
  const Eigen::Map<const Eigen::MatrixXf> values(
    pixels.values.data(), pixels.channels, static_cast<Eigen::Index>(pixels.window.pixels()));
  return newImage(
    chart.extent.width, chart.extent.height, ResponsesArray, values.cast<double>(), DisplacedGrid);
}

const vtkSmartPointer<vtkImageData>& displacedImage()
{
  static const auto image = imageOf({ { 230, 170 }, Displaced });
  return image;
}

vtkTable* found(vtkChannelDisplacement* displacement)
{
  return vtkTable::SafeDownCast(displacement->GetOutputDataObject(0));
}

vtkSmartPointer<vtkTable> tableOf(const std::vector<double>& x)
{
  return newTable({ { "channel", { 450.0, 550.0, 650.0 } }, { "x", x }, { "y", { 0.0, 0.0, 0.0 } },
    { "magnification", { 0.0, 0.0, 0.0 } }, { "rotation", { 0.0, 0.0, 0.0 } } });
}

TEST(ChannelDisplacementFilter, FindsWhatTheSceneHas)
{
  vtkNew<vtkChannelDisplacement> displacement;
  displacement->SetInputData(displacedImage());
  displacement->SetReference(2);
  ASSERT_EQ(errorOf(displacement), "");
  auto* table = found(displacement);
  ASSERT_EQ(table->GetNumberOfRows(), 3);
  EXPECT_EQ(textCell(table, 2, "channel"), "650");
  for (std::size_t k = 0; k < 3; ++k)
  {
    const auto row = static_cast<vtkIdType>(k);
    EXPECT_NEAR(cell(table, row, "x"), Displaced[k].right, 0.02);
    EXPECT_NEAR(cell(table, row, "y"), Displaced[k].down, 0.02);
    EXPECT_NEAR(cell(table, row, "magnification"), Displaced[k].magnification, 2.5e-4);
    EXPECT_NEAR(cell(table, row, "rotation"), Displaced[k].rotation, 0.01);
    EXPECT_LT(cell(table, row, "x error"), 0.02);
  }
  EXPECT_EQ(cell(table, 1, "x"), 0.0);
  EXPECT_EQ(cell(table, 1, "agreement"), 1.0);
}

TEST(ChannelDisplacementFilter, SpeaksInTheUnitOfTheImage)
{
  vtkNew<vtkImageData> image;
  image->ShallowCopy(displacedImage());
  image->SetSpacing(0.5, 0.25, 1.0);
  vtkNew<vtkChannelDisplacement> displacement;
  displacement->SetInputData(image);
  displacement->SetReference(2);
  ASSERT_EQ(errorOf(displacement), "");
  EXPECT_NEAR(cell(found(displacement), 0, "x"), 0.5 * 1.4, 0.01);
  EXPECT_NEAR(cell(found(displacement), 0, "y"), 0.25 * -0.6, 0.01);

  vtkNew<vtkChannelRegistration> registration;
  registration->SetInputData(0, image);
  registration->SetInputData(1, found(displacement));
  ASSERT_EQ(errorOf(registration), "");
  vtkNew<vtkChannelDisplacement> again;
  again->SetInputConnection(registration->GetOutputPort());
  again->SetReference(2);
  ASSERT_EQ(errorOf(again), "");
  for (vtkIdType row = 0; row < 3; ++row)
  {
    EXPECT_NEAR(cell(found(again), row, "x"), 0.0, 0.01);
    EXPECT_NEAR(cell(found(again), row, "y"), 0.0, 0.01);
  }
}

TEST(ChannelRegistrationFilter, GivesTheSceneBackAndNaNWhereAChannelDoesNotShowIt)
{
  const auto straight = imageOf({ { 230, 170 }, { {}, {}, {} } });
  vtkNew<vtkChannelDisplacement> displacement;
  displacement->SetInputData(displacedImage());
  vtkNew<vtkChannelRegistration> registration;
  registration->SetInputData(0, displacedImage());
  registration->SetInputConnection(1, displacement->GetOutputPort());
  // Which channel is the reference decides what is moved.
  displacement->SetReference(2);
  ASSERT_EQ(errorOf(registration), "");
  auto* output = vtkImageData::SafeDownCast(registration->GetOutputDataObject(0));
  auto* array = requireSpectralArray(output, "the output");
  EXPECT_EQ(axisOf(output, array).wavelengths, DisplacedGrid);
  const auto expected = valuesOf(straight, ResponsesArray);
  const auto registered = valuesOf(output, ResponsesArray);
  double largest = 0.0;
  for (int y = 10; y < 160; ++y)
  {
    for (int x = 10; x < 220; ++x)
    {
      const Eigen::Index pixel = y * 230 + x;
      largest =
        std::max(largest, (registered.col(pixel) - expected.col(pixel)).cwiseAbs().maxCoeff());
    }
  }
  EXPECT_LT(largest, 0.03);
  EXPECT_GT((valuesOf(displacedImage(), ResponsesArray) - expected).cwiseAbs().maxCoeff(), 0.3);
  // The third channel lies 2.3 pixels to the left: what it should show at the left edge it lacks.
  const Eigen::Index leftEdge = 80 * 230;
  EXPECT_TRUE(std::isnan(registered(2, leftEdge)));
  EXPECT_EQ(registered(1, leftEdge), expected(1, leftEdge));
}

TEST(ChannelRegistrationFilter, LeavesChannelsThatLieOnOneAnotherAsTheyAre)
{
  vtkNew<vtkChannelRegistration> registration;
  registration->SetInputData(0, displacedImage());
  registration->SetInputData(1, tableOf({ 0.0, 0.0, 0.0 }));
  ASSERT_EQ(errorOf(registration), "");
  EXPECT_EQ(
    valuesOf(vtkImageData::SafeDownCast(registration->GetOutputDataObject(0)), ResponsesArray),
    valuesOf(displacedImage(), ResponsesArray));
}

TEST(ChannelRegistrationFilter, GivesTheSameBytesInPiecesAndThreads)
{
  vtkNew<PieceSource> source;
  source->SetImage(displacedImage());
  vtkNew<vtkChannelDisplacement> displacement;
  displacement->SetInputConnection(source->GetOutputPort());
  expectSameBytesInThreads(displacement);
  vtkNew<vtkChannelRegistration> registration;
  registration->SetInputConnection(0, source->GetOutputPort());
  registration->SetInputConnection(1, displacement->GetOutputPort());
  expectSameBytesInPieces(registration, 3);
  expectSameBytesInThreads(registration);
}

TEST(ChannelDisplacementFilter, SaysWhatIsMissing)
{
  vtkNew<vtkChannelDisplacement> displacement;
  displacement->SetInputData(newImage(40, 20, ResponsesArray, patternValues(3, 800)));
  EXPECT_EQ(errorOf(displacement),
    "the image is 40 x 20 pixels; expected at least 32 on each side to find the channels' "
    "displacements");
  displacement->SetInputData(newImage(40, 40, ResponsesArray, patternValues(1, 1600)));
  EXPECT_EQ(errorOf(displacement), "the image has 1 channel; expected at least 2");
  displacement->SetInputData(displacedImage());
  displacement->SetReference(4);
  EXPECT_EQ(errorOf(displacement),
    "Reference is 4; expected 0 for the channel with the strongest edges, or 1 to 3");
  Eigen::MatrixXd flat = valuesOf(displacedImage(), ResponsesArray);
  flat.row(2).setConstant(0.4);
  displacement->SetReference(0);
  displacement->SetInputData(newImage(230, 170, ResponsesArray, flat, DisplacedGrid));
  EXPECT_NE(
    errorOf(displacement).find("the place of channel 650 beside channel "), std::string::npos);
  std::mt19937 generator(1);
  std::normal_distribution<double> noise(0.5, 0.1);
  const Eigen::MatrixXd noisy =
    Eigen::MatrixXd::NullaryExpr(3, 90 * 80, [&] { return noise(generator); });
  displacement->SetInputData(newImage(90, 80, ResponsesArray, noisy, DisplacedGrid));
  EXPECT_NE(errorOf(displacement).find(" is not known: "), std::string::npos);
}

TEST(ChannelRegistrationFilter, SaysWhatIsWrongWithTheTable)
{
  vtkNew<vtkChannelRegistration> registration;
  registration->SetInputData(0, displacedImage());
  const auto errorWith = [&](vtkTable* table)
  {
    registration->SetInputData(1, table);
    return errorOf(registration);
  };
  EXPECT_EQ(errorWith(newTable({ { "x", { 1.0 } } })),
    "the table of displacements has no column 'channel'; expected channel, x, y, magnification, "
    "rotation, as Channel Displacement gives them");
  EXPECT_EQ(errorWith(newTable({ { "channel", { 450.0 } }, { "x", { 1.0 } } })),
    "the table of displacements has no column 'y'; expected channel, x, y, magnification, "
    "rotation, as Channel Displacement gives them");
  const auto shorter = newTable({ { "channel", { 450.0, 550.0 } }, { "x", { 0.0, 0.0 } },
    { "y", { 0.0, 0.0 } }, { "magnification", { 0.0, 0.0 } }, { "rotation", { 0.0, 0.0 } } });
  EXPECT_EQ(errorWith(shorter),
    "the table of displacements has 2 rows, but the image has 3 channels (450, 550, 650 nm); "
    "expected one row each");
  const auto other = tableOf({ 0.0, 0.0, 0.0 });
  other->SetValueByName(1, "channel", 500.0);
  EXPECT_EQ(errorWith(other),
    "row 2 of the table of displacements is of channel '500'; expected '550', the image's channels "
    "in their order");
  EXPECT_EQ(errorWith(tableOf({ 0.0, NaN, 0.0 })),
    "row 2 of the table of displacements has x = nan; expected a number from -1000 to 1000");
}

TEST(ChannelRegistrationFilter, AsksForTheDisplacements)
{
  vtkNew<vtkChannelRegistration> registration;
  registration->SetInputData(0, displacedImage());
  EXPECT_EQ(
    errorOf(registration).rfind("no displacements are connected; apply Channel Displ", 0), 0u);
}

TEST(ChannelRegistrationFilter, StopsWhenAsked)
{
  vtkNew<vtkChannelRegistration> registration;
  registration->SetInputData(0, imageOf({ { 40, 3000 }, { {}, {}, {} } }));
  registration->SetInputData(1, tableOf({ 0.5, 0.0, 0.0 }));
  EXPECT_EQ(errorWhenStopped(registration), "stopped by the user");
}

TEST(ChannelDisplacementFilter, PrintsItsProperties)
{
  vtkNew<vtkChannelDisplacement> displacement;
  displacement->SetReference(3);
  EXPECT_NE(printed(displacement).find("Reference: 3\n"), std::string::npos);
}
}
