#include "SpectralImage.h"

#include "Support/vtk/ErrorText.h"
#include "Support/vtk/Images.h"

#include "vtkFieldData.h"
#include "vtkNew.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using namespace msi::testing;

const WavelengthGrid Grid({ 400.0, 402.5, 700.0 });

vtkSmartPointer<vtkFloatArray> newArray(const char* name)
{
  auto array = vtkSmartPointer<vtkFloatArray>::New();
  array->SetName(name);
  array->SetNumberOfTuples(4);
  array->FillValue(1.0f);
  return array;
}

TEST(SpectralImage, TakesTheActiveScalarsOrTheOnlyArray)
{
  const auto image = newImage(2, 2, "a", patternValues(3, 4), Grid);
  image->GetPointData()->AddArray(newArray("b"));
  EXPECT_STREQ(requireSpectralArray(image, "it")->GetName(), "a");
  EXPECT_STREQ(requireSpectralArray(image, "it", "")->GetName(), "a");
  EXPECT_STREQ(requireSpectralArray(image, "it", "b")->GetName(), "b");

  const auto single = newImage(2, 2, "a", patternValues(3, 4), Grid);
  single->GetPointData()->SetActiveScalars(nullptr);
  EXPECT_STREQ(requireSpectralArray(single, "it")->GetName(), "a");
}

TEST(SpectralImage, NamesWhatAnImageHoldsInstead)
{
  const auto image = newImage(2, 2, "a", patternValues(3, 4), Grid);
  image->GetPointData()->AddArray(newArray(nullptr));
  EXPECT_EQ(argumentError([&] { requireSpectralArray(image, "the image", "c"); }),
    "the image has no point array 'c'; it has 'a', '(unnamed)'");
  image->GetPointData()->SetActiveScalars(nullptr);
  EXPECT_EQ(argumentError([&] { requireSpectralArray(image, "the image"); }),
    "the image has several point arrays and none is active; choose one of 'a', '(unnamed)'");
  vtkNew<vtkImageData> bare;
  EXPECT_EQ(argumentError([&] { requireSpectralArray(bare, "the image"); }),
    "the image has no point array; expected a spectral image");
  EXPECT_EQ(argumentError([&] { requireSpectralArray(nullptr, "the image"); }),
    "the image has no point array; expected a spectral image");
}

TEST(SpectralImage, ReadsTheAxisItWrote)
{
  const auto image = newImage(2, 2, "a", patternValues(3, 4), Grid);
  auto* array = image->GetPointData()->GetArray("a");
  EXPECT_EQ(axisOf(image, array).wavelengths, Grid);
  EXPECT_EQ(axisOf(image, array).names, (std::vector<std::string>{ "400", "402.5", "700" }));
  EXPECT_STREQ(array->GetComponentName(1), "402.5 nm");

  SpectralAxis numbered{ { "C1", "C2", "C7" }, {} };
  setAxis(image, array, numbered);
  EXPECT_EQ(image->GetFieldData()->GetArray(WavelengthArray), nullptr);
  EXPECT_FALSE(axisOf(image, array).wavelengths);
  EXPECT_EQ(axisOf(image, array).names, numbered.names);
}

TEST(SpectralImage, CountsChannelsThatHaveNoName)
{
  const auto image = newImage(2, 2, "a", patternValues(2, 4));
  EXPECT_EQ(axisOf(image, image->GetPointData()->GetArray("a")).names,
    (std::vector<std::string>{ "C1", "C2" }));
}

TEST(SpectralImage, TakesNoWavelengthsOfAnotherArray)
{
  const auto image = newImage(2, 2, "a", patternValues(3, 4), Grid);
  image->GetPointData()->AddArray(newArray("b"));
  EXPECT_FALSE(axisOf(image, image->GetPointData()->GetArray("b")).wavelengths);
}

TEST(SpectralImage, RefusesWavelengthsOutOfOrder)
{
  const auto image = newImage(2, 2, "a", patternValues(3, 4), Grid);
  image->GetFieldData()->GetArray(WavelengthArray)->SetComponent(2, 0, 401.0);
  EXPECT_NE(argumentError([&] { axisOf(image, image->GetPointData()->GetArray("a")); }), "");
}

TEST(SpectralImage, RefusesLabelsOfSeveralComponents)
{
  const auto labels = newLabels(2, 1, { 0, 1 });
  EXPECT_EQ(
    argumentError([&] { requireOneLabelPerPixel(labels->GetPointData()->GetScalars(), "it"); }),
    "");
  const auto color = newImage(2, 1, "RGB", patternValues(3, 2));
  EXPECT_EQ(argumentError([&]
              { requireOneLabelPerPixel(color->GetPointData()->GetScalars(), "the label image"); }),
    "the label image has 3 components a pixel; expected one label per pixel");
}

TEST(SpectralImage, ReplacesOneArrayAndKeepsTheOthers)
{
  const auto image = newImage(2, 2, "active", patternValues(3, 4), Grid);
  auto* points = image->GetPointData();
  points->AddArray(newArray("old"));
  points->AddArray(newArray("other"));
  replaceArray(image, points->GetArray("old"), newArray("new"));
  EXPECT_EQ(points->GetNumberOfArrays(), 3);
  EXPECT_EQ(points->GetArray("old"), nullptr);
  EXPECT_NE(points->GetArray("other"), nullptr);
  EXPECT_NE(points->GetArray("active"), nullptr) << "the active array is no array to drop";
  ASSERT_NE(points->GetScalars(), nullptr);
  EXPECT_STREQ(points->GetScalars()->GetName(), "new");
  replaceArray(image, nullptr, newArray("second"));
  EXPECT_EQ(points->GetNumberOfArrays(), 4);
  EXPECT_STREQ(points->GetScalars()->GetName(), "second");
}
}
