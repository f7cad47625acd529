#include "Kernels/Estimation/RModelCorrection.h"

#include "Kernels/Estimation/SampleSet.h"
#include "Kernels/Numerics/LeastSquares.h"
#include "Kernels/Spectra/Counted.h"
#include "Kernels/Spectra/Reject.h"

#include <sstream>

namespace msi
{

RModelFit fitRModel(const Eigen::MatrixXd& estimated, const Eigen::MatrixXd& measured)
{
  requireFinite(estimated, "estimated reflectance");
  requireFinite(measured, "measured reflectance");
  if (estimated.rows() != measured.rows() || estimated.cols() != measured.cols())
  {
    reject("estimated reflectance is ", estimated.rows(), " bands x ", estimated.cols(),
      " samples but measured reflectance is ", measured.rows(), " x ", measured.cols(),
      "; expected the same shape");
  }
  const Eigen::Index unknowns = unknownsPerRow(estimated.rows(), 1);
  if (estimated.rows() < 1 || estimated.cols() < unknowns)
  {
    reject("the R-model has ", counted(estimated.cols(), "tuning sample"), " for ",
      counted(unknowns, "unknown"), " a band; expected at least ", counted(unknowns, "sample"));
  }
  const BandedFit banded = fitBanded(estimated, measured, 1);
  RModelFit fit{ AffineTransform(banded.coefficients), {} };
  fit.summary.residualRms = rootMeanSquare(fit.correction(estimated) - measured);
  fit.summary.rank = banded.rank;
  fit.summary.condition = banded.condition;
  fit.summary.unknowns = banded.unknowns;
  fit.summary.samples = estimated.cols();
  fit.summary.iterations = 1;
  fit.summary.complete = banded.deficientRows.empty();
  std::ostringstream status;
  status << "fitted to " << counted(estimated.cols(), "tuning sample");
  if (!fit.summary.complete)
  {
    status << "; undetermined and kept nearest to no change in " << banded.deficientRows.size()
           << " of " << estimated.rows() << " bands";
  }
  fit.summary.status = status.str();
  return fit;
}

} // namespace msi
