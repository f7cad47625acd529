#include "vtkCIEDE2000Evaluator.h"
#include "vtkErrorSummary.h"

#include "GraySpectra.h"
#include "Support/vtk/PieceSource.h"
#include "Support/vtk/Runs.h"
#include "TransformTable.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <limits>

namespace
{
using namespace msi;
using namespace msi::testing;

vtkImageData* errorsOf(vtkCIEDE2000Evaluator* evaluator)
{
  return vtkImageData::SafeDownCast(evaluator->GetOutputDataObject(0));
}

vtkTable* summaryOf(vtkCIEDE2000Evaluator* evaluator)
{
  return vtkTable::SafeDownCast(evaluator->GetOutputDataObject(1));
}

TEST(CIEDE2000Evaluator, MapsTheErrorsOfGrays)
{
  const std::vector<double> estimated = { 0.2, 0.5, 0.9, 0.3 };
  const std::vector<double> measured = { 0.25, 0.5, 0.8, 0.6 };
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, grayImage(estimated));
  evaluator->SetInputData(1, grayImage<vtkDoubleArray>(measured));
  ASSERT_EQ(errorOf(evaluator), "");
  const auto rms = valuesOf(errorsOf(evaluator), "rms");
  for (const char* name : { "dE00 D65", "dE00 F2" })
  {
    const auto difference = valuesOf(errorsOf(evaluator), name);
    ASSERT_EQ(difference.cols(), 4) << name;
    for (std::size_t i = 0; i < 4; ++i)
    {
      const auto pixel = static_cast<Eigen::Index>(i);
      EXPECT_NEAR(rms(0, pixel), std::abs(estimated[i] - measured[i]), 1e-7);
      EXPECT_NEAR(difference(0, pixel), grayDifference(estimated[i], measured[i]), 5e-4) << name;
    }
  }
  auto* points = errorsOf(evaluator)->GetPointData();
  EXPECT_NE(points->GetArray(ReflectanceArray), nullptr);
  EXPECT_STREQ(points->GetScalars()->GetName(), "dE00 F2");
}

TEST(CIEDE2000Evaluator, SummarizesTheImage)
{
  // Errors of 0.1, 0.2, .., 0.5 in reflectance and one pixel without reference.
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, grayImage({ 0.0, 0.25, 0.25, 0.5, 0.25, 0.25 }));
  evaluator->SetInputData(1, grayImage({ 0.5, 0.5, 0.375, 0.5, 0.0, NaN }));
  ASSERT_EQ(errorOf(evaluator), "");
  auto* summary = summaryOf(evaluator);
  ASSERT_EQ(summary->GetNumberOfRows(), 3);
  EXPECT_EQ(columnNames(summary),
    (std::vector<std::string>{
      "metric", "illuminant", "mean", "median", "p95", "max", "count", "left_out" }));
  EXPECT_EQ(textCell(summary, 0, "metric"), "rms");
  EXPECT_EQ(textCell(summary, 0, "illuminant"), "");
  EXPECT_EQ(textCell(summary, 2, "metric"), "dE00");
  EXPECT_EQ(textCell(summary, 2, "illuminant"), "F2");
  // 0, 0.125, 0.25, 0.25, 0.5; the 95th percentile lies at 0.8 between the last two.
  EXPECT_NEAR(cell(summary, 0, "mean"), 0.225, 1e-7);
  EXPECT_NEAR(cell(summary, 0, "median"), 0.25, 1e-7);
  EXPECT_NEAR(cell(summary, 0, "p95"), 0.45, 1e-7);
  EXPECT_NEAR(cell(summary, 0, "max"), 0.5, 1e-7);
  for (int row = 0; row < 3; ++row)
  {
    EXPECT_EQ(cell(summary, row, "count"), 5.0);
    EXPECT_EQ(cell(summary, row, "left_out"), 1.0);
  }
}

TEST(CIEDE2000Evaluator, KeepsANaNInItsPixel)
{
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, grayImage({ 0.5, NaN, 0.5, 0.5 }));
  evaluator->SetInputData(1, grayImage({ 0.4, 0.4, 0.4, NaN }));
  ASSERT_EQ(errorOf(evaluator), "");
  for (const char* name : { "rms", "dE00 D65", "dE00 F2" })
  {
    const auto errors = valuesOf(errorsOf(evaluator), name);
    EXPECT_TRUE(std::isnan(errors(0, 1)) && std::isnan(errors(0, 3))) << name;
    EXPECT_EQ(errors.array().isNaN().count(), 2) << name;
    EXPECT_EQ(errors(0, 0), errors(0, 2)) << name;
  }
}

