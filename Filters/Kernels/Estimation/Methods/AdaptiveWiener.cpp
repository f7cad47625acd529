#include "Kernels/Estimation/Methods/WienerFit.h"

#include "Kernels/Estimation/CrossValidation.h"
#include "Kernels/Estimation/LocalChoice.h"

#include <sstream>

namespace msi
{

namespace
{
EstimationFit fitAdaptiveWiener(
  const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& /*options*/)
{
  const WienerFit wiener = fitWiener(calibration, tuning);
  const SampleSet samples = joined(calibration, tuning);
  const ResponsivityFit camera = fitResponsivity(
    samples, joinedWeights(calibration.size(), tuning.size(), wiener.tuningWeight), wiener.ridge);
  LocalSamples local = localSamples(samples);
  local.regressors = camera.camera(samples.reflectance);
  local.noise = camera.noise;
  std::vector<LocalCandidate> candidates;
  for (const double weight : tuningWeights(calibration, tuning))
  {
    for (const double part : { 0.5, 0.25, 0.125, 1.0 })
    {
      candidates.push_back({ weight, neighboursOf(samples, part), 0.0 });
    }
  }
  const CandidateChoice choice = chooseLocal(local, calibration.size(), tuning, candidates);
  const LocalCandidate& best = candidates[choice.best];
  std::ostringstream status;
  status.precision(3);
  status << best.neighbours << " neighbours, tuning weight " << best.tuningWeight << ", "
         << choiceText(choice, tuning);
  EstimationFit result;
  result.estimator =
    std::make_shared<LocalEstimator>(withCandidate(local, calibration.size(), best));
  result.summary = summaryOfChoice(choice, calibration, tuning, status.str());
  return result;
}
}

EstimationMethod adaptiveWienerMethod()
{
  return { "adaptive-wiener", "Adaptive Wiener",
    "Wiener estimation with the statistics of the nearest samples", fitAdaptiveWiener };
}

} // namespace msi
