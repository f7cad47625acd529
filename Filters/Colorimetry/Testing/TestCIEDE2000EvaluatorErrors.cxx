#include "vtkCIEDE2000Evaluator.h"

#include "GraySpectra.h"
#include "Support/vtk/Runs.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using namespace msi::testing;

std::string errorWith(vtkDataObject* estimate, vtkDataObject* reference)
{
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, estimate);
  if (reference)
  {
    evaluator->SetInputData(1, reference);
  }
  return errorOf(evaluator);
}

vtkSmartPointer<vtkTable> grayTable(char letter, const std::vector<double>& factors)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  addSpectra(table, letter, GrayGrid, grays(factors));
  return table;
}

TEST(CIEDE2000EvaluatorErrors, AskForTheReferenceOfAnImage)
{
  const std::string expected =
    "an estimated image needs a reference image of the same region as second "
    "input (see Patch Reference Image)";
  EXPECT_EQ(errorWith(grayImage({ 0.5 }), nullptr), expected);
  EXPECT_EQ(errorWith(grayImage({ 0.5 }), grayTable('R', { 0.5 })), expected);
}

TEST(CIEDE2000EvaluatorErrors, RefuseResponsesAsReflectance)
{
  const auto responses =
    newImage(1, 1, ResponsesArray, patternValues(GrayGrid.size(), 1), GrayGrid);
  EXPECT_EQ(errorWith(responses, grayImage({ 0.5 })),
    "the estimate holds camera responses (the array 'Responses'); expected reflectance; estimate "
    "it with Reflectance Estimation, or, where the values are reflectance, set Array Kind of the "
    "image's reader to Reflectance");
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, responses);
  evaluator->SetInputData(1, grayImage({ 0.5 }));
  evaluator->SetEstimateArray(ResponsesArray);
  EXPECT_EQ(errorOf(evaluator), "");
}

TEST(CIEDE2000EvaluatorErrors, NameTheSizesThatDiffer)
{
  EXPECT_EQ(errorWith(grayImage({ 0.1, 0.2, 0.3 }), grayImage({ 0.1, 0.2 })),
    "the estimate has 3 x 1 pixels, but the reference has 2 x 1; both must show the same region");
  EXPECT_EQ(errorWith(grayImage({ 0.1 }), grayImage({ 0.1, 0.2 })),
    "the estimate has 1 x 1 pixels, but the reference has 2 x 1; both must show the same region");
}

TEST(CIEDE2000EvaluatorErrors, NameTheBandsThatDiffer)
{
  const auto coarse = WavelengthGrid::uniform(400, 700, 20);
  EXPECT_EQ(errorWith(grayImage({ 0.5 }),
              newImage(1, 1, ReflectanceArray, patternValues(coarse.size(), 1), coarse)),
    "the estimate has 31 bands (400, 410, .., 700 nm), but the reference has 16 bands (400, 420, "
    ".., 700 "
    "nm); resample one of them first");
}

TEST(CIEDE2000EvaluatorErrors, RefuseAReferenceOfTheOtherKind)
{
  EXPECT_EQ(errorWith(grayTable('E', { 0.1 }), grayImage({ 0.1 })),
    "the estimate is a table of samples, but the reference is an image; give a table of the same "
    "samples, or none where the estimate's table holds the measured reflectance");
  EXPECT_EQ(errorWith(grayImage({ 0.1 }), grayTable('R', { 0.1 })),
    "an estimated image needs a reference image of the same region as second input (see Patch "
    "Reference Image)");
}

TEST(CIEDE2000EvaluatorErrors, NameTheNumbersOfSamplesThatDiffer)
{
  EXPECT_EQ(errorWith(grayTable('E', { 0.1, 0.2, 0.3 }), grayTable('R', { 0.1, 0.2 })),
    "the estimate has 3 samples, but the reference has 2; both must list the same samples in the "
    "same "
    "order");
}

TEST(CIEDE2000EvaluatorErrors, NameTheColumnsThatAreMissing)
{
  EXPECT_EQ(errorWith(grayTable('R', { 0.1 }), nullptr),
    "the estimate has no columns of estimated reflectance (E400, E410, ..); it has 31 other "
    "columns");
  EXPECT_EQ(errorWith(grayTable('E', { 0.1 }), nullptr),
    "the estimate's own table has no columns of measured reflectance (R400, R410, ..); it has 31 "
    "other "
    "columns");
  EXPECT_EQ(errorWith(grayTable('E', { 0.1 }), grayTable('E', { 0.1 })),
    "the reference has no columns of measured reflectance (R400, R410, ..); it has 31 other "
    "columns");
  EXPECT_EQ(errorWith(newTable({}), nullptr), "the estimate is empty; expected a table of samples");
}

