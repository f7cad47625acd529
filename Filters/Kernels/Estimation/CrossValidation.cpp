#include "Kernels/Estimation/CrossValidation.h"
#include "Kernels/Estimation/SampleDraw.h"
#include "Kernels/Spectra/Counted.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
constexpr Eigen::Index MostFolds = 8;
}

CandidateChoice chooseCandidate(
  const SampleSet& tuning, std::size_t candidates, const CandidateEstimate& estimate)
{
  CandidateChoice choice;
  choice.leftOutRms = std::numeric_limits<double>::quiet_NaN();
  if (tuning.size() < FewestToChoose || candidates < 1)
  {
    return choice;
  }
  std::vector<double> squares(candidates, 0.0);
  for (const auto& leftOut : leftOutFolds(tuning.size(), MostFolds))
  {
    const SampleSet keptSamples = tuning.subset(remainingSamples(tuning.size(), leftOut));
    const SampleSet tested = tuning.subset(leftOut);
    for (std::size_t candidate = 0; candidate < candidates; ++candidate)
    {
      squares[candidate] +=
        (estimate(candidate, keptSamples, tested.response) - tested.reflectance).squaredNorm();
    }
  }
  choice.best = 0;
  for (std::size_t candidate = 1; candidate < candidates; ++candidate)
  {
    if (squares[candidate] < squares[choice.best])
    {
      choice.best = candidate;
    }
  }
  choice.leftOutRms =
    std::sqrt(squares[choice.best] / static_cast<double>(tuning.reflectance.size()));
  choice.chosen = true;
  return choice;
}

std::string choiceText(const CandidateChoice& choice, const SampleSet& tuning)
{
  std::ostringstream text;
  text.precision(2);
  if (choice.chosen)
  {
    text << "chosen on " << counted(tuning.size(), "tuning sample") << ", left-out rms "
         << choice.leftOutRms;
  }
  else
  {
    text << "taken as given: " << counted(tuning.size(), "tuning sample")
         << (tuning.size() == 1 ? " is" : " are") << " too few to choose; expected at least "
         << FewestToChoose;
  }
  return text.str();
}

FitSummary summaryOfChoice(const CandidateChoice& choice, const SampleSet& calibration,
  const SampleSet& tuning, std::string status)
{
  FitSummary summary;
  summary.residualRms = choice.leftOutRms;
  summary.samples = calibration.size() + tuning.size();
  summary.iterations = 1;
  summary.complete = choice.chosen;
  summary.status = std::move(status);
  return summary;
}

void requireTrainingSamples(const SampleSet& calibration, const SampleSet& tuning)
{
  requireValid(calibration, "calibration");
  requireValid(tuning, "tuning");
  requireSameShape(calibration, "calibration", tuning, "tuning");
}

Eigen::Vector3d tuningWeights(const SampleSet& calibration, const SampleSet& tuning)
{
  const double ratio = static_cast<double>(calibration.size()) / static_cast<double>(tuning.size());
  return { 1.0, std::sqrt(ratio), ratio };
}

Eigen::VectorXd joinedWeights(Eigen::Index chartSamples, Eigen::Index tuningSamples, double weight)
{
  Eigen::VectorXd weights = Eigen::VectorXd::Ones(chartSamples + tuningSamples);
  weights.tail(tuningSamples).setConstant(weight);
  return weights;
}

} // namespace msi
