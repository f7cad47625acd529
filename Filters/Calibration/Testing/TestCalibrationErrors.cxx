#include "vtkMetamerismCorrection.h"
#include "vtkReflectanceCalibration.h"
#include "vtkReflectanceEstimation.h"

#include "ExpectedSamples.h"
#include "Support/vtk/Runs.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

namespace
{
using namespace msi;
using namespace msi::testing;
using msi::test::ExpectedEstimation;

std::string correctionError(vtkTable* calibration, vtkTable* tuning)
{
  vtkNew<vtkMetamerismCorrection> fit;
  fit->SetInputData(0, calibration);
  fit->SetInputData(1, tuning);
  return errorOf(fit);
}

TEST(CalibrationErrors, NameTheColumnsThatAreMissing)
{
  const ExpectedEstimation expected(0);
  auto responsesOnly = vtkSmartPointer<vtkTable>::New();
  addSpectra(responsesOnly, 'C', channelsOf(expected.tuning()), expected.tuning().response);
  vtkNew<vtkReflectanceCalibration> fit;
  fit->SetInputData(0, responsesOnly);
  EXPECT_EQ(errorOf(fit),
    "the calibration table has no columns of measured reflectance (R400, R410, ..); it has 5 other "
    "columns");
  EXPECT_EQ(correctionError(tableOf(expected.calibration()), responsesOnly),
    "the tuning table has no columns of measured reflectance (R400, R410, ..); it has 5 other "
    "columns");
}

TEST(CalibrationErrors, NameTheChannelsAndBandsThatDiffer)
{
  const ExpectedEstimation expected(0);
  const auto tuning = expected.tuning();
  EXPECT_EQ(correctionError(tableOf(expected.calibration()), tableOf(tuning, 30)),
    "the calibration table has 5 channels (400, 420, .., 480 nm), but the tuning table has 5 "
    "channels (400, 430, .., 520 nm); both must come from the same camera with the same channels");
  const SampleSet fewerBands{ tuning.reflectance.topRows(6), tuning.response };
  const auto error = correctionError(tableOf(expected.calibration()), tableOf(fewerBands));
  EXPECT_NE(error.find("8 bands (400, 410, .., 470 nm)"), std::string::npos) << error;
  EXPECT_NE(error.find("6 bands (400, 410, .., 450 nm)"), std::string::npos) << error;
}

TEST(CalibrationErrors, TellTheTransformsApart)
{
  const ExpectedEstimation expected(0);
  vtkNew<vtkMetamerismCorrection> fit;
  fit->SetInputData(0, tableOf(expected.calibration()));
  fit->SetInputData(1, tableOf(expected.tuning()));
  fit->SetMethod(vtkMetamerismCorrection::BANDED);
  vtkNew<vtkReflectanceEstimation> estimation;
  estimation->SetInputData(0, tableOf(expected.tuning()));
  estimation->SetInputConnection(1, fit->GetOutputPort(1));
  EXPECT_EQ(errorOf(estimation),
    "the reflectance transform is a metamerism transform; connect it as Metamerism Transform "
    "instead");
  estimation->SetInputConnection(1, fit->GetOutputPort(0));
  estimation->SetInputConnection(2, fit->GetOutputPort(0));
  EXPECT_EQ(
    errorOf(estimation), "the metamerism transform has no column 'channel'; it is something else");
  estimation->SetInputConnection(2, fit->GetOutputPort(1));
  EXPECT_EQ(errorOf(estimation), "");
}

TEST(CalibrationErrors, RefuseValuesThatAreNotFinite)
{
  const ExpectedEstimation expected(0);
  auto chart = expected.calibration();
  chart.response(1, 3) = std::nan("");
  vtkNew<vtkReflectanceCalibration> fit;
  fit->SetInputData(0, tableOf(chart));
  const auto error = errorOf(fit);
  EXPECT_NE(error.find("finite"), std::string::npos) << error;
}
}
