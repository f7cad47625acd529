#include "Kernels/Estimation/PseudoinverseCalibration.h"

#include "Kernels/Numerics/LeastSquares.h"
#include "Kernels/Spectra/Counted.h"
#include "Kernels/Spectra/Reject.h"

#include <cmath>
#include <sstream>

namespace msi
{

namespace
{
CalibrationFit summarized(const LeastSquaresSolution& solution, const Eigen::MatrixXd& responses,
  const Eigen::MatrixXd& reflectances)
{
  CalibrationFit fit{ AffineTransform(solution.coefficients), {} };
  const Eigen::Index coefficients = fit.transform.inputs() + 1;
  fit.summary.residualRms = rootMeanSquare(fit.transform(responses) - reflectances);
  fit.summary.rank = solution.rank;
  fit.summary.condition = solution.condition;
  fit.summary.unknowns = solution.coefficients.size();
  fit.summary.samples = responses.cols();
  fit.summary.iterations = 1;
  fit.summary.complete = solution.rank == coefficients;
  std::ostringstream status;
  if (fit.summary.complete)
  {
    status << "fitted to " << counted(responses.cols(), "sample");
  }
  else
  {
    status << "undetermined: the " << counted(responses.cols(), "sample")
           << (responses.cols() == 1 ? " has" : " have") << " rank " << solution.rank
           << " but a band has " << coefficients
           << " unknowns; the transform of least norm was taken, use more or more varied samples";
  }
  fit.summary.status = status.str();
  return fit;
}
}

CalibrationFit fitPseudoinverse(const SampleSet& samples, const CalibrationOptions& options)
{
  requireValid(samples, "calibration");
  return summarized(
    solveLeastSquares(withConstant(samples.response), samples.reflectance, options.rankTolerance),
    samples.response, samples.reflectance);
}

CalibrationFit fitPooled(const SampleSet& calibration, const SampleSet& tuning, double tuningWeight,
  const CalibrationOptions& options)
{
  requireValid(calibration, "calibration");
  requireValid(tuning, "tuning");
  requireSameShape(calibration, "calibration", tuning, "tuning");
  if (!(tuningWeight > 0.0) || !std::isfinite(tuningWeight))
  {
    reject("the tuning weight is ", tuningWeight, "; expected a positive finite number");
  }
  const SampleSet both = joined(calibration, tuning);
  Eigen::MatrixXd responses = withConstant(both.response);
  Eigen::MatrixXd reflectances = both.reflectance;
  responses.rightCols(tuning.size()) *= tuningWeight;
  reflectances.rightCols(tuning.size()) *= tuningWeight;
  return summarized(solveLeastSquares(responses, reflectances, options.rankTolerance),
    both.response, both.reflectance);
}

} // namespace msi
