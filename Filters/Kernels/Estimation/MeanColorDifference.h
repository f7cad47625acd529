// The mean CIEDE2000 of estimated against measured tuning samples, for the color stop rule.
#pragma once

#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Estimation/MetamerismCorrection.h"

#include <Eigen/Core>

namespace msi
{

// Errors: the constructor throws std::invalid_argument where the weights do not have one column per
//         reflectance band, a weight is not finite, the white is not positive, or the threshold is
//         negative.
class MeanColorDifference
{
public:
  MeanColorDifference(const ColorStopRule& rule, const Eigen::MatrixXd& measured);
  double operator()(const Eigen::MatrixXd& estimated) const;

private:
  Eigen::Matrix3Xd labOf(const Eigen::MatrixXd& reflectance) const;

  Eigen::MatrixXd Weights;
  CIELAB Space;
  Eigen::Matrix3Xd MeasuredLab;
};

} // namespace msi
