// One Gaussian process of the method "transfer", fitted and ready to predict.
#pragma once

#include "Kernels/Estimation/SampleSet.h"
#include "Kernels/Estimation/Transfer/TransferFeatures.h"
#include "Kernels/Estimation/Transfer/TransferKernel.h"
#include "Kernels/Estimation/Transfer/TransferSpace.h"

#include <Eigen/Core>

namespace msi
{

// The posterior at a target response with features x, in the expert's space:
//   mean = center + coefficients' k,   variance = priorConstant + priorLinear x.x/K - k' reduction k,
// with k_j = constant_j + linear_j x.p_j/K + smooth_j exp(-|x - p_j|^2 / (2 K length^2)).
// The variance is of a measurement, in units that are common to all bands; see bandVariance in
// TransferEstimation.
struct TransferExpert
{
  TransferFeatures features;
  Eigen::MatrixXd points;  // K x m, features of the samples that carry the posterior
  Eigen::MatrixXd weights; // 3 x m: constant, linear, smooth
  double length = 1.0;
  double priorConstant = 0.0;
  double priorLinear = 0.0;
  Eigen::MatrixXd coefficients; // m x N
  Eigen::VectorXd center;       // N
  Eigen::MatrixXd reduction;    // m x m, symmetric
};

struct TransferExpertFit
{
  TransferExpert expert;
  // Per sample, chart first: the estimate without the sample itself (hyperparameters kept), and the
  // variance the model expects of it.
  Eigen::MatrixXd leftOutEstimate; // N x (L_A + L_T), reflectance
  Eigen::VectorXd leftOutVariance;
  // The same estimate of the tuning samples, with hyperparameters that were fitted without the sample, too; of
  // fitTransferExpert alone.
  Eigen::MatrixXd refittedEstimate; // N x L_T, reflectance
  int iterations = 0;
  bool converged = false;
};

// The posterior of given hyperparameters; 'center' is subtracted from the reflectances in the expert's
// space.
TransferExpertFit transferPosterior(const TransferKernel& kernel, const TransferFeatures& features,
  const SampleSet& calibration, const SampleSet& tuning, const Eigen::VectorXd& center);

// Hyperparameters are learned from at most 300 samples, spread evenly where there are more; the posterior rests on all of
// them through at most 256 points (fully independent training conditional), chosen by pivoted
// Cholesky decomposition until what they leave unexplained is a hundredth of the noise. For refittedEstimate they are
// fitted again without each eighth of the tuning samples, starting from those of all samples; without `refits` it is the left-out
// estimate.
// Sources: Rasmussen and Williams, "Gaussian Processes for Machine Learning", 2006, Eqs. 2.25, 5.12;
//          Snelson and Ghahramani, "Sparse Gaussian processes using pseudo-inputs", 2005.
TransferExpertFit fitTransferExpert(
  TransferSpace space, const SampleSet& calibration, const SampleSet& tuning, bool refits = true);

} // namespace msi
