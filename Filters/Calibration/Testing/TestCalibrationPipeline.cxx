#include "vtkMetamerismCorrection.h"
#include "vtkReflectanceCalibration.h"
#include "vtkReflectanceEstimation.h"

#include "ExpectedSamples.h"
#include "Support/vtk/Runs.h"

#include "vtkNew.h"

#include <gtest/gtest.h>

#include <string>
#include <utility>

namespace
{
using namespace msi;
using namespace msi::testing;
using msi::test::ExpectedEstimation;
using msi::test::largestDifference;

struct NamedMethod
{
  vtkMetamerismCorrection::MethodType method;
  const char* expected;
};
constexpr NamedMethod LinearMethods[] = { { vtkMetamerismCorrection::DIRECT, "direct" },
  { vtkMetamerismCorrection::PINV, "pinv" }, { vtkMetamerismCorrection::POOLED, "pooled" },
  { vtkMetamerismCorrection::R_MODEL, "r_model" }, { vtkMetamerismCorrection::BANDED, "banded" } };

Eigen::MatrixXd estimateOf(vtkAlgorithm* fit, bool withMetamerism, const SampleSet& samples)
{
  vtkNew<vtkReflectanceEstimation> estimation;
  estimation->SetInputData(0, tableOf(samples));
  estimation->SetInputConnection(1, fit->GetOutputPort(0));
  if (withMetamerism)
  {
    estimation->SetInputConnection(2, fit->GetOutputPort(1));
  }
  EXPECT_EQ(errorOf(estimation), "");
  return spectraOf(tableAt(estimation, 0), 'E', bandsOf(samples));
}

TEST(CalibrationPipeline, EveryMethodEstimatesWhatNumPyDoes)
{
  for (const int problem : { 0, 1 })
  {
    const ExpectedEstimation expected(problem);
    const auto tuning = expected.tuning();
    for (const auto& [method, name] : LinearMethods)
    {
      vtkNew<vtkMetamerismCorrection> fit;
      fit->SetInputData(0, tableOf(expected.calibration()));
      fit->SetInputData(1, tableOf(tuning));
      fit->SetMethod(method);
      fit->SetStructure(expected["neighbours"](0, 0) > 0.5 ? vtkMetamerismCorrection::TRIDIAGONAL
                                                           : vtkMetamerismCorrection::DIAGONAL);
      ASSERT_EQ(errorOf(fit), "") << name;
      EXPECT_LT(largestDifference(
                  estimateOf(fit, true, tuning), estimated(expected[name], tuning.response)),
        1e-9)
        << name << ", problem " << problem;
      EXPECT_EQ(tableAt(fit, 2)->GetNumberOfRows() > 0, true) << name;
      EXPECT_EQ(
        tableAt(fit, 3)->GetNumberOfRows(), method == vtkMetamerismCorrection::BANDED ? 2 : 0);
    }
  }
}

TEST(CalibrationPipeline, TellsAConditionNumberWhereThereIsOne)
{
  const ExpectedEstimation expected(0);
  for (const auto& [method, has] : { std::pair(vtkMetamerismCorrection::POOLED, true),
         std::pair(vtkMetamerismCorrection::TRANSFER, false) })
  {
    vtkNew<vtkMetamerismCorrection> fit;
    fit->SetInputData(0, tableOf(expected.calibration()));
    fit->SetInputData(1, tableOf(expected.tuning()));
    fit->SetMethod(method);
    ASSERT_EQ(errorOf(fit), "");
    EXPECT_EQ(tableAt(fit, 2)->GetColumnByName("condition") != nullptr, has);
  }
}

TEST(CalibrationPipeline, CalibrationAloneIsTheDirectMethod)
{
  const ExpectedEstimation expected(0);
  vtkNew<vtkReflectanceCalibration> fit;
  fit->SetInputData(0, tableOf(expected.calibration()));
  ASSERT_EQ(errorOf(fit), "");
  EXPECT_LT(largestDifference(estimateOf(fit, false, expected.tuning()),
              estimated(expected["direct"], expected.tuning().response)),
    1e-9);
}

TEST(CalibrationPipeline, AutomaticStructureFollowsTheChannels)
{
  // 20 nm apart: tridiagonal; 40 nm apart: diagonal.
  const ExpectedEstimation tridiagonal(0);
  const ExpectedEstimation diagonal(1);
  ASSERT_GT(tridiagonal["neighbours"](0, 0), 0.5);
  ASSERT_LT(diagonal["neighbours"](0, 0), 0.5);
  for (const auto* expected : { &tridiagonal, &diagonal })
  {
    const double step = expected == &tridiagonal ? 20 : 40;
    const auto tuning = expected->tuning();
    vtkNew<vtkMetamerismCorrection> fit;
    fit->SetInputData(0, tableOf(expected->calibration(), step));
    fit->SetInputData(1, tableOf(tuning, step));
    fit->SetMethod(vtkMetamerismCorrection::BANDED);
    vtkNew<vtkReflectanceEstimation> estimation;
    estimation->SetInputData(0, tableOf(tuning, step));
    estimation->SetInputConnection(1, fit->GetOutputPort(0));
    estimation->SetInputConnection(2, fit->GetOutputPort(1));
    ASSERT_EQ(errorOf(estimation), "");
    EXPECT_LT(largestDifference(spectraOf(tableAt(estimation, 0), 'E', bandsOf(tuning)),
                estimated((*expected)["banded"], tuning.response)),
      1e-9)
      << step;
  }
}

TEST(CalibrationPipeline, TransferGivesUncertaintyForTables)
{
  const ExpectedEstimation expected(0);
  const auto tuning = expected.tuning();
  vtkNew<vtkMetamerismCorrection> fit;
  fit->SetInputData(0, tableOf(expected.calibration()));
  fit->SetInputData(1, tableOf(tuning));
  ASSERT_EQ(fit->GetMethod(), vtkMetamerismCorrection::TRANSFER);
  vtkNew<vtkReflectanceEstimation> estimation;
  estimation->SetInputData(0, tableOf(tuning));
  estimation->SetInputConnection(1, fit->GetOutputPort(0));
  ASSERT_EQ(errorOf(estimation), "");
  const auto uncertainty = spectraOf(tableAt(estimation, 0), 'U', bandsOf(tuning));
  EXPECT_GT(uncertainty.minCoeff(), 0.0);
  EXPECT_LT(uncertainty.maxCoeff(), 10.0);
  estimation->SetUncertainty(1);
  ASSERT_EQ(errorOf(estimation), "");
  EXPECT_EQ(tableAt(estimation, 0)->GetColumnByName("U400"), nullptr);
  EXPECT_NE(tableAt(estimation, 0)->GetColumnByName("E400"), nullptr);
}

TEST(CalibrationPipeline, TooFewTuningSamplesAreSaid)
{
  // A row of the tridiagonal D has four unknowns, one of the diagonal D has two.
  const ExpectedEstimation expected(0);
  vtkNew<vtkMetamerismCorrection> fit;
  fit->SetInputData(0, tableOf(expected.calibration()));
  fit->SetInputData(1, tableOf(expected.tuning().subset({ 0, 1, 2 })));
  fit->SetMethod(vtkMetamerismCorrection::BANDED);
  fit->SetStructure(vtkMetamerismCorrection::TRIDIAGONAL);
  EXPECT_EQ(errorOf(fit),
    "there are 3 tuning samples for 4 unknowns a channel of the tridiagonal metamerism transform; "
    "expected at least 4 samples");
  fit->SetStructure(vtkMetamerismCorrection::AUTOMATIC);
  MessageLog log(fit);
  fit->Update();
  EXPECT_EQ(log.firstError(), "");
  EXPECT_EQ(log.firstWarning(),
    "banded: diagonal transform after 2 rounds; diagonal because a tridiagonal one needs 4 tuning "
    "samples and there are 3");
  EXPECT_GT(tableAt(fit, 0)->GetNumberOfRows(), 0);
}

TEST(CalibrationPipeline, ThreadsGiveTheSameBytes)
{
  const ExpectedEstimation expected(0);
  vtkNew<vtkMetamerismCorrection> fit;
  fit->SetInputData(0, tableOf(expected.calibration()));
  fit->SetInputData(1, tableOf(expected.tuning()));
  expectSameBytesInThreads(fit);
}
}
