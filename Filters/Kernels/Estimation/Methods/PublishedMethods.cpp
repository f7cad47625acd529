#include "Kernels/Estimation/Methods/Methods.h"

#include "Kernels/Estimation/PseudoinverseCalibration.h"
#include "Kernels/Estimation/RModelCorrection.h"

namespace msi
{

namespace
{
EstimationFit fitDirect(
  const SampleSet& calibration, const SampleSet& /*tuning*/, const EstimationOptions& /*options*/)
{
  const CalibrationFit fit = fitPseudoinverse(calibration);
  return linearFit(fit.transform, fit.summary);
}

EstimationFit fitPinv(
  const SampleSet& /*calibration*/, const SampleSet& tuning, const EstimationOptions& /*options*/)
{
  const CalibrationFit fit = fitPseudoinverse(tuning);
  return linearFit(fit.transform, fit.summary);
}

EstimationFit fitPooledMethod(
  const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& options)
{
  const double weight = options.metamerism.tuningWeight;
  const CalibrationFit fit = fitPooled(calibration, tuning, weight > 0.0 ? weight : 1.0);
  return linearFit(fit.transform, fit.summary);
}

EstimationFit fitRModelMethod(
  const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& /*options*/)
{
  const CalibrationFit direct = fitPseudoinverse(calibration);
  const RModelFit fit = fitRModel(direct.transform(tuning.response), tuning.reflectance);
  return linearFit(AffineTransform::compose(fit.correction, direct.transform), fit.summary);
}

EstimationFit fitBanded(
  const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& options)
{
  const MetamerismFit banded = fitMetamerismCorrection(calibration, tuning, options.metamerism);
  EstimationFit fit;
  fit.estimator = std::make_shared<AffineEstimator>(banded.composite);
  fit.summary = banded.summary;
  fit.factors = LinearFactors{ banded.reflectance, banded.metamerism };
  fit.history = banded.history;
  return fit;
}
}

EstimationMethod directMethod()
{
  return { "direct", "Direct", "the chart alone", fitDirect };
}

EstimationMethod pinvMethod()
{
  return { "pinv", "PINV", "the tuning samples alone", fitPinv };
}

EstimationMethod pooledMethod()
{
  return { "pooled", "Pooled", "chart and tuning samples together", fitPooledMethod };
}

EstimationMethod rModelMethod()
{
  return { "r-model", "R-model", "a correction per band of the chart's estimate", fitRModelMethod };
}

EstimationMethod bandedMethod()
{
  return { "banded", "Banded", "banded metamerism transform D and W, solved in turn", fitBanded };
}

} // namespace msi
