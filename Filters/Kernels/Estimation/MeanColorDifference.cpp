#include "Kernels/Estimation/MeanColorDifference.h"

#include "Kernels/Difference/CIEDE2000.h"
#include "Kernels/Estimation/SampleSet.h"
#include "Kernels/Spectra/Reject.h"

namespace msi
{

MeanColorDifference::MeanColorDifference(const ColorStopRule& rule, const Eigen::MatrixXd& measured)
  : Weights(rule.tristimulusWeights)
  , Space(rule.white)
{
  if (Weights.rows() != 3 || Weights.cols() != measured.rows())
  {
    reject("the tristimulus weights of the color stop rule are ", Weights.rows(), " x ",
      Weights.cols(), "; expected 3 x ", measured.rows(), ", a column per reflectance band");
  }
  requireFinite(Weights, "tristimulus weights", "row");
  if (!(rule.threshold >= 0.0))
  {
    reject("the threshold of the color stop rule is ", rule.threshold,
      "; expected a number of CIEDE2000 units that is not negative");
  }
  MeasuredLab = labOf(measured);
}

double MeanColorDifference::operator()(const Eigen::MatrixXd& estimated) const
{
  const Eigen::Matrix3Xd lab = labOf(estimated);
  Eigen::VectorXd differences(lab.cols());
  CIEDE2000().apply(MeasuredLab, lab, differences);
  return differences.mean();
}

Eigen::Matrix3Xd MeanColorDifference::labOf(const Eigen::MatrixXd& reflectance) const
{
  Eigen::Matrix3Xd lab = Weights * reflectance;
  Space.fromXYZ(lab, lab);
  return lab;
}

} // namespace msi
