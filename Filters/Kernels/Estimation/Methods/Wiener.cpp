#include "Kernels/Estimation/Methods/WienerFit.h"

#include "Kernels/Estimation/CrossValidation.h"

#include <Eigen/Cholesky>

#include <array>
#include <cmath>
#include <sstream>

namespace msi
{

namespace
{
constexpr std::array<double, 4> Correlations{ 0.99, 0.97, 0.995, 0.999 };
constexpr std::array<double, 3> Ridges{ 1e-4, 1e-3, 1e-5 };

struct WienerCandidate
{
  double correlation;
  double ridge;
  double tuningWeight;
};

std::vector<WienerCandidate> wienerCandidates(const SampleSet& calibration, const SampleSet& tuning)
{
  std::vector<WienerCandidate> candidates;
  for (const double weight : tuningWeights(calibration, tuning))
  {
    for (const double ridge : Ridges)
    {
      for (const double correlation : Correlations)
      {
        candidates.push_back({ correlation, ridge, weight });
      }
    }
  }
  return candidates;
}

AffineTransform smoothWiener(
  const SampleSet& calibration, const SampleSet& tuning, const WienerCandidate& candidate)
{
  const SampleSet samples = joined(calibration, tuning);
  const Eigen::VectorXd weights =
    joinedWeights(calibration.size(), tuning.size(), candidate.tuningWeight);
  const ResponsivityFit fit = fitResponsivity(samples, weights, candidate.ridge);
  const Eigen::VectorXd mean = weightedMean(samples.reflectance, weights);
  const Eigen::MatrixXd centered = samples.reflectance.colwise() - mean;
  const double variance = (centered.cwiseAbs2() * weights).mean() / weights.sum();
  return wienerTransform(
    fit, mean, markovCovariance(samples.bands(), variance, candidate.correlation));
}

EstimationFit fitWienerMethod(
  const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& /*options*/)
{
  WienerFit wiener = fitWiener(calibration, tuning);
  return linearFit(std::move(wiener.transform), std::move(wiener.summary));
}
}

Eigen::MatrixXd markovCovariance(Eigen::Index bands, double variance, double correlation)
{
  return Eigen::MatrixXd::NullaryExpr(bands, bands,
    [&](Eigen::Index i, Eigen::Index j)
    { return variance * std::pow(correlation, static_cast<double>(std::abs(i - j))); });
}

AffineTransform wienerTransform(
  const ResponsivityFit& fit, const Eigen::VectorXd& mean, const Eigen::MatrixXd& covariance)
{
  const Eigen::MatrixXd m = fit.camera.linear();
  const Eigen::MatrixXd cross = m * covariance;
  Eigen::MatrixXd system = cross * m.transpose();
  system.diagonal() += fit.noise;
  Eigen::MatrixXd coefficients(mean.size(), m.rows() + 1);
  coefficients.leftCols(m.rows()) = system.ldlt().solve(cross).transpose();
  coefficients.rightCols(1) =
    mean - coefficients.leftCols(m.rows()) * (m * mean + fit.camera.constant());
  return AffineTransform(std::move(coefficients));
}

WienerFit fitWiener(const SampleSet& calibration, const SampleSet& tuning)
{
  requireTrainingSamples(calibration, tuning);
  const auto candidates = wienerCandidates(calibration, tuning);
  const CandidateChoice choice = chooseCandidate(tuning, candidates.size(),
    [&](std::size_t i, const SampleSet& kept, const Eigen::MatrixXd& leftOut)
    { return smoothWiener(calibration, kept, candidates[i])(leftOut); });
  const WienerCandidate& best = candidates[choice.best];
  WienerFit fit{ smoothWiener(calibration, tuning, best), best.ridge, best.tuningWeight, {} };
  std::ostringstream status;
  status.precision(3);
  status << "correlation of neighbouring bands " << best.correlation << ", ridge " << best.ridge
         << ", tuning weight " << best.tuningWeight << ", " << choiceText(choice, tuning);
  fit.summary = summaryOfChoice(choice, calibration, tuning, status.str());
  fit.summary.unknowns = calibration.channels() * (calibration.bands() + 1);
  return fit;
}

EstimationMethod wienerMethod()
{
  return { "wiener", "Wiener", "Wiener estimation with a smoothness prior", fitWienerMethod };
}

} // namespace msi
