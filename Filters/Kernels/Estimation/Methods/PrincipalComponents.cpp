#include "Kernels/Estimation/Methods/Methods.h"

#include "Kernels/Estimation/CrossValidation.h"
#include "Kernels/Estimation/Responsivity.h"
#include "Kernels/Numerics/LeastSquares.h"
#include "Kernels/Spectra/Counted.h"

#include <Eigen/Eigenvalues>

#include <algorithm>
#include <sstream>

namespace msi
{

namespace
{
constexpr Eigen::Index MostComponents = 12;
constexpr Eigen::Index FewestComponents = 3;

struct ComponentsCandidate
{
  double tuningWeight;
  Eigen::Index components;
};

AffineTransform fitComponents(
  const SampleSet& calibration, const SampleSet& tuning, const ComponentsCandidate& candidate)
{
  const SampleSet samples = joined(calibration, tuning);
  const Eigen::VectorXd weights =
    joinedWeights(calibration.size(), tuning.size(), candidate.tuningWeight);
  const Eigen::VectorXd mean = weightedMean(samples.reflectance, weights);
  const Eigen::MatrixXd centered = samples.reflectance.colwise() - mean;
  const Eigen::SelfAdjointEigenSolver<Eigen::MatrixXd> eigen(
    centered * weights.asDiagonal() * centered.transpose());
  const Eigen::MatrixXd basis = eigen.eigenvectors().rightCols(candidate.components);
  const Eigen::VectorXd root = weights.cwiseSqrt();
  const LeastSquaresSolution scores =
    solveLeastSquares(withConstant(samples.response) * root.asDiagonal(),
      basis.transpose() * centered * root.asDiagonal());
  Eigen::MatrixXd coefficients = basis * scores.coefficients;
  coefficients.rightCols(1) += mean;
  return AffineTransform(std::move(coefficients));
}

EstimationFit fitPrincipalComponents(
  const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& /*options*/)
{
  requireTrainingSamples(calibration, tuning);
  // A fold's samples span one dimension less than their number, and no more than the bands.
  const Eigen::Index most =
    std::min({ calibration.bands(), calibration.size() - 1 + tuning.size(), MostComponents });
  std::vector<ComponentsCandidate> candidates;
  for (const double weight : tuningWeights(calibration, tuning))
  {
    for (Eigen::Index p = std::min(FewestComponents, most); p <= most; ++p)
    {
      candidates.push_back({ weight, p });
    }
  }
  const CandidateChoice choice = chooseCandidate(tuning, candidates.size(),
    [&](std::size_t i, const SampleSet& kept, const Eigen::MatrixXd& leftOut)
    { return fitComponents(calibration, kept, candidates[i])(leftOut); });
  ComponentsCandidate best = candidates[choice.best];
  if (!choice.chosen)
  {
    best.components = std::min(most, calibration.channels());
  }
  std::ostringstream status;
  status.precision(3);
  status << counted(best.components, "component") << ", tuning weight " << best.tuningWeight << ", "
         << choiceText(choice, tuning);
  FitSummary summary = summaryOfChoice(choice, calibration, tuning, status.str());
  summary.rank = best.components;
  summary.unknowns = best.components * (calibration.channels() + 1);
  return linearFit(fitComponents(calibration, tuning, best), std::move(summary));
}
}

EstimationMethod pcaMethod()
{
  return { "pca", "Principal components", "principal components of the reflectances",
    fitPrincipalComponents };
}

} // namespace msi