TEST(CIEDE2000EvaluatorErrors, AskForWavelengths)
{
  EXPECT_EQ(errorWith(newImage(1, 1, ReflectanceArray, patternValues(3, 1)),
              newImage(1, 1, ReflectanceArray, patternValues(3, 1))),
    "the estimate has no wavelengths (field data 'Wavelength'); color difference needs reflectance "
    "whose "
    "wavelengths are known");
}

TEST(CIEDE2000EvaluatorErrors, NameWhatIsNotKnown)
{
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, grayImage({ 0.5 }));
  evaluator->SetInputData(1, grayImage({ 0.5 }));
  evaluator->SetIlluminants("D65, X1");
  EXPECT_NE(errorOf(evaluator).find("'X1'"), std::string::npos);
  evaluator->SetIlluminants("D65");
  evaluator->SetObserver("2006");
  EXPECT_NE(errorOf(evaluator).find("'2006'"), std::string::npos);
  evaluator->SetObserver("10");
  evaluator->SetReferenceArray("truth");
  EXPECT_EQ(errorOf(evaluator), "the reference has no point array 'truth'; it has 'Reflectance'");
}

TEST(CIEDE2000EvaluatorErrors, RefuseFactorsThatAreNotPositive)
{
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, grayImage({ 0.5 }));
  evaluator->SetInputData(1, grayImage({ 0.5 }));
  evaluator->SetKC(0.0);
  EXPECT_EQ(
    errorOf(evaluator), "the chroma factor of CIEDE2000 is 0; expected a finite value above zero");
}

TEST(CIEDE2000EvaluatorErrors, NameMetricsThatAreNotKnown)
{
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, grayImage({ 0.5 }));
  evaluator->SetInputData(1, grayImage({ 0.5 }));
  evaluator->SetMetrics("ciede2000, cam16");
  EXPECT_EQ(errorOf(evaluator),
    "there is no metric 'cam16'; expected some of rms, ciede2000, cie94, cie94-textiles, cmc, "
    "din99, "
    "cie76, hyab, mae, gfc, sam, metamerism");
  evaluator->SetMetrics("metamerism");
  evaluator->SetIlluminants("D65");
  EXPECT_EQ(errorOf(evaluator),
    "the metric metamerism compares illuminants, and there is 1; expected the reference illuminant "
    "and at least one other one, like D65, A");
}

TEST(CIEDE2000EvaluatorErrors, SayWhatIsWrongWithATableOfLamps)
{
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, grayImage({ 0.5 }));
  evaluator->SetInputData(1, grayImage({ 0.5 }));
  const auto errorWith = [&](vtkTable* lamps)
  {
    evaluator->SetInputData(2, lamps);
    return errorOf(evaluator);
  };
  const NamedColumn nm{ "wavelength", { 380.0, 500.0, 720.0 } };
  EXPECT_EQ(errorWith(newTable({ { "lamp", { 1.0 } } })),
    "the illuminants' table has no column of numbers 'wavelength'; expected the column "
    "'wavelength' "
    "(nm) and one column of numbers a curve");
  EXPECT_EQ(errorWith(newTable({ nm })),
    "the illuminants' table has no curve; expected the column 'wavelength' (nm) and one column of "
    "numbers a curve");
  EXPECT_EQ(errorWith(newTable({ nm, { "lamp", { 1.0, -0.5, 1.0 } } })),
    "illuminant 'lamp' has the power -0.5 at 500 nm; expected a finite value that is not negative");
  EXPECT_EQ(errorWith(newTable({ nm, { "lamp", { NaN, 0.5, 1.0 } } })),
    "the illuminants' table: the curve 'lamp' covers 500 to 720 nm; expected at least 400 to 700 "
    "nm, "
    "which color depends on; measure it farther");
  evaluator->SetIlluminants("lamps");
  const auto unknown = errorWith(newTable({ nm, { "lamp", { 1.0, 1.0, 1.0 } } }));
  EXPECT_NE(unknown.find("unknown illuminant 'lamps'"), std::string::npos) << unknown;
  EXPECT_NE(unknown.find("; illuminants of your own are 'lamp'"), std::string::npos) << unknown;
  evaluator->SetIlluminants("lamp");
  EXPECT_EQ(errorWith(newTable({ nm, { "lamp", { 1.0, 1.0, 1.0 } } })), "");
  evaluator->SetInputData(3, newTable({ nm, { "x", { 1.0, 1.0, 1.0 } } }));
  EXPECT_EQ(errorOf(evaluator),
    "the observer's table has 1 curve; expected three over the same wavelengths: x-bar, y-bar and "
    "z-bar, in this order");
}
}
