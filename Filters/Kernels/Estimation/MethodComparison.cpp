#include "Kernels/Estimation/MethodComparison.h"

#include "Kernels/Estimation/EstimationMethod.h"
#include "Kernels/Estimation/PseudoinverseCalibration.h"
#include "Kernels/Spectra/Counted.h"
#include "Kernels/Spectra/Reject.h"

#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
constexpr Eigen::Index Folds = 10;

// Over bands, one per sample.
Eigen::VectorXd rmsOf(const Eigen::MatrixXd& errors)
{
  return errors.array().square().colwise().mean().sqrt().transpose();
}
}

std::vector<std::string> allMethodNames()
{
  std::vector<std::string> names;
  for (const EstimationMethod& method : estimationMethods())
  {
    names.emplace_back(method.name);
  }
  return names;
}

MethodComparison::MethodComparison(
  SampleSet calibration, SampleSet target, ComparisonOptions options)
  : Calibration(std::move(calibration))
  , Target(std::move(target))
  , Options(std::move(options))
{
  requireValid(Calibration, "calibration");
  requireValid(Target, "target");
  requireSameShape(Calibration, "calibration", Target, "target");
  if (Options.methods.empty())
  {
    throw std::invalid_argument("no estimation method is asked for; expected at least one");
  }
  for (const std::string& name : Options.methods)
  {
    estimationMethodNamed(name);
  }
  if (Options.tuningSamples < 1 || Options.tuningSamples >= Target.size())
  {
    reject(counted(Options.tuningSamples, "tuning sample"),
      Options.tuningSamples == 1 ? " is" : " are", " asked for and the target has ",
      counted(Target.size(), "sample"), "; expected a number from 1 to ", Target.size() - 1,
      ", so that samples are left to test on");
  }
}

MethodEstimate MethodComparison::ownMedium() const
{
  MethodEstimate estimate;
  estimate.method = "own-medium";
  const Eigen::Index unknowns = Target.channels() + 1;
  const Eigen::Index fitted = Target.size() - (Target.size() + Folds - 1) / Folds;
  if (fitted < unknowns)
  {
    std::ostringstream message;
    message << "nine tenths of the target are " << fitted << " samples for " << unknowns
            << " unknowns per band; expected at least " << unknowns << " samples";
    estimate.failure = message.str();
    return estimate;
  }
  estimate.reflectance.resize(Target.bands(), Target.size());
  for (Eigen::Index fold = 0; fold < Folds; ++fold)
  {
    std::vector<Eigen::Index> left;
    for (Eigen::Index i = fold; i < Target.size(); i += Folds)
    {
      left.push_back(i);
    }
    if (!left.empty())
    {
      const SampleSet others = Target.subset(remainingSamples(Target.size(), left));
      estimate.reflectance(Eigen::all, left) =
        fitPseudoinverse(others).transform(Target.subset(left).response);
    }
  }
  estimate.rms = rmsOf(estimate.reflectance - Target.reflectance);
  return estimate;
}

MethodComparison MethodComparison::only(std::size_t method) const
{
  ComparisonOptions options = Options;
  options.methods = { Options.methods.at(method) };
  return MethodComparison(Calibration, Target, std::move(options));
}

ComparisonDraw MethodComparison::run(std::uint64_t draw) const
{
  ComparisonDraw result;
  result.tuning = drawSamples(Target.size(), Options.tuningSamples, Options.seed, draw);
  result.heldOut = remainingSamples(Target.size(), result.tuning);
  const SampleSet tuning = Target.subset(result.tuning);
  const SampleSet heldOut = Target.subset(result.heldOut);
  EstimationOptions estimation;
  estimation.metamerism.channelWavelengths = Options.channelWavelengths;
  estimation.uncertainty = Options.uncertainty;
  for (const std::string& name : Options.methods)
  {
    MethodEstimate estimate;
    estimate.method = name;
    try
    {
      const EstimationFit fit = estimationMethodNamed(name).fit(Calibration, tuning, estimation);
      estimate.reflectance = (*fit.estimator)(heldOut.response);
      if (Options.uncertainty)
      {
        estimate.standardDeviation = fit.estimator->standardDeviation(heldOut.response);
      }
      estimate.rms = rmsOf(estimate.reflectance - heldOut.reflectance);
      estimate.summary = fit.summary;
      requireFinite(estimate.reflectance, "the estimate of held-out");
      requireFinite(estimate.standardDeviation, "the standard deviation of held-out");
    }
    catch (const std::invalid_argument& error)
    {
      estimate = {};
      estimate.method = name;
      estimate.failure = error.what();
    }
    result.estimates.push_back(std::move(estimate));
  }
  return result;
}

} // namespace msi
