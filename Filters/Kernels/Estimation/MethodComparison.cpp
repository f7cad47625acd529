#include "Kernels/Estimation/MethodComparison.h"

#include "Kernels/Estimation/EstimationMethod.h"

#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

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
    std::ostringstream message;
    message << Options.tuningSamples << " tuning samples are asked for and the target has "
            << Target.size() << " samples; expected a number from 1 to " << Target.size() - 1
            << ", so that samples are left to test on";
    throw std::invalid_argument(message.str());
  }
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
  for (const std::string& name : Options.methods)
  {
    MethodEstimate estimate;
    estimate.method = name;
    try
    {
      const EstimationFit fit = estimationMethodNamed(name).fit(Calibration, tuning, estimation);
      estimate.reflectance = (*fit.estimator)(heldOut.response);
      estimate.standardDeviation = fit.estimator->standardDeviation(heldOut.response);
      estimate.rms = (estimate.reflectance - heldOut.reflectance)
                       .array()
                       .square()
                       .colwise()
                       .mean()
                       .sqrt()
                       .transpose();
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
