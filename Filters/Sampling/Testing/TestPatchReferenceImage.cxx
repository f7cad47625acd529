#include "vtkPatchReferenceImage.h"

#include "Support/vtk/Images.h"
#include "Support/vtk/PieceSource.h"
#include "Support/vtk/Runs.h"
#include "Support/vtk/Tables.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
using namespace msi;
using namespace msi::testing;

std::string errorWith(vtkImageData* labels, vtkTable* patches)
{
  vtkNew<vtkPatchReferenceImage> reference;
  reference->SetInputData(0, labels);
  reference->SetInputData(1, patches);
  return errorOf(reference);
}

TEST(PatchReferenceImage, PaintsEachPatchWithItsSpectrum)
{
  vtkNew<vtkPatchReferenceImage> reference;
  reference->SetInputData(0, newLabels(3, 2, { 0, 1, 2, 3, 2, 1 }));
  reference->SetInputData(1,
    newTable({ { "label", { 2.0, 1.0 } }, { "R500", { 0.5, 0.25 } }, { "R400", { 0.75, 1.0 } } }));
  ASSERT_EQ(errorOf(reference), "");
  auto* output = reference->GetOutput();
  auto* array = requireSpectralArray(output, "the output");
  EXPECT_STREQ(array->GetName(), ReflectanceArray);
  EXPECT_EQ(axisOf(output, array).wavelengths->values(), (std::vector<double>{ 400.0, 500.0 }));
  const auto values = valuesOf(output, ReflectanceArray);
  for (const int pixel : { 0, 3 })
  {
    EXPECT_TRUE(values.col(pixel).array().isNaN().all()) << pixel;
  }
  for (const int pixel : { 1, 5 })
  {
    EXPECT_EQ(values.col(pixel), Eigen::Vector2d(1.0, 0.25)) << pixel;
  }
  for (const int pixel : { 2, 4 })
  {
    EXPECT_EQ(values.col(pixel), Eigen::Vector2d(0.75, 0.5)) << pixel;
  }
}

TEST(PatchReferenceImage, KeepsTheFrameOfTheLabels)
{
  const auto labels = newLabels(3, 2, { 0, 1, 1, 1, 1, 1 });
  labels->SetOrigin(5.0, 6.0, 0.0);
  labels->SetSpacing(0.5, 0.25, 1.0);
  vtkNew<vtkPatchReferenceImage> reference;
  reference->SetInputData(0, labels);
  reference->SetInputData(1, newTable({ { "label", { 1.0 } }, { "R400", { 0.5 } } }));
  ASSERT_EQ(errorOf(reference), "");
  EXPECT_EQ(reference->GetOutput()->GetOrigin()[1], 6.0);
  EXPECT_EQ(reference->GetOutput()->GetSpacing()[1], 0.25);
}

TEST(PatchReferenceImage, NamesWhatThePatchTableLacks)
{
  const auto labels = newLabels(2, 1, { 0, 1 });
  EXPECT_EQ(errorWith(labels, newTable({ { "label", { 1.0 } }, { "C400", { 1.0 } } })),
    "the patch table has no columns of measured reflectance (R400, R410, ..); it has 2 other "
    "columns");
  EXPECT_EQ(errorWith(labels, newTable({ { "patch", { 1.0 } }, { "R400", { 1.0 } } })),
    "the patch table has no column of numbers 'label'; expected the patch number of each row");
  EXPECT_EQ(
    errorWith(labels, newTable({})), "the patch table is empty; expected a table of samples");
}

TEST(PatchReferenceImage, NamesLabelsThatCannotBe)
{
  const auto labels = newLabels(2, 1, { 0, 1 });
  const auto tableWith = [](std::vector<double> column) {
    return newTable({ { "label", column }, { "R400", std::vector<double>(column.size(), 0.5) } });
  };
  EXPECT_EQ(errorWith(labels, tableWith({ 1.0, 2.0, 1.0 })),
    "rows 1 and 3 of the patch table have the same label");
  for (const double label : { 0.0, -1.0, 1.5, NaN })
  {
    EXPECT_EQ(errorWith(labels, tableWith({ 2.0, label })),
      "row 2 of the patch table has the label " + std::to_string(label) +
        "; expected a whole number from 1 on");
  }
}

TEST(PatchReferenceImage, RefusesAnImageThatIsNoLabelImage)
{
  const auto patches = newTable({ { "label", { 1.0 } }, { "R400", { 0.5 } } });
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(2, 2, 1);
  EXPECT_EQ(
    errorWith(bare, patches), "the label image has no point array; expected a spectral image");
  EXPECT_EQ(errorWith(newImage(2, 1, "RGB", patternValues(3, 2)), patches),
    "the label image has 3 components a pixel; expected one label per pixel");
}

class PatchReferenceOfManyPatches : public ::testing::Test
{
protected:
  static constexpr int Width = 300;
  static constexpr int Height = 300;

  PatchReferenceOfManyPatches()
  {
    std::vector<int> labels(static_cast<std::size_t>(Width * Height));
    for (std::size_t i = 0; i < labels.size(); ++i)
    {
      labels[i] = static_cast<int>(i * 7 % 12);
    }
    Source->SetImage(newLabels(Width, Height, labels));
    Reference->SetInputConnection(0, Source->GetOutputPort());
    const WavelengthGrid grid({ 400.0, 500.0, 600.0 });
    const auto patches = newTable({ { "label", { 5, 1, 9, 11, 2 } } });
    addSpectra(patches, 'R', grid, patternValues(3, 5));
    Reference->SetInputData(1, patches);
  }
  vtkNew<PieceSource> Source;
  vtkNew<vtkPatchReferenceImage> Reference;
};

TEST_F(PatchReferenceOfManyPatches, HasTheSameBytesInThreads)
{
  expectSameBytesInThreads(Reference);
}

TEST_F(PatchReferenceOfManyPatches, HasTheSameBytesInPieces)
{
  expectSameBytesInPieces(Reference, 4);
}

TEST_F(PatchReferenceOfManyPatches, CanBeStopped)
{
  EXPECT_EQ(errorWhenStopped(Reference), "stopped by the user");
}

TEST(PatchReferenceImage, PrintsItself)
{
  vtkNew<vtkPatchReferenceImage> reference;
  EXPECT_NE(printed(reference).find("vtkPatchReferenceImage"), std::string::npos);
}
}
