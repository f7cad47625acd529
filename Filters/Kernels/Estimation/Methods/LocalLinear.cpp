#include "Kernels/Estimation/Methods/Methods.h"

#include "Kernels/Estimation/LocalChoice.h"

#include <sstream>

namespace msi
{

namespace
{
EstimationFit fitLocalLinear(
  const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& /*options*/)
{
  requireTrainingSamples(calibration, tuning);
  const SampleSet samples = joined(calibration, tuning);
  const LocalSamples local = localSamples(samples);
  std::vector<LocalCandidate> candidates;
  for (const double weight : tuningWeights(calibration, tuning))
  {
    for (const double part : { 0.5, 0.25, 1.0 })
    {
      for (const double ridge : { 1e-4, 1e-3, 1e-2, 1e-5, 1e-6 })
      {
        candidates.push_back({ weight, neighboursOf(samples, part), ridge });
      }
    }
  }
  const CandidateChoice choice = chooseLocal(local, calibration.size(), tuning, candidates);
  const LocalCandidate& best = candidates[choice.best];
  std::ostringstream status;
  status.precision(3);
  status << best.neighbours << " neighbours, ridge " << best.ridge << ", tuning weight "
         << best.tuningWeight << ", " << choiceText(choice, tuning);
  EstimationFit result;
  result.estimator =
    std::make_shared<LocalEstimator>(withCandidate(local, calibration.size(), best));
  result.summary = summaryOfChoice(choice, calibration, tuning, status.str());
  return result;
}
}

EstimationMethod localLinearMethod()
{
  return { "local-linear", "Local linear", "locally weighted linear regression", fitLocalLinear };
}

} // namespace msi
