#include "vtkSpectralToColor.h"

#include "GraySpectra.h"
#include "Support/vtk/PieceSource.h"
#include "Support/vtk/Runs.h"

#include "vtkNew.h"

#include "SampleColumns.h"

#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"

#include <gtest/gtest.h>

#include <filesystem>
#include <fstream>
#include <limits>

namespace
{
using namespace msi;
using namespace msi::testing;

vtkImageData* imageOf(vtkSpectralToColor* color)
{
  return vtkImageData::SafeDownCast(color->GetOutputDataObject(0));
}

vtkTable* tableOf(vtkSpectralToColor* color)
{
  return vtkTable::SafeDownCast(color->GetOutputDataObject(0));
}

TEST(SpectralToColor, ShowsGraysAsIEC61966Says)
{
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(grayImage({ 0.01, 0.18, 0.5, 1.0 }));
  for (const char* illuminant : { "D65", "A", "F2", "LED-B3" })
  {
    color->SetIlluminant(illuminant);
    ASSERT_EQ(errorOf(color), "");
    const auto rgb = valuesOf(imageOf(color), "sRGB");
    ASSERT_EQ(rgb.rows(), 3);
    int pixel = 0;
    for (const double factor : { 0.01, 0.18, 0.5, 1.0 })
    {
      const double expected = std::round(255.0 * encodedSRGB(factor));
      EXPECT_EQ(rgb.col(pixel++), Eigen::Vector3d::Constant(expected)) << illuminant << factor;
    }
    EXPECT_EQ(color->GetClippedCount(), 0) << illuminant;
  }
}

TEST(SpectralToColor, GivesXYZAndLabOnRequest)
{
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(grayImage({ 0.05, 0.5, 1.0 }));
  color->ComputeXYZOn();
  color->ComputeLabOn();
  ASSERT_EQ(errorOf(color), "");
  const auto xyz = valuesOf(imageOf(color), "XYZ");
  const auto lab = valuesOf(imageOf(color), "Lab");
  int pixel = 0;
  for (const double factor : { 0.05, 0.5, 1.0 })
  {
    EXPECT_NEAR(xyz(1, pixel), 100.0 * factor, 2e-5);
    EXPECT_NEAR(lab(0, pixel), lightnessOf(factor), 5e-5);
    EXPECT_NEAR(lab(1, pixel), 0.0, 5e-4);
    EXPECT_NEAR(lab(2, pixel), 0.0, 5e-4);
    ++pixel;
  }
}

TEST(SpectralToColor, KeepsTheArraysOfTheImage)
{
  const auto image = grayImage({ 0.5 });
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(image);
  ASSERT_EQ(errorOf(color), "");
  auto* points = imageOf(color)->GetPointData();
  EXPECT_EQ(points->GetArray(ReflectanceArray), image->GetPointData()->GetArray(ReflectanceArray));
  EXPECT_EQ(points->GetNumberOfArrays(), 2) << "XYZ and Lab were not asked for";
  ASSERT_NE(points->GetScalars(), nullptr);
  EXPECT_STREQ(points->GetScalars()->GetName(), "sRGB");
  EXPECT_EQ(image->GetPointData()->GetNumberOfArrays(), 1) << "the input was changed";
}

TEST(SpectralToColor, AgreesWithTheKernelOnColoredSpectra)
{
  const Eigen::MatrixXd spectra = patternValues(GrayGrid.size(), 600);
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(newImage<vtkDoubleArray>(30, 20, ReflectanceArray, spectra, GrayGrid));
  color->SetIlluminant("FL11");
  color->SetObserver("CIE 1964 10 degree");
  color->ComputeXYZOn();
  color->ComputeLabOn();
  ASSERT_EQ(errorOf(color), "");
  const TristimulusTransform transform(
    GrayGrid, Illuminant::named("FL11"), StandardObserver::cie1964TenDegree());
  const Eigen::Matrix3Xd xyz = transform(spectra);
  Eigen::Matrix3Xd lab(3, xyz.cols());
  CIELAB(transform.whitePoint()).fromXYZ(xyz, lab);
  EXPECT_LT((valuesOf(imageOf(color), "XYZ") - xyz).cwiseAbs().maxCoeff(), 1e-4);
  EXPECT_LT((valuesOf(imageOf(color), "Lab") - lab).cwiseAbs().maxCoeff(), 1e-3);
}

TEST(SpectralToColor, KeepsANaNInItsPixel)
{
  auto image = grayImage({ 0.5, 0.5, 0.5 });
  image->GetPointData()->GetScalars()->SetComponent(1, 7, NaN);
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(image);
  color->ComputeXYZOn();
  color->ComputeLabOn();
  ASSERT_EQ(errorOf(color), "");
  for (const char* name : { "XYZ", "Lab" })
  {
    const auto values = valuesOf(imageOf(color), name);
    EXPECT_TRUE(values.col(1).array().isNaN().all()) << name;
    EXPECT_EQ(values.array().isNaN().count(), 3) << name;
  }
  const auto rgb = valuesOf(imageOf(color), "sRGB");
  EXPECT_EQ(rgb.col(1), Eigen::Vector3d::Zero());
  EXPECT_EQ(rgb.col(0), rgb.col(2));
  EXPECT_GT(rgb(0, 0), 0.0);
}

TEST(SpectralToColor, CountsWhatItClips)
{
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(grayImage({ 0.5, 1.5, -0.25, 1.0, NaN }));
  ASSERT_EQ(errorOf(color), "");
  EXPECT_EQ(color->GetClippedCount(), 2);
  const auto rgb = valuesOf(imageOf(color), "sRGB");
  EXPECT_EQ(rgb.col(1), Eigen::Vector3d::Constant(255.0));
  EXPECT_EQ(rgb.col(2), Eigen::Vector3d::Zero());
}

TEST(SpectralToColor, GivesATableColumnsForMeasuredAndEstimated)
{
  vtkNew<vtkTable> table;
  addSpectra(table, 'R', GrayGrid, grays({ 0.5, 1.0 }));
  addSpectra(table, 'E', GrayGrid, grays({ 0.18, 0.18 }));
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(table);
  ASSERT_EQ(errorOf(color), "");
  auto* output = tableOf(color);
  EXPECT_NEAR(cell(output, 0, "R_Y"), 50.0, 1e-10);
  EXPECT_NEAR(cell(output, 1, "R_Y"), 100.0, 1e-10);
  EXPECT_NEAR(cell(output, 0, "R_L"), lightnessOf(0.5), 1e-10);
  EXPECT_NEAR(cell(output, 0, "R_a"), 0.0, 1e-10);
  EXPECT_NEAR(cell(output, 0, "E_L"), lightnessOf(0.18), 1e-10);
  EXPECT_NEAR(cell(output, 0, "E_green"), 255.0 * encodedSRGB(0.18), 1e-9);
  EXPECT_EQ(cell(output, 0, "R400"), 0.5);
  EXPECT_EQ(table->GetNumberOfColumns(), 2 * GrayGrid.size()) << "the input was changed";
}

TEST(SpectralToColor, NamesAnIlluminantOrObserverThatIsNotKnown)
{
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(grayImage({ 0.5 }));
  color->SetIlluminant("D5x");
  const auto illuminant = errorOf(color);
  EXPECT_NE(illuminant.find("'D5x'"), std::string::npos) << illuminant;
  EXPECT_NE(illuminant.find("D65"), std::string::npos)
    << "the known ones are listed: " << illuminant;
  color->SetIlluminant("D65");
  color->SetObserver("CIE 2006");
  const auto observer = errorOf(color);
  EXPECT_NE(observer.find("'CIE 2006'"), std::string::npos) << observer;
  EXPECT_NE(observer.find("CIE 1964 10 degree"), std::string::npos) << observer;
}

vtkSmartPointer<vtkTable> curvesAt1nm(
  const std::vector<std::pair<std::string, Eigen::VectorXd>>& curves)
{
  const auto grid = WavelengthGrid::uniform(360.0, 830.0, 1.0);
  auto table = vtkSmartPointer<vtkTable>::New();
  setNumbers(table, "wavelength", grid.vector());
  for (const auto& [name, values] : curves)
  {
    setNumbers(table, name, values);
  }
  return table;
}

// The CIE's own observer and illuminant, handed in as a user's, change nothing.
TEST(SpectralToColor, TakesAnIlluminantThatTheListHasNot)
{
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(grayImage({ 0.5 }));
  color->ComputeXYZOn();
  color->SetIlluminant("other");
  EXPECT_NE(
    errorOf(color).find("Other Illuminant is empty; type an illuminant"), std::string::npos);
  color->SetOtherIlluminant("D5300");
  ASSERT_EQ(errorOf(color), "");
  const auto other = valuesOf(imageOf(color), "XYZ");
  color->SetIlluminant("D5300K");
  ASSERT_EQ(errorOf(color), "");
  EXPECT_EQ(valuesOf(imageOf(color), "XYZ"), other);
}

TEST(SpectralToColor, RefusesResponses)
{
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(newImage(1, 1, ResponsesArray, patternValues(GrayGrid.size(), 1), GrayGrid));
  EXPECT_EQ(
    errorOf(color).rfind("the image holds camera responses (the array 'Responses')", 0), 0u);
  color->SetSpectralArray(ResponsesArray);
  EXPECT_EQ(errorOf(color), "");
}

TEST(SpectralToColor, TakesALampAndAnObserverFromTables)
{
  const auto grid = WavelengthGrid::uniform(360.0, 830.0, 1.0);
  const auto& ten = StandardObserver::cie1964TenDegree().functions();
  vtkNew<vtkTable> table;
  Eigen::MatrixXd spectrum(GrayGrid.size(), 1);
  spectrum.col(0).setLinSpaced(0.1, 0.8);
  addSpectra(table, 'R', GrayGrid, spectrum);
  vtkNew<vtkSpectralToColor> named;
  named->SetInputData(table);
  named->SetIlluminant("D50");
  named->SetObserver("10");
  ASSERT_EQ(errorOf(named), "");
  vtkNew<vtkSpectralToColor> own;
  own->SetInputData(table);
  own->SetIlluminant("lamp");
  own->SetInputData(1, curvesAt1nm({ { "lamp", 3.0 * Illuminant::named("D50").powerAt(grid) } }));
  own->SetInputData(2,
    curvesAt1nm({ { "x", ten.row(0).transpose() }, { "y", ten.row(1).transpose() },
      { "z", ten.row(2).transpose() } }));
  ASSERT_EQ(errorOf(own), "");
  for (const char* column : { "R_X", "R_Y", "R_Z", "R_L", "R_a", "R_b" })
  {
    const double expected = cell(vtkTable::SafeDownCast(named->GetOutputDataObject(0)), 0, column);
    EXPECT_NEAR(
      cell(vtkTable::SafeDownCast(own->GetOutputDataObject(0)), 0, column), expected, 1e-9)
      << column;
  }
}

TEST(SpectralToColor, TakesALampFromAFile)
{
  const auto folder = std::filesystem::path(::testing::TempDir());
  const std::string one = (folder / "SpectralToColor one.csv").string();
  const std::string two = (folder / "SpectralToColor two.csv").string();
  std::ofstream(one) << "wavelength,power\n360,1\n830,1\n";
  std::ofstream(two) << "wavelength,warm,even\n360,0,1\n830,2,1\n";
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(grayImage({ 0.5 }));
  color->ComputeXYZOn();
  color->SetIlluminant("E");
  ASSERT_EQ(errorOf(color), "");
  const auto even = valuesOf(imageOf(color), "XYZ");
  color->SetIlluminant("other");
  color->SetIlluminantFile(one.c_str());
  ASSERT_EQ(errorOf(color), "");
  EXPECT_EQ(valuesOf(imageOf(color), "XYZ"), even);
  color->SetOtherIlluminant("D5300K");
  EXPECT_EQ(errorOf(color),
    "Other Illuminant is 'D5300K', but Illuminant File is " + one +
      " with 'SpectralToColor-one'; expected one of these names, or one of the two fields empty");
  color->SetIlluminantFile(two.c_str());
  color->SetOtherIlluminant("");
  EXPECT_EQ(errorOf(color),
    two +
      ": the file holds 2 illuminants, 'warm', 'even'; expected the name of one; type it as Other "
      "Illuminant");
  color->SetOtherIlluminant("even");
  ASSERT_EQ(errorOf(color), "");
  EXPECT_EQ(valuesOf(imageOf(color), "XYZ"), even);
  color->SetObserverFile(two.c_str());
  EXPECT_EQ(errorOf(color),
    two +
      " has 2 curves; expected three over the same wavelengths: x-bar, y-bar and z-bar, in this "
      "order");
}

TEST(SpectralToColor, AddsQuantitiesAndTheGamutMask)
{
  // A gray, and a red that no display has: reflectance at long wavelengths alone.
  Eigen::MatrixXd spectra = Eigen::MatrixXd::Zero(GrayGrid.size(), 2);
  spectra.col(0).setConstant(0.9);
  spectra.col(1).tail(7).setOnes();
  vtkNew<vtkTable> table;
  addSpectra(table, 'R', GrayGrid, spectra);
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(table);
  color->SetQuantities("xyY, Luv, LCh, whiteness");
  color->GamutMaskOn();
  ASSERT_EQ(errorOf(color), "");
  auto* output = vtkTable::SafeDownCast(color->GetOutputDataObject(0));
  EXPECT_NEAR(cell(output, 0, "R_x"), 0.3127, 1e-4); // of D65
  EXPECT_NEAR(cell(output, 0, "R_y"), 0.3290, 1e-4);
  EXPECT_NEAR(cell(output, 0, "R_u"), 0.0, 1e-9);
  EXPECT_NEAR(cell(output, 0, "R_C"), 0.0, 1e-9);
  EXPECT_NEAR(cell(output, 0, "R_whiteness"), 90.0, 1e-9); // W of a gray is its Y
  EXPECT_NEAR(cell(output, 0, "R_tint"), 0.0, 1e-9);
  EXPECT_EQ(cell(output, 0, "R_out_of_gamut"), 0.0);
  EXPECT_TRUE(std::isnan(cell(output, 1, "R_whiteness")));
  EXPECT_EQ(cell(output, 1, "R_out_of_gamut"), 1.0);
  EXPECT_GT(cell(output, 1, "R_C"), 60.0);
  EXPECT_EQ(color->GetClippedCount(), 1);

  color->SetInputData(newImage(2, 1, ReflectanceArray, spectra, GrayGrid));
  color->SetDisplay("Display P3");
  ASSERT_EQ(errorOf(color), "");
  EXPECT_STREQ(imageOf(color)->GetPointData()->GetScalars()->GetName(), "Display P3");
  const auto mask = valuesOf(imageOf(color), "OutOfGamut");
  EXPECT_EQ(mask(0, 0), 0.0);
  EXPECT_EQ(mask(0, 1), 1.0);
  const auto whiteness = valuesOf(imageOf(color), "whiteness");
  EXPECT_NEAR(whiteness(0, 0), 90.0, 1e-3);
  EXPECT_TRUE(std::isnan(whiteness(0, 1)));
  EXPECT_NEAR(valuesOf(imageOf(color), "xyY")(1, 0), 0.3290, 1e-4);

  color->SetIlluminant("A");
  EXPECT_EQ(errorOf(color),
    "the quantity whiteness is not defined under 'A' for the observer 'CIE 1931 2 degree'; "
    "expected "
    "the illuminant D65, D50 or C and an observer of the CIE");
  color->SetQuantities("");
  color->SetDisplay("Rec. 2020");
  EXPECT_EQ(errorOf(color), "there is no display space 'Rec. 2020'; expected sRGB or Display P3");
}

std::string colorError(vtkDataObject* input, const char* array = "")
{
  vtkNew<vtkSpectralToColor> color;
  color->SetInputData(input);
  color->SetSpectralArray(array);
  return errorOf(color);
}

TEST(SpectralToColor, SaysWhatIsMissing)
{
  EXPECT_EQ(colorError(newImage(2, 1, ReflectanceArray, patternValues(3, 2))),
    "the image has no wavelengths (field data 'Wavelength'); color needs reflectance whose "
    "wavelengths "
    "are known");
  EXPECT_EQ(colorError(newTable({ { "C400", { 1.0 } } })),
    "the table has no reflectance; expected columns R400, R410, .. (measured) or E400, E410, .. "
    "(estimated)");
  vtkNew<vtkImageData> bare;
  bare->SetDimensions(2, 2, 1);
  EXPECT_EQ(colorError(bare), "the image has no point array; expected a spectral image");
  EXPECT_EQ(colorError(grayImage({ 0.5 }), "cube"),
    "the image has no point array 'cube'; it has 'Reflectance'");
}

class ColorOfALargeImage : public ::testing::Test
{
protected:
  static constexpr int Size = 300;