TEST(CIEDE2000Evaluator, EvaluatesATableThatHasBoth)
{
  const std::vector<double> estimated = { 0.2, 0.5, NaN };
  const std::vector<double> measured = { 0.25, 0.4, 0.3 };
  vtkNew<vtkTable> table;
  addSpectra(table, 'R', GrayGrid, grays(measured));
  addSpectra(table, 'E', GrayGrid, grays(estimated));
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, table);
  evaluator->SetIlluminants("A");
  evaluator->SetKL(2.0);
  ASSERT_EQ(errorOf(evaluator), "");
  auto* output = vtkTable::SafeDownCast(evaluator->GetOutputDataObject(0));
  for (int row = 0; row < 2; ++row)
  {
    const auto i = static_cast<std::size_t>(row);
    EXPECT_NEAR(cell(output, row, "rms"), std::abs(estimated[i] - measured[i]), 1e-12);
    EXPECT_NEAR(cell(output, row, "dE00 A"), grayDifference(estimated[i], measured[i], 2.0), 1e-9);
  }
  EXPECT_TRUE(std::isnan(cell(output, 2, "dE00 A")));
  EXPECT_EQ(cell(summaryOf(evaluator), 1, "left_out"), 1.0);
  EXPECT_NEAR(cell(summaryOf(evaluator), 0, "max"), 0.1, 1e-12);
}

// Grays differ in lightness alone, and their spectra by a factor: each metric is known.
TEST(CIEDE2000Evaluator, ComputesTheMetricsAskedFor)
{
  const std::vector<double> estimated = { 0.2, 0.5, 0.9 };
  const std::vector<double> measured = { 0.25, 0.5, 0.8 };
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, grayImage(estimated));
  evaluator->SetInputData(1, grayImage(measured));
  evaluator->SetMetrics("cie76, cie94(2:1), mae gfc, sam, metamerism");
  evaluator->SetIlluminants("D65, TL84");
  ASSERT_EQ(errorOf(evaluator), "");
  const auto errors = [&](const char* name, Eigen::Index pixel)
  { return valuesOf(errorsOf(evaluator), name)(0, pixel); };
  for (std::size_t i = 0; i < 3; ++i)
  {
    const auto pixel = static_cast<Eigen::Index>(i);
    const double lightness = std::abs(lightnessOf(estimated[i]) - lightnessOf(measured[i]));
    for (const std::string illuminant : { "D65", "TL84" })
    {
      EXPECT_NEAR(errors(("dEab " + illuminant).c_str(), pixel), lightness, 5e-4);
      EXPECT_NEAR(errors(("dE94(2:1) " + illuminant).c_str(), pixel), lightness / 2.0, 5e-4);
    }
    EXPECT_NEAR(errors("mae", pixel), std::abs(estimated[i] - measured[i]), 1e-7);
    EXPECT_NEAR(errors("gfc", pixel), 1.0, 1e-7);
    EXPECT_NEAR(errors("sam", pixel), 0.0, 1e-7);
    EXPECT_NEAR(errors("metamerism TL84", pixel), 0.0, 1e-4);
  }
  auto* summary = summaryOf(evaluator);
  ASSERT_EQ(summary->GetNumberOfRows(), 9);
  EXPECT_EQ(textCell(summary, 1, "metric"), "mae");
  EXPECT_EQ(textCell(summary, 8, "metric"), "metamerism");
  EXPECT_EQ(textCell(summary, 8, "illuminant"), "TL84");
  // Error Summary knows all of them again.
  vtkNew<vtkErrorSummary> again;
  again->SetInputData(errorsOf(evaluator));
  ASSERT_EQ(errorOf(again), "");
  EXPECT_EQ(vtkTable::SafeDownCast(again->GetOutputDataObject(0))->GetNumberOfRows(), 9);
}

