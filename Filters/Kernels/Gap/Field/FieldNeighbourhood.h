// The moved and blurred scene of a block, and its derivatives.
#pragma once

#include "Kernels/Gap/Field/FieldData.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// Cubic convolution for a displacement (as ChannelRegistration) with a Gaussian of a variance, along one axis.
class AxisKernels
{
public:
  // A kernel with weights from `first` on.
  struct Taps
  {
    int first = 0;
    std::vector<double> weight;
  };

  AxisKernels(double displacement, double variance);

  Taps value, shift, blur; // itself, its derivatives by displacement and variance
};

struct FieldNeighbourhood
{
  Eigen::ArrayXXd value, right, down, blur; // width x height

  // derivatives: false leaves right, down and blur empty.
  FieldNeighbourhood(const FieldData& data, const ImageWindow& window, Eigen::Index channel,
    const AxisKernels& x, const AxisKernels& y, bool derivatives);
};

} // namespace msi
