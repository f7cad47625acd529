#include "vtkPatchSampler.h"

#include "Support/vtk/Images.h"
#include "Support/vtk/Runs.h"
#include "Support/vtk/Tables.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
using namespace msi;
using namespace msi::testing;

class PatchSamplerErrors : public ::testing::Test
{
protected:
  PatchSamplerErrors()
  {
    Sampler->SetInputData(0, newImage(4, 2, ResponsesArray, patternValues(2, 8)));
    Sampler->SetInputData(1, newLabels(4, 2, { 1, 1, 2, 2, 0, 0, 5, 5 }));
  }
  std::string errorWithLabels(vtkImageData* labels)
  {
    Sampler->SetInputData(1, labels);
    return errorOf(Sampler);
  }
  std::string errorWithTable(vtkTable* table)
  {
    Sampler->SetInputData(2, table);
    return errorOf(Sampler);
  }
  vtkNew<vtkPatchSampler> Sampler;
};

TEST_F(PatchSamplerErrors, NameTheSizesThatDiffer)
{
  EXPECT_EQ(errorWithLabels(newLabels(3, 2, { 1, 1, 1, 1, 1, 1 })),
    "the label image has 3 x 2 pixels, but the image has 4 x 2; expected one label "
    "per "
    "pixel");
}

TEST_F(PatchSamplerErrors, NameTheComponentsOfALabel)
{
  EXPECT_EQ(errorWithLabels(newImage(4, 2, "RGB", patternValues(3, 8))),
    "the label image has 3 components a pixel; expected one label per pixel");
}

TEST_F(PatchSamplerErrors, NameALabelThatCannotBe)
{
  Eigen::MatrixXd labels = Eigen::MatrixXd::Ones(1, 8);
  for (const double label : { 1.5, -1.0, 100001.0, std::numeric_limits<double>::quiet_NaN() })
  {
    labels(0, 5) = label;
    EXPECT_EQ(errorWithLabels(newImage<vtkDoubleArray>(4, 2, LabelArray, labels)),
      "the label image holds the value " + std::to_string(label) +
        "; expected whole numbers from 0 (no patch) to 100000");
  }
}

TEST_F(PatchSamplerErrors, RefuseLabelsWithoutPatch)
{
  EXPECT_EQ(errorWithLabels(newLabels(4, 2, std::vector<int>(8, 0))),
    "the label image is 0 everywhere; expected patches 1, 2, ..");
}

TEST_F(PatchSamplerErrors, NameWhatTheTableLacks)
{
  EXPECT_EQ(errorWithTable(newTable({ { "patch", { 1.0 } } })),
    "the patch table has no column of numbers 'label'; expected the patch number of each row");
}

TEST_F(PatchSamplerErrors, NameALabelWithoutPixels)
{
  for (const auto& [label, text] :
    { std::pair(3.0, "3."), std::pair(6.0, "6."), std::pair(0.0, "0."), std::pair(1.5, "1.5") })
  {
    const auto error = errorWithTable(newTable({ { "label", { 1.0, label } } }));
    std::string shown = text;
    if (shown.back() == '.')
    {
      shown.pop_back();
    }
    EXPECT_EQ(error,
      "row 2 of the patch table asks for label " + shown +
        ", which has no finite pixel in the image; labels go from 1 to 5");
  }
}

TEST_F(PatchSamplerErrors, NameAPatchWithoutFinitePixels)
{
  Eigen::MatrixXd values = patternValues(2, 8);
  values.rightCols(2).setConstant(std::numeric_limits<double>::quiet_NaN());
  Sampler->SetInputData(0, newImage(4, 2, ResponsesArray, values));
  EXPECT_EQ(errorWithTable(newTable({ { "label", { 5.0 } } })),
    "row 1 of the patch table asks for label 5, which has no finite pixel in the image; labels go "
    "from "
    "1 to 5");
}

TEST_F(PatchSamplerErrors, NameTheArrayThatIsNotThere)
{
  Sampler->SetSpectralArray("none");
  EXPECT_EQ(errorOf(Sampler), "the image has no point array 'none'; it has 'Responses'");
}

TEST_F(PatchSamplerErrors, RefuseAnImageWithoutArray)
{
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(4, 2, 1);
  Sampler->SetInputData(0, bare);
  EXPECT_EQ(errorOf(Sampler), "the image has no point array; expected a spectral image");
}

TEST_F(PatchSamplerErrors, ComeFromTheGridToo)
{
  Sampler->SetInputConnection(1, nullptr);
  Sampler->SetCorner1(1.0, 1.0);
  EXPECT_NE(errorOf(Sampler), "");
}

TEST_F(PatchSamplerErrors, ComeFromAStop)
{
  constexpr int Size = 300;
  Sampler->SetInputData(0, newImage(Size, Size, ResponsesArray, patternValues(1, Size * Size)));
  Sampler->SetInputConnection(1, nullptr);
  EXPECT_EQ(errorWhenStopped(Sampler), "stopped by the user");
}
}