TEST(CIEDE2000Evaluator, TakesTheReferenceFromASecondTable)
{
  vtkNew<vtkTable> estimate;
  addSpectra(estimate, 'E', GrayGrid, grays({ 0.2, 0.5 }));
  vtkNew<vtkTable> reference;
  addSpectra(reference, 'R', GrayGrid, grays({ 0.3, 0.5 }));
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, estimate);
  evaluator->SetInputData(1, reference);
  ASSERT_EQ(errorOf(evaluator), "");
  auto* output = vtkTable::SafeDownCast(evaluator->GetOutputDataObject(0));
  EXPECT_NEAR(cell(output, 0, "rms"), 0.1, 1e-12);
  EXPECT_NEAR(cell(output, 1, "dE00 D65"), 0.0, 1e-12);
}

TEST(CIEDE2000Evaluator, TakesListsNameByName)
{
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, grayImage({ 0.5 }));
  evaluator->SetInputData(1, grayImage({ 0.4 }));
  evaluator->SetInputData(
    2, newTable({ { "wavelength", { 380.0, 720.0 } }, { "gallery left", { 1.0, 1.0 } } }));
  evaluator->ClearIlluminants();
  evaluator->AddIlluminant("gallery left");
  evaluator->AddIlluminant("A");
  evaluator->SetOtherIlluminants("3200 K");
  evaluator->ClearMetrics();
  evaluator->AddMetric("cie76");
  ASSERT_EQ(errorOf(evaluator), "");
  auto* points = vtkImageData::SafeDownCast(evaluator->GetOutputDataObject(0))->GetPointData();
  for (const char* name : { "rms", "dEab gallery left", "dEab A", "dEab 3200 K" })
  {
    EXPECT_TRUE(points->HasArray(name)) << name;
  }
}

TEST(CIEDE2000Evaluator, GivesOnlyRmsWithoutIlluminants)
{
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, grayImage({ 0.5 }));
  evaluator->SetInputData(1, grayImage({ 0.25 }));
  evaluator->SetIlluminants("");
  ASSERT_EQ(errorOf(evaluator), "");
  EXPECT_EQ(summaryOf(evaluator)->GetNumberOfRows(), 1);
  EXPECT_STREQ(errorsOf(evaluator)->GetPointData()->GetScalars()->GetName(), "rms");
}

// Responses of one channel per gray: reflectance at every wavelength is twice the response less a tenth.
class EvaluatorOfResponses : public ::testing::Test
{
protected:
  static constexpr double Gain = 2.0;
  static constexpr double Offset = -0.1;

  EvaluatorOfResponses()
  {
    Eigen::MatrixXd coefficients(GrayGrid.size(), 3);
    coefficients.leftCols(2).setConstant(0.5 * Gain);
    coefficients.col(2).setConstant(Offset);
    vtkNew<vtkTable> transform;
    write(
      ReflectanceTransform{ axisOf(GrayGrid), Channels, AffineTransform(coefficients) }, transform);
    Eigen::MatrixXd responses(2, static_cast<Eigen::Index>(Estimated.size()));
    for (std::size_t i = 0; i < Estimated.size(); ++i)
    {
      responses.col(static_cast<Eigen::Index>(i)).setConstant((Estimated[i] - Offset) / Gain);
    }
    const int width = static_cast<int>(Estimated.size());
    Evaluator->SetInputData(0, newImage(width, 1, "Responses", responses, *Channels.wavelengths));
    Evaluator->SetInputData(1, grayImage(Measured));
    Evaluator->SetInputData(4, transform);
  }

  const SpectralAxis Channels = axisOf(WavelengthGrid({ 500.0, 600.0 }));
  const std::vector<double> Estimated = { 0.2, 0.5, 0.9, NaN, 0.3 };
  const std::vector<double> Measured = { 0.25, 0.5, 0.8, 0.5, NaN };
  vtkNew<vtkCIEDE2000Evaluator> Evaluator;
};

TEST_F(EvaluatorOfResponses, GivesTheErrorsOfTheirReflectance)
{
  for (const bool rms : { true, false }) // by blocks of reflectance, and by one matrix
  {
    Evaluator->SetSpectralRms(rms);
    ASSERT_EQ(errorOf(Evaluator), "");
    auto* data = errorsOf(Evaluator)->GetPointData();
    EXPECT_EQ(data->HasArray("rms") != 0, rms);
    EXPECT_FALSE(data->HasArray(ReflectanceArray));
    for (const char* name : { "dE00 D65", "dE00 F2" })
    {
      const auto errors = valuesOf(errorsOf(Evaluator), name);
      for (std::size_t i = 0; i < 3; ++i)
      {
        EXPECT_NEAR(
          errors(0, static_cast<Eigen::Index>(i)), grayDifference(Estimated[i], Measured[i]), 1e-3)
          << name << i << rms;
      }
      EXPECT_TRUE(errors.rightCols(2).array().isNaN().all());
    }
    if (rms)
    {
      EXPECT_NEAR(valuesOf(errorsOf(Evaluator), "rms")(0, 0), 0.05, 1e-6);
    }
    EXPECT_EQ(summaryOf(Evaluator)->GetNumberOfRows(), rms ? 3 : 2);
  }
}

