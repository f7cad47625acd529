#include "vtkMethodComparison.h"

#include "ExpectedSamples.h"
#include "Support/vtk/Runs.h"
#include "Support/vtk/Tables.h"

#include "vtkNew.h"

#include "Kernels/Estimation/CrossedErrors.h"
#include "Kernels/Estimation/MethodComparison.h"

#include <gtest/gtest.h>

#include <cmath>

namespace
{
using namespace msi;
using namespace msi::testing;
using msi::test::randomMatrix;

// Smooth spectra, and responses that see another share of them on the target.
SampleSet sensedSamples(Eigen::Index count, unsigned seed, double gain)
{
  const Eigen::MatrixXd basis = randomMatrix(31, 5, 7).cwiseAbs() / 10.0;
  const Eigen::MatrixXd reflectance = basis * randomMatrix(5, count, seed).cwiseAbs();
  const Eigen::MatrixXd sensitivities = randomMatrix(4, 31, 9).cwiseAbs() / 31.0;
  return { reflectance, gain * sensitivities * reflectance };
}

TEST(MethodComparisonTables, HoldTheErrorsOfTheDraws)
{
  const SampleSet chart = sensedSamples(40, 1, 1.0);
  const SampleSet target = sensedSamples(24, 2, 1.1);
  vtkNew<vtkMethodComparison> filter;
  filter->SetInputData(0, tableOf(chart));
  filter->SetInputData(1, tableOf(target));
  filter->SetMethods("direct, pooled");
  filter->SetTuningSamples("8");
  filter->SetCurveSamples("4, 8, 12");
  filter->SetCurveDraws(2);
  filter->SetDraws(3);
  ASSERT_EQ(errorOf(filter), "");

  // The same draws by the kernel.
  ComparisonOptions options;
  options.methods = { "direct", "pooled" };
  options.tuningSamples = 8;
  options.channelWavelengths = channelsOf(target);
  const MethodComparison comparison(chart, target, options);
  Eigen::MatrixXd direct = Eigen::MatrixXd::Constant(3, 24, std::nan(""));
  Eigen::MatrixXd pooled = direct;
  for (Eigen::Index draw = 0; draw < 3; ++draw)
  {
    const auto run = comparison.run(static_cast<std::uint64_t>(draw));
    direct.row(draw)(run.heldOut) = run.estimates[0].rms.transpose();
    pooled.row(draw)(run.heldOut) = run.estimates[1].rms.transpose();
  }

  auto* curves = tableAt(filter, 3);
  ASSERT_EQ(curves->GetNumberOfRows(), 3);
  for (vtkIdType row = 0; row < 3; ++row)
  {
    EXPECT_EQ(cell(curves, row, "tuning"), 4.0 * static_cast<double>(row + 1));
    EXPECT_EQ(cell(curves, row, "draws"), row == 1 ? 3.0 : 2.0);
  }
  const ErrorInterval mean = meanError(direct);
  EXPECT_EQ(cell(curves, 1, "direct"), mean.value);
  EXPECT_EQ(cell(curves, 1, "direct low"), mean.low);
  EXPECT_EQ(cell(curves, 1, "direct high"), mean.high);
  EXPECT_NEAR(cell(tableAt(filter, 0), 0, "mean"), mean.value, 1e-15);
  EXPECT_NEAR(cell(curves, 0, "own-medium"), comparison.ownMedium().rms.mean(), 1e-15);

  auto* samples = tableAt(filter, 4);
  ASSERT_EQ(samples->GetNumberOfRows(), 24);
  for (vtkIdType row = 0; row < 24; ++row)
  {
    double sum = 0.0;
    double count = 0.0;
    for (Eigen::Index draw = 0; draw < 3; ++draw)
    {
      if (!std::isnan(pooled(draw, row)))
      {
        sum += pooled(draw, row);
        count += 1.0;
      }
    }
    EXPECT_EQ(cell(samples, row, "held out"), count);
    if (count > 0.0)
    {
      EXPECT_NEAR(cell(samples, row, "pooled rms"), sum / count, 1e-15);
    }
  }

  auto* pairs = tableAt(filter, 5);
  ASSERT_EQ(pairs->GetNumberOfRows(), 6); // two orders, rms and two color differences
  const PairedErrors pair = compareErrors(direct, pooled);
  EXPECT_EQ(textCell(pairs, 0, "method"), "direct");
  EXPECT_EQ(textCell(pairs, 0, "against"), "pooled");
  EXPECT_EQ(cell(pairs, 0, "ratio"), pair.ratio.value);
  EXPECT_EQ(cell(pairs, 0, "low"), pair.ratio.low);
  EXPECT_EQ(cell(pairs, 0, "high"), pair.ratio.high);
  EXPECT_EQ(cell(pairs, 0, "wins"), pair.wins);
  EXPECT_NEAR(cell(pairs, 3, "ratio") * pair.ratio.value, 1.0, 1e-12);
  EXPECT_EQ(textCell(pairs, 0, "better"), textCell(pairs, 3, "better"));
}
}