  ColorOfALargeImage()
  {
    const WavelengthGrid grid({ 420.0, 540.0, 660.0 });
    Source->SetImage(
      newImage(Size, Size, ReflectanceArray, patternValues(grid.size(), Size * Size), grid));
    Color->SetInputConnection(Source->GetOutputPort());
    Color->ComputeXYZOn();
    Color->ComputeLabOn();
  }
  vtkNew<PieceSource> Source;
  vtkNew<vtkSpectralToColor> Color;
};

TEST_F(ColorOfALargeImage, HasTheSameBytesInThreads)
{
  expectSameBytesInThreads(Color);
}

TEST_F(ColorOfALargeImage, HasTheSameBytesInPieces)
{
  expectSameBytesInPieces(Color, 3);
}

TEST_F(ColorOfALargeImage, CanBeStopped)
{
  EXPECT_EQ(errorWhenStopped(Color), "stopped by the user");
}

TEST(SpectralToColor, PrintsItself)
{
  vtkNew<vtkSpectralToColor> color;
  color->SetIlluminant("A");
  color->SetSpectralArray("cube");
  color->ComputeLabOn();
  const auto text = printed(color);
  for (const char* line : { "Illuminant: A\n", "Observer: CIE 1931 2 degree\n",
         "SpectralArray: cube\n", "ComputeXYZ: 0\n", "ComputeLab: 1\n", "ClippedCount: 0\n" })
  {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}
}
