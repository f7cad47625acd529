#include "Kernels/Estimation/Methods/Methods.h"

#include "Kernels/Estimation/CrossValidation.h"
#include "Kernels/Estimation/KernelEstimator.h"
#include "Kernels/Estimation/KernelSystem.h"
#include "Kernels/Estimation/LocalChoice.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace msi
{

namespace
{
struct KernelCandidate
{
  RegressionKernel kernel = RegressionKernel::Gaussian;
  double length = 1.0; // in units of sqrt(K) standard deviations
  double penalty = 0.0;
  double tuningWeight = 1.0;
};

// Memory grows with the square of the samples, time with the cube and hundreds of candidates: 1000 take about a minute.
constexpr Eigen::Index MostChartSamples = 500;

// Of a larger chart as many samples, spread evenly over it.
SampleSet spreadOver(const SampleSet& chart)
{
  if (chart.size() <= MostChartSamples)
  {
    return chart;
  }
  std::vector<Eigen::Index> kept;
  for (Eigen::Index i = 0; i < MostChartSamples; ++i)
  {
    kept.push_back(i * chart.size() / MostChartSamples);
  }
  return chart.subset(kept);
}

EstimationFit fitKernelRidge(
  const SampleSet& chart, const SampleSet& tuning, const EstimationOptions& /*options*/)
{
  requireTrainingSamples(chart, tuning);
  const SampleSet calibration = spreadOver(chart);
  const SampleSet samples = joined(calibration, tuning);
  const LocalSamples scaled = localSamples(samples);
  const Eigen::VectorXd center = scaled.points.rowwise().mean();
  const Eigen::MatrixXd outputs = samples.reflectance.transpose();
  const auto root = std::sqrt(static_cast<double>(samples.channels()));
  const auto points = [&](double length) -> Eigen::MatrixXd
  { return (scaled.points.colwise() - center) / (length * root); };
  const auto solve = [&](const KernelCandidate& candidate, const Eigen::MatrixXd& gram)
  {
    return solveKernelSystem(gram, outputs,
      joinedWeights(calibration.size(), tuning.size(), candidate.tuningWeight), candidate.penalty);
  };

  CandidateChoice choice;
  choice.leftOutRms = std::numeric_limits<double>::quiet_NaN();
  KernelCandidate best{ RegressionKernel::Gaussian, 4.0, 1e-4, 1.0 };
  if (tuning.size() >= FewestToChoose)
  {
    double least = std::numeric_limits<double>::infinity();
    for (const RegressionKernel kernel :
      { RegressionKernel::Gaussian, RegressionKernel::Logarithmic })
    {
      for (const double length : { 1.0, 2.0, 4.0, 8.0 })
      {
        const Eigen::MatrixXd gram = kernelMatrix(kernel, points(length), points(length));
        for (const double penalty : { 1e-3, 1e-4, 1e-5, 1e-6, 1e-7 })
        {
          for (const double weight : tuningWeights(calibration, tuning))
          {
            const KernelCandidate candidate{ kernel, length, penalty, weight };
            const double squares =
              solve(candidate, gram).leftOutError.bottomRows(tuning.size()).squaredNorm();
            if (squares < least)
            {
              least = squares;
              best = candidate;
            }
          }
        }
      }
    }
    choice.leftOutRms = std::sqrt(least / static_cast<double>(tuning.reflectance.size()));
    choice.chosen = true;
  }

  const Eigen::MatrixXd at = points(best.length);
  const KernelSolution solution = solve(best, kernelMatrix(best.kernel, at, at));
  Eigen::VectorXd constant = solution.constant;
  if (best.kernel == RegressionKernel::Logarithmic)
  {
    const Eigen::RowVectorXd fromOrigin =
      at.colwise().squaredNorm().unaryExpr([](double d) { return std::log1p(d); });
    constant += (fromOrigin * solution.coefficients).transpose();
  }
  Eigen::MatrixXd channels(samples.channels(), 2);
  channels << scaled.scale / (best.length * root), center / (best.length * root);
  EstimationFit result;
  result.estimator = std::make_shared<KernelEstimator>(NamedMatrices{
    { "kernel.kind",
      Eigen::MatrixXd::Constant(1, 1, best.kernel == RegressionKernel::Gaussian ? 0.0 : 1.0) },
    { "kernel.channels", channels }, { "kernel.points", at },
    { "kernel.coefficients", solution.coefficients }, { "kernel.constant", constant } });
  std::ostringstream status;
  status.precision(3);
  status << (best.kernel == RegressionKernel::Gaussian ? "Gaussian" : "logarithmic")
         << " kernel of length " << best.length << ", penalty " << best.penalty
         << ", tuning weight " << best.tuningWeight << ", " << choiceText(choice, tuning);
  if (calibration.size() < chart.size())
  {
    status << ", from " << calibration.size() << " of " << chart.size() << " chart samples";
  }
  result.summary = summaryOfChoice(choice, calibration, tuning, status.str());
  return result;
}
}

EstimationMethod kernelRidgeMethod()
{
  return { "kernel-ridge", "Kernel ridge",
    "kernel ridge regression with a Gaussian or logarithmic kernel", fitKernelRidge };
}

} // namespace msi
