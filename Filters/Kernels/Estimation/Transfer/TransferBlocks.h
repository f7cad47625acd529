// The inner loop of TransferEstimator.
#pragma once

#include "Kernels/Estimation/Transfer/TransferEstimator.h"

#include <Eigen/Core>

#include <vector>

namespace msi
{

// One expert as the inner loop reads it. Points are padded to a multiple of four with zero weight,
// rows of matrices to a multiple of eight with zeros.
struct PackedTransferExpert
{
  PackedTransferExpert(const TransferExpert& expert, double shareOfMean, double shareOfVariance);

  TransferSpace space;
  double meanShare;
  double varianceShare;
  Eigen::Index channels;
  Eigen::Index bands;
  Eigen::Index points;
  double exponent;
  double priorConstant;
  double priorLinear;
  double perChannel;
  std::vector<double> gain; // feature = (space(gain v + offset) - center) * featureScale
  std::vector<double> offset;
  std::vector<double> center;
  double featureScale;
  std::vector<double> point;        // points x channels, divided by channels
  std::vector<double> pointNorm;    // |p|^2 / channels
  std::vector<double> weight;       // points x 3
  std::vector<double> mean;         // bands
  std::vector<double> coefficients; // points x stride(bands)
  std::vector<double> reduction;    // points x stride(points)
};

// The affine expert as the inner loop reads it.
struct PackedAffineExpert
{
  PackedAffineExpert(const Eigen::MatrixXd& coefficients, double shareOfMean);

  double meanShare;
  std::vector<double> constant;     // bands
  std::vector<double> coefficients; // channels x stride(bands)
};

struct PackedTransfer
{
  explicit PackedTransfer(const TransferMixture& mixture);

  std::vector<PackedTransferExpert> experts;
  PackedAffineExpert affine;
  std::vector<double> bandVariance;
};

inline Eigen::Index transferStride(Eigen::Index count) noexcept
{
  return (count + 7) / 8 * 8;
}

// Mean and standard deviation (may be null) of a mixture of experts, with the same operations in the
// same order for every pixel on every instruction set.
void runTransfer(const PackedTransfer& mixture, const double* response, double* mean,
  double* standardDeviation, Eigen::Index pixels) noexcept;

} // namespace msi
