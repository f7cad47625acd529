#include "Kernels/Estimation/MethodComparison.h"

#include "Kernels/Estimation/MetamerismCorrection.h"
#include "Kernels/Estimation/PseudoinverseCalibration.h"
#include "Kernels/Estimation/RModelCorrection.h"
#include "Kernels/Estimation/TransferEstimation.h"

#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
MethodEstimate withTransform(EstimationMethod method, const AffineTransform& transform,
  const FitSummary& summary, const SampleSet& heldOut)
{
  return { method, transform(heldOut.response), {}, {}, summary };
}

MethodEstimate estimateWith(EstimationMethod method, const SampleSet& calibration,
  const SampleSet& tuning, const SampleSet& heldOut, const ComparisonOptions& options)
{
  switch (method)
  {
    case EstimationMethod::Direct:
    {
      const CalibrationFit fit = fitPseudoinverse(calibration);
      return withTransform(method, fit.transform, fit.summary, heldOut);
    }
    case EstimationMethod::Pinv:
    {
      const CalibrationFit fit = fitPseudoinverse(tuning);
      return withTransform(method, fit.transform, fit.summary, heldOut);
    }
    case EstimationMethod::Pooled:
    {
      const CalibrationFit fit = fitPooled(calibration, tuning);
      return withTransform(method, fit.transform, fit.summary, heldOut);
    }
    case EstimationMethod::RModel:
    {
      const CalibrationFit direct = fitPseudoinverse(calibration);
      const RModelFit fit = fitRModel(direct.transform(tuning.response), tuning.reflectance);
      return withTransform(
        method, AffineTransform::compose(fit.correction, direct.transform), fit.summary, heldOut);
    }
    case EstimationMethod::Banded:
    {
      MetamerismOptions metamerism;
      metamerism.channelWavelengths = options.channelWavelengths;
      const MetamerismFit fit = fitMetamerismCorrection(calibration, tuning, metamerism);
      return withTransform(method, fit.composite, fit.summary, heldOut);
    }
    case EstimationMethod::Transfer:
      break;
  }
  const TransferFit fit = fitTransfer(calibration, tuning);
  return { method, fit.estimator(heldOut.response),
    fit.estimator.standardDeviation(heldOut.response), {}, fit.summary };
}
}

std::string_view nameOf(EstimationMethod method) noexcept
{
  switch (method)
  {
    case EstimationMethod::Direct:
      return "direct";
    case EstimationMethod::Pinv:
      return "pinv";
    case EstimationMethod::Pooled:
      return "pooled";
    case EstimationMethod::RModel:
      return "r-model";
    case EstimationMethod::Banded:
      return "banded";
    case EstimationMethod::Transfer:
      break;
  }
  return "transfer";
}

const std::vector<EstimationMethod>& allEstimationMethods()
{
  static const std::vector<EstimationMethod> methods{ EstimationMethod::Direct,
    EstimationMethod::Pinv, EstimationMethod::Pooled, EstimationMethod::RModel,
    EstimationMethod::Banded, EstimationMethod::Transfer };
  return methods;
}

EstimationMethod estimationMethodNamed(std::string_view name)
{
  std::ostringstream message;
  message << "there is no estimation method '" << name << "'; expected one of";
  const char* separator = " ";
  for (const EstimationMethod method : allEstimationMethods())
  {
    if (nameOf(method) == name)
    {
      return method;
    }
    message << std::exchange(separator, ", ") << nameOf(method);
  }
  throw std::invalid_argument(message.str());
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
  if (Options.tuningSamples < 1 || Options.tuningSamples >= Target.size())
  {
    std::ostringstream message;
    message << Options.tuningSamples << " tuning samples are asked for and the target has "
            << Target.size() << " samples; expected a number from 1 to " << Target.size() - 1
            << ", so that samples are left to test on";
    throw std::invalid_argument(message.str());
  }
}

ComparisonDraw MethodComparison::run(std::uint64_t draw) const
{
  ComparisonDraw result;
  result.tuning = drawSamples(Target.size(), Options.tuningSamples, Options.seed, draw);
  result.heldOut = remainingSamples(Target.size(), result.tuning);
  const SampleSet tuning = Target.subset(result.tuning);
  const SampleSet heldOut = Target.subset(result.heldOut);
  for (const EstimationMethod method : Options.methods)
  {
    try
    {
      MethodEstimate estimate = estimateWith(method, Calibration, tuning, heldOut, Options);
      estimate.rms = (estimate.reflectance - heldOut.reflectance)
                       .array()
                       .square()
                       .colwise()
                       .mean()
                       .sqrt()
                       .transpose();
      result.estimates.push_back(std::move(estimate));
    }
    catch (const std::invalid_argument& error)
    {
      throw std::invalid_argument("method " + std::string(nameOf(method)) + ": " + error.what());
    }
  }
  return result;
}

} // namespace msi
