#include "vtkImageSimToRealGap.h"

#include "Support/vtk/Images.h"
#include "Support/vtk/Runs.h"

#include "vtkNew.h"
#include "vtkTable.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace msi;
using namespace msi::testing;

const WavelengthGrid Grid({ 450.0, 550.0 });
constexpr int Width = 96;
constexpr int Height = 80;

// Waves of two directions, other ones in each channel.
Eigen::MatrixXd scene()
{
  return Eigen::MatrixXd::NullaryExpr(2, Width * Height,
    [](Eigen::Index k, Eigen::Index pixel)
    {
      const double x = static_cast<double>(pixel % Width);
      const double y = static_cast<double>(pixel / Width);
      return 0.4 + 0.1 * std::sin(0.31 * x + 0.17 * y + static_cast<double>(k)) +
        0.08 * std::cos(0.23 * y - 0.09 * x * static_cast<double>(k + 1));
    });
}

// The scene under a plane of light, with a deterministic scatter of 0.002.
Eigen::MatrixXd lit(double right, double down)
{
  Eigen::MatrixXd values = scene();
  const Eigen::MatrixXd scatter = patternValues(2, Width * Height);
  for (Eigen::Index pixel = 0; pixel < values.cols(); ++pixel)
  {
    const double half = 0.5 * (Width - 1);
    const double x = (static_cast<double>(pixel % Width) - 0.5 * (Width - 1)) / half;
    const double y = (static_cast<double>(pixel / Width) - 0.5 * (Height - 1)) / half;
    values.col(pixel) *= 1.0 + right * x + down * y;
    values.col(pixel) += (scatter.col(pixel).array() - 0.5).matrix() * 0.007;
  }
  return values;
}

vtkSmartPointer<vtkImageData> image(const Eigen::MatrixXd& values)
{
  return newImage(Width, Height, ResponsesArray, values, Grid);
}

std::string text(vtkAlgorithm* algorithm, int port, vtkIdType row, const char* column)
{
  auto* table = vtkTable::SafeDownCast(algorithm->GetOutputDataObject(port));
  return table->GetValueByName(row, column).ToString();
}
double number(vtkAlgorithm* algorithm, int port, vtkIdType row, const char* column)
{
  auto* table = vtkTable::SafeDownCast(algorithm->GetOutputDataObject(port));
  return table->GetValueByName(row, column).ToDouble();
}

TEST(ImageSimToRealGap, FindsThePlaneOfLight)
{
  vtkNew<vtkImageSimToRealGap> filter;
  filter->SetInputData(0, image(lit(0.06, -0.04)));
  filter->SetInputData(1, image(scene()));
  ASSERT_EQ(errorOf(filter), "");
  EXPECT_EQ(text(filter, vtkImageSimToRealGap::SUMMARY, 0, "verdict"), "explained");
  EXPECT_EQ(text(filter, vtkImageSimToRealGap::WHERE, 0, "axis"), "position");
  EXPECT_EQ(text(filter, vtkImageSimToRealGap::CAUSES, 0, "effect"), "illumination_gradient");
  EXPECT_EQ(text(filter, vtkImageSimToRealGap::CAUSES, 0, "parameter"), "along_x");
  EXPECT_NEAR(number(filter, vtkImageSimToRealGap::CAUSES, 0, "value"), 0.06, 0.002);
  EXPECT_NEAR(number(filter, vtkImageSimToRealGap::CAUSES, 1, "value"), -0.04, 0.002);
  auto* summary =
    vtkTable::SafeDownCast(filter->GetOutputDataObject(vtkImageSimToRealGap::SUMMARY));
  EXPECT_NE(summary->GetFieldData()->GetAbstractArray("Report"), nullptr);
  EXPECT_NE(
    summary->GetFieldData()->GetAbstractArray("Effects")->GetVariantValue(0).ToString().find(
      "illumination_gradient"),
    std::string::npos);
}

TEST(ImageSimToRealGap, MapsAreRealMinusSimulatedAndMinusCorrected)
{
  vtkNew<vtkImageSimToRealGap> filter;
  const auto real = image(lit(0.06, -0.04));
  const auto simulated = image(scene());
  filter->SetInputData(0, real);
  filter->SetInputData(1, simulated);
  ASSERT_EQ(errorOf(filter), "");
  auto* output = vtkImageData::SafeDownCast(filter->GetOutputDataObject(0));
  const Eigen::MatrixXd gap = valuesOf(output, "Gap");
  const Eigen::MatrixXd after = valuesOf(output, "GapAfter");
  const Eigen::MatrixXd corrected = valuesOf(output, "Corrected");
  const Eigen::MatrixXd measured = valuesOf(real, ResponsesArray);
  EXPECT_LT((gap - (measured - valuesOf(simulated, ResponsesArray))).cwiseAbs().maxCoeff(), 1e-6);
  EXPECT_LT((after - (measured - corrected)).cwiseAbs().maxCoeff(), 1e-6);
  // Only the scatter is left.
  EXPECT_LT(after.cwiseAbs().maxCoeff(), 0.007);
  EXPECT_GT(gap.cwiseAbs().maxCoeff(), 0.02);
}

TEST(ImageSimToRealGap, SameBytesInThreads)
{
  vtkNew<vtkImageSimToRealGap> filter;
  filter->SetInputData(0, image(lit(0.03, 0.01)));
  filter->SetInputData(1, image(scene()));
  expectSameBytesInThreads(filter);
}

TEST(ImageSimToRealGap, SaysWhatDoesNotFit)
{
  vtkNew<vtkImageSimToRealGap> filter;
  filter->SetInputData(0, image(scene()));
  filter->SetInputData(1, newImage(4, 4, ResponsesArray, patternValues(2, 16), Grid));
  EXPECT_NE(errorOf(filter).find("the simulated image"), std::string::npos);
  filter->SetInputData(
    1, newImage(Width, Height, ResponsesArray, patternValues(3, Width * Height)));
  EXPECT_NE(errorOf(filter).find("3 channels"), std::string::npos);
  filter->SetInputData(1,
    image(Eigen::MatrixXd::Constant(2, Width * Height, std::numeric_limits<double>::quiet_NaN())));
  EXPECT_NE(
    errorOf(filter).find("the images share 0 blocks of 4 x 4 usable pixels; expected at least 15"),
    std::string::npos);
  filter->SetInputData(1, image(scene()));
  filter->AddWithout("gremlins");
  EXPECT_NE(errorOf(filter).find("there is no effect 'gremlins' to leave out"), std::string::npos);
}

TEST(ImageSimToRealGap, StopsWhenAsked)
{
  vtkNew<vtkImageSimToRealGap> filter;
  filter->SetInputData(0, image(lit(0.03, 0.01)));
  filter->SetInputData(1, image(scene()));
  EXPECT_NE(errorWhenStopped(filter).find("stopped by the user"), std::string::npos);
}
}
