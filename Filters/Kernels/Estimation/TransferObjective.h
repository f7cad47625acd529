// What the method "transfer" minimizes over its hyperparameters, with the gradient.
#pragma once

#include "Kernels/Estimation/TransferFeatures.h"
#include "Kernels/Estimation/TransferKernel.h"

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
  // Without priors; sensitivity is the derivative by the covariance matrix.
  double likelihood(const Eigen::MatrixXd& covarianceMatrix, Eigen::MatrixXd& sensitivity) const;
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
  Eigen::MatrixXd Y;
};

} // namespace msi
