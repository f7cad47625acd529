#include "Kernels/Estimation/Transfer/TransferEstimation.h"

#include "Kernels/Difference/ErrorSummary.h"
#include "Kernels/Estimation/MetamerismCorrection.h"
#include "Kernels/Estimation/SampleDraw.h"
#include "Kernels/Estimation/Transfer/MixtureShares.h"
#include "Kernels/Estimation/Transfer/TransferExpert.h"
#include "Kernels/Numerics/LeastSquares.h"
#include "Kernels/Numerics/StudentQuantile.h"
#include "Kernels/Spectra/Counted.h"

#include <algorithm>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <vector>

namespace msi
{

namespace
{
// The mixture before any tuning sample has spoken, and how many of them that belief is worth.
const Eigen::Vector3d PriorShares(0.4, 0.4, 0.2); // linear, square root, affine
constexpr double MixturePriorSamples = 10.0;
// Tuning samples that the chart's pattern of variance over the bands is worth.
constexpr double BandPriorSamples = 10.0;
// The share of measured values that intervals are calibrated to hold, and the normal deviate below which that share lies.
constexpr double CalibratedShare = 0.9;
constexpr double NormalQuantile = 1.6448536269514722;
constexpr Eigen::Index LargestFoldCount = 32;

// The affine expert: the source's metamerism correction with a diagonal transform, which few samples
// determine, and its errors on tuning samples that took no part.
struct AffineExpert
{
  Eigen::MatrixXd coefficients;
  Eigen::MatrixXd leftOutErrors; // N x L_T; 0 x 0 where there is no such expert
};

AffineExpert fitAffineExpert(const SampleSet& calibration, const SampleSet& tuning)
{
  AffineExpert expert;
  const Eigen::Index count = tuning.size();
  if (count < 3 || tuning.channels() > tuning.bands())
  {
    expert.coefficients = Eigen::MatrixXd::Zero(tuning.bands(), tuning.channels() + 1);
    return expert;
  }
  MetamerismOptions options;
  options.structure = BandStructure::Diagonal;
  expert.coefficients =
    fitMetamerismCorrection(calibration, tuning, options).composite.coefficients();
  expert.leftOutErrors.resize(tuning.bands(), count);
  for (const auto& left : leftOutFolds(count, LargestFoldCount))
  {
    const MetamerismFit fit =
      fitMetamerismCorrection(calibration, tuning.subset(remainingSamples(count, left)), options);
    const SampleSet out = tuning.subset(left);
    expert.leftOutErrors(Eigen::all, left) = fit.composite(out.response) - out.reflectance;
  }
  return expert;
}

Eigen::Vector3d sharesOf(const Eigen::MatrixXd& linearError, const Eigen::MatrixXd& squareRootError,
  const Eigen::MatrixXd& affineError)
{
  const double strength = MixturePriorSamples / static_cast<double>(linearError.cols());
  Eigen::Vector3d shares = Eigen::Vector3d::Zero();
  if (affineError.size() == 0)
  {
    shares.head<2>() =
      mixtureShares({ linearError, squareRootError }, Eigen::Vector2d(0.5, 0.5), strength);
  }
  else
  {
    shares = mixtureShares({ linearError, squareRootError, affineError }, PriorShares, strength);
  }
  return shares;
}

// Squared slope times left-out variance, per band and sample: the variance of the reflectance in
// units of the band variance.
Eigen::MatrixXd unitVariance(const TransferExpertFit& fit)
{
  const TransferSpace space = fit.expert.features.space;
  const Eigen::MatrixXd slopes =
    fit.leftOutEstimate.unaryExpr([space](double r) { return slopeFromSpace(space, r); });
  return slopes.cwiseAbs2() * fit.leftOutVariance.asDiagonal();
}

// Variance per band in units of what the model expects: of squared left-out errors of the tuning samples, drawn toward
// the chart's pattern over the bands; then scaled so that the normal 90 % interval holds 90 % of the left-out errors, whose
// tails are heavier than the normal distribution's. The level is itself known from few samples: Student's t. And it is
// optimistic, for the sample left out has taken part in the fit of the hyperparameters: 'refittedErrors', of fits in which
// it has not, tell by how much.
Eigen::VectorXd calibratedBandVariance(const Eigen::MatrixXd& chartErrors,
  const Eigen::MatrixXd& tuningErrors, const Eigen::MatrixXd& refittedErrors,
  const Eigen::MatrixXd& unitVariances)
{
  const Eigen::ArrayXXd variances = unitVariances.array().max(1e-300);
  const auto ofTuningSamples = variances.rightCols(tuningErrors.cols());
  const Eigen::VectorXd ofChart =
    (chartErrors.array().square() / variances.leftCols(chartErrors.cols())).rowwise().mean();
  const Eigen::VectorXd ofTuning =
    (tuningErrors.array().square() / ofTuningSamples).rowwise().mean();
  const double samples = static_cast<double>(tuningErrors.cols());
  const double level = ofChart.mean() > 0.0 ? ofTuning.mean() / ofChart.mean() : 0.0;
  const Eigen::VectorXd pattern =
    (samples * ofTuning + BandPriorSamples * level * ofChart) / (samples + BandPriorSamples);
  const Eigen::ArrayXXd expected = ofTuningSamples.colwise() * pattern.array().max(1e-300);
  const Eigen::ArrayXXd squares = tuningErrors.array().square() / expected;
  const double tail =
    percentile(squares.sqrt().reshaped().matrix(), 100.0 * CalibratedShare) / NormalQuantile;
  const double student =
    studentQuantile(CalibratedShare, static_cast<int>(tuningErrors.cols())) / NormalQuantile;
  const double meanSquare = squares.mean();
  const double optimism = meanSquare > 0.0
    ? std::max(1.0, (refittedErrors.array().square() / expected).mean() / meanSquare)
    : 1.0;
  return std::pow(tail * student, 2) * optimism * pattern;
}

// Root mean square of each channel over the chart; 1 for a channel that is zero throughout.
Eigen::VectorXd channelScales(const SampleSet& chart)
{
  Eigen::VectorXd scales =
    (chart.response.cwiseAbs2().rowwise().sum() / static_cast<double>(chart.size())).cwiseSqrt();
  return scales.unaryExpr([](double scale) { return scale > 0.0 ? scale : 1.0; });
}

// Channels that differ in gain count alike: the fit sees each channel divided by its scale ...
SampleSet balanced(const SampleSet& samples, const Eigen::VectorXd& scales)
{
  return { samples.reflectance, scales.cwiseInverse().asDiagonal() * samples.response };
}

// ... and the estimator divides as part of the gain it applies to a response anyway.
void foldIntoGain(TransferExpert& expert, const Eigen::VectorXd& scales)
{
  expert.features.logGain -= scales.array().log().matrix();
}

FitSummary summarize(const TransferExpertFit& linear, const TransferExpertFit& squareRoot,
  const Eigen::Vector3d& shares, const SampleSet& calibration, const SampleSet& tuning)
{
  FitSummary summary;
  summary.rank = std::max(linear.expert.points.cols(), squareRoot.expert.points.cols());
  summary.unknowns = 2 * (TransferKernel::Count + 2 * calibration.channels());
  summary.samples = calibration.size() + tuning.size();
  summary.iterations = linear.iterations + squareRoot.iterations;
  std::ostringstream status;
  status.precision(2);
  status << "learned from " << calibration.size() << " chart and "
         << counted(tuning.size(), "tuning sample") << "; shares " << std::fixed << shares[0]
         << " linear, " << shares[1] << " square root, " << shares[2] << " affine";
  summary.complete = tuning.size() >= 5;
  if (!summary.complete)
  {
    status << "; with fewer than 5 tuning samples the uncertainty is a rough guess";
  }
  summary.status = status.str();
  return summary;
}
}

TransferFit fitTransfer(
  const SampleSet& unbalancedCalibration, const SampleSet& unbalancedTuning, bool uncertainty)
{
  requireValid(unbalancedCalibration, "calibration");
  requireValid(unbalancedTuning, "tuning");
  requireSameShape(unbalancedCalibration, "calibration", unbalancedTuning, "tuning");
  if (unbalancedTuning.size() < 2)
  {
    throw std::invalid_argument(
      "there is 1 tuning sample; the method transfer expects at least 2 samples");
  }
  const Eigen::VectorXd scales = channelScales(unbalancedCalibration);
  const SampleSet calibration = balanced(unbalancedCalibration, scales);
  const SampleSet tuning = balanced(unbalancedTuning, scales);
  TransferExpertFit linear =
    fitTransferExpert(TransferSpace::Linear, calibration, tuning, uncertainty);
  TransferExpertFit squareRoot =
    fitTransferExpert(TransferSpace::SquareRoot, calibration, tuning, uncertainty);
  foldIntoGain(linear.expert, scales);
  foldIntoGain(squareRoot.expert, scales);

  AffineExpert affine = fitAffineExpert(calibration, tuning);
  affine.coefficients.leftCols(scales.size()) *= scales.cwiseInverse().asDiagonal();

  const Eigen::MatrixXd reflectances = joined(calibration, tuning).reflectance;
  const Eigen::MatrixXd linearError = linear.leftOutEstimate - reflectances;
  const Eigen::MatrixXd squareRootError = squareRoot.leftOutEstimate - reflectances;
  const Eigen::Index count = tuning.size();
  const Eigen::Vector3d shares =
    sharesOf(linearError.rightCols(count), squareRootError.rightCols(count), affine.leftOutErrors);
  const auto mixed =
    [&](const Eigen::MatrixXd& ofLinearExpert, const Eigen::MatrixXd& ofSquareRootExpert)
  {
    Eigen::MatrixXd errors = shares[0] * ofLinearExpert + shares[1] * ofSquareRootExpert;
    if (affine.leftOutErrors.size() > 0)
    {
      errors += shares[2] * affine.leftOutErrors;
    }
    return errors;
  };
  const Eigen::MatrixXd tuningErrors =
    mixed(linearError.rightCols(count), squareRootError.rightCols(count));
  const Eigen::MatrixXd refittedErrors = mixed(
    linear.refittedEstimate - tuning.reflectance, squareRoot.refittedEstimate - tuning.reflectance);

  // The Gaussian processes alone know how uncertain they are; they speak for the affine expert too.
  const double gaussian = shares[0] + shares[1];
  const double ofLinear = gaussian > 0.0 ? shares[0] / gaussian : 0.5;
  const double ofSquareRoot = 1.0 - ofLinear;
  const Eigen::VectorXd bandVariance = calibratedBandVariance(
    (ofLinear * linearError + ofSquareRoot * squareRootError).leftCols(calibration.size()),
    tuningErrors, refittedErrors,
    ofLinear * unitVariance(linear) + ofSquareRoot * unitVariance(squareRoot));

  FitSummary summary = summarize(linear, squareRoot, shares, calibration, tuning);
  summary.residualRms = rootMeanSquare(tuningErrors);
  return { TransferEstimator(
             transferParameters({ { linear.expert, squareRoot.expert }, { shares[0], shares[1] },
               { ofLinear, ofSquareRoot }, affine.coefficients, shares[2], bandVariance })),
    summary };
}

} // namespace msi
