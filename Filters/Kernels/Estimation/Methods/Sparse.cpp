#include "Kernels/Estimation/Methods/Methods.h"

#include "Kernels/Estimation/CrossValidation.h"
#include "Kernels/Estimation/LocalChoice.h"
#include "Kernels/Estimation/Responsivity.h"
#include "Kernels/Numerics/Lasso.h"

#include <array>
#include <sstream>

namespace msi
{

namespace
{
constexpr std::array<double, 7> SparsePenalties{ 1e-3, 3e-4, 1e-4, 3e-5, 1e-5, 1e-2, 1e-1 };

struct SparseCandidate
{
  double tuningWeight;
  double penalty;
};

AffineTransform fitSparse(
  const SampleSet& calibration, const SampleSet& tuning, const SparseCandidate& candidate)
{
  const SampleSet samples = joined(calibration, tuning);
  const Eigen::VectorXd weights =
    joinedWeights(calibration.size(), tuning.size(), candidate.tuningWeight);
  const Eigen::VectorXd meanResponse = weightedMean(samples.response, weights);
  const Eigen::VectorXd meanReflectance = weightedMean(samples.reflectance, weights);
  const Eigen::VectorXd scale = localSamples(samples).scale;
  const Eigen::MatrixXd x = scale.asDiagonal() * (samples.response.colwise() - meanResponse);
  const Eigen::MatrixXd y = samples.reflectance.colwise() - meanReflectance;
  const Eigen::VectorXd share = weights / weights.sum();
  const Eigen::MatrixXd weighted = x * share.asDiagonal();
  const Eigen::VectorXd deviation = (y.cwiseAbs2() * share).cwiseSqrt();
  const Eigen::MatrixXd w =
    solveLasso(weighted * x.transpose(), weighted * y.transpose(), candidate.penalty * deviation);
  Eigen::MatrixXd coefficients(samples.bands(), samples.channels() + 1);
  coefficients.leftCols(samples.channels()) = w.transpose() * scale.asDiagonal();
  coefficients.rightCols(1) =
    meanReflectance - coefficients.leftCols(samples.channels()) * meanResponse;
  return AffineTransform(std::move(coefficients));
}

EstimationFit fitSparseMethod(
  const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& /*options*/)
{
  requireTrainingSamples(calibration, tuning);
  std::vector<SparseCandidate> candidates;
  for (const double weight : tuningWeights(calibration, tuning))
  {
    for (const double penalty : SparsePenalties)
    {
      candidates.push_back({ weight, penalty });
    }
  }
  const CandidateChoice choice = chooseCandidate(tuning, candidates.size(),
    [&](std::size_t i, const SampleSet& kept, const Eigen::MatrixXd& leftOut)
    { return fitSparse(calibration, kept, candidates[i])(leftOut); });
  const SparseCandidate& best = candidates[choice.best];
  AffineTransform transform = fitSparse(calibration, tuning, best);
  const Eigen::Index nonZero = (transform.linear().array() != 0.0).count();
  std::ostringstream status;
  status.precision(3);
  status << nonZero << " of " << transform.linear().size() << " coefficients are not zero, penalty "
         << best.penalty << ", tuning weight " << best.tuningWeight << ", "
         << choiceText(choice, tuning);
  FitSummary summary = summaryOfChoice(choice, calibration, tuning, status.str());
  summary.unknowns = nonZero + transform.outputs();
  return linearFit(std::move(transform), std::move(summary));
}
}

EstimationMethod sparseMethod()
{
  return { "sparse", "Sparse", "W with an L1 penalty", fitSparseMethod };
}

} // namespace msi
