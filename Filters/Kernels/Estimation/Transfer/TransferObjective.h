// What the method "transfer" minimizes over its hyperparameters, with the gradient.
#pragma once

#include "Kernels/Estimation/Transfer/TransferFeatures.h"
#include "Kernels/Estimation/Transfer/TransferKernel.h"

#include <Eigen/Core>

namespace msi
{

// -log p(tuning | chart) - min(1, L_T / L_A) log p(chart) - log prior, up to a constant, as a function
// of the kernel's logarithms and of the gains and offsets of the target. So both sets have the same
// say, and the chart counts in full for what it tells about the tuning samples.
//
// The outputs are the centered reflectances in the expert's space, one row a sample, chart first;
// their common scale is profiled out, and they count as four independent ones, as many as
// reflectances vary in to first order.
// Cost: n^3 multiplications and additions a call for n samples, a third each for the Cholesky factor, its
// inverse and their product; n^2 / 2 exponentials.
// Prior: normal, of the logarithms with deviation 2 around values for features and outputs of unit
// variance; of log gains with deviation 0.1 and of offsets with 0.05 of the response scale, half of
// it common to the channels, half smooth over them, a twentieth of each channel's own.
class TransferObjective
{
public:
  TransferObjective(const TransferFeatures& start, const Eigen::MatrixXd& chartResponses,
    const Eigen::MatrixXd& tuningResponses, const Eigen::MatrixXd& outputs);

  // The prior's center.
  Eigen::VectorXd start() const;
  TransferKernel kernelAt(const Eigen::VectorXd& at) const;
  TransferFeatures featuresAt(const Eigen::VectorXd& at) const;

  // Infinite where the covariance matrix is not numerically positive.
  double operator()(const Eigen::VectorXd& at, Eigen::VectorXd& gradient);

private:
  // Sums of the derivative by the covariance matrix times the parts of the kernel.
  struct Sums
  {
    double constant = 0.0;
    double linear = 0.0;
    double smooth = 0.0;
    double length = 0.0;
    double noise = 0.0;
  };

  // |x_i - x_j|^2 / K for i >= j, as an expression.
  auto squaredDistancesBelow(Eigen::Index j) const;
  // Norms and the lower triangles of Products, Smooth and Matrix, the covariance matrix.
  void computeCovariance(const TransferKernel& kernel);
  // Without priors. Turns Matrix into the inverse of its Cholesky factor and fills the lower triangle of
  // Sensitivity, the derivative by the covariance matrix.
  double likelihood();
  // Over columns [first, end) from the diagonal down, and the rows that mirror them.
  Sums sumsOver(Eigen::Index first, Eigen::Index end) const;
  // Adds the derivative by gains and offsets, given that by the target's features.
  void chainThroughFeatures(const TransferFeatures& features, const Eigen::MatrixXd& byFeatures,
    Eigen::VectorXd& gradient) const;

  TransferFeatures Features;
  Eigen::MatrixXd TuningResponses;
  Eigen::Index Chart;
  Eigen::Index Tuning;
  Eigen::Index Channels;
  double ChartShare;
  Eigen::VectorXd Center; // of the kernel's prior
  Eigen::MatrixXd Factor; // of the channels' prior covariance
  Eigen::MatrixXd X;
  Eigen::MatrixXd Y; // a column for each sample
  // Kept from call to call: fresh matrices of this size cost as much in page faults as the arithmetic.
  Eigen::ArrayXd Norms;     // x.x/K
  Eigen::MatrixXd Products; // x.x'/K
  Eigen::MatrixXd Smooth;   // exp(-|x - x'|^2 / (2 K length^2))
  Eigen::MatrixXd Matrix;
  Eigen::MatrixXd Sensitivity;
  Eigen::MatrixXd Work;
};

} // namespace msi