TEST_F(EvaluatorOfResponses, RefusesOtherChannelsAndNothingToDo)
{
  Evaluator->SetSpectralRms(false);
  Evaluator->SetIlluminants("");
  EXPECT_EQ(
    errorOf(Evaluator), "no error is asked for; expected rms, or a metric and an illuminant");
  Evaluator->SetIlluminants("D65");
  Evaluator->SetInputData(0, grayImage(Estimated));
  EXPECT_NE(errorOf(Evaluator).find("the reflectance transform has 2"), std::string::npos);
}

TEST(CIEDE2000Evaluator, EvaluatesATableOfResponses)
{
  vtkNew<vtkTable> transform;
  Eigen::MatrixXd coefficients = Eigen::MatrixXd::Ones(GrayGrid.size(), 2);
  coefficients.col(1).setConstant(0.1);
  const auto channel = WavelengthGrid({ 550.0 });
  write(ReflectanceTransform{ axisOf(GrayGrid), axisOf(channel), AffineTransform(coefficients) },
    transform);
  vtkNew<vtkTable> table;
  addSpectra(table, 'R', GrayGrid, grays({ 0.25, 0.4 }));
  addSpectra(table, 'C', channel, Eigen::RowVector2d(0.1, 0.4));
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetInputData(0, table);
  evaluator->SetInputData(4, transform);
  ASSERT_EQ(errorOf(evaluator), "");
  auto* output = vtkTable::SafeDownCast(evaluator->GetOutputDataObject(0));
  EXPECT_NEAR(cell(output, 0, "rms"), 0.05, 1e-12);
  EXPECT_NEAR(cell(output, 1, "dE00 D65"), grayDifference(0.5, 0.4), 1e-9);
}

class EvaluatorOfALargeImage : public ::testing::Test
{
protected:
  static constexpr int Size = 300;

  EvaluatorOfALargeImage()
  {
    const WavelengthGrid grid({ 420.0, 540.0, 660.0 });
    const Eigen::MatrixXd values = patternValues(grid.size(), Size * Size);
    Sources[0]->SetImage(newImage(Size, Size, ReflectanceArray, values, grid));
    Sources[1]->SetImage(newImage(Size, Size, ReflectanceArray, values.rowwise().reverse(), grid));
    for (int port = 0; port < 2; ++port)
    {
      Evaluator->SetInputConnection(port, Sources[port]->GetOutputPort());
    }
  }
  vtkNew<PieceSource> Sources[2];
  vtkNew<vtkCIEDE2000Evaluator> Evaluator;
};

TEST_F(EvaluatorOfALargeImage, HasTheSameBytesInThreads)
{
  expectSameBytesInThreads(Evaluator);
}

TEST_F(EvaluatorOfALargeImage, HasTheSameBytesInPieces)
{
  expectSameBytesInPieces(Evaluator, 3);
}

TEST_F(EvaluatorOfALargeImage, CanBeStopped)
{
  EXPECT_EQ(errorWhenStopped(Evaluator), "stopped by the user");
}

TEST(CIEDE2000Evaluator, PrintsItself)
{
  vtkNew<vtkCIEDE2000Evaluator> evaluator;
  evaluator->SetIlluminants("D50");
  evaluator->SetEstimateArray("estimate");
  evaluator->SetReferenceArray("truth");
  evaluator->SetKL(2.0);
  const auto text = printed(evaluator);
  for (const char* line : { "Illuminants: D50\n", "Observer: CIE 1931 2 degree\n",
         "EstimateArray: estimate\n", "ReferenceArray: truth\n", "KL: 2\n", "KC: 1\n", "KH: 1\n" })
  {
    EXPECT_NE(text.find(line), std::string::npos) << line;
  }
}
}
