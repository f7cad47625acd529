// What a fitted method of estimation gives: from camera response to reflectance, pixel by pixel.
#pragma once

#include "Kernels/Numerics/AffineTransform.h"

#include <Eigen/Core>

#include <map>
#include <memory>
#include <string>

namespace msi
{

// Everything an estimator consists of, under stable names, so that a table or a file can keep it.
using NamedMatrices = std::map<std::string, Eigen::MatrixXd>;

// An immutable estimator of reflectance.
//
// Shapes: a block of responses is channels() x pixels, mean and standard deviation are
//         bands() x pixels, all column-major and contiguous.
// Bytes:  a pixel's result depends on the pixel alone: not on the block it is in, the thread or the
//         instruction set. A NaN or infinite response stays in its own pixel.
class ReflectanceEstimator
{
public:
  virtual ~ReflectanceEstimator() = default;

  virtual Eigen::Index bands() const noexcept = 0;
  virtual Eigen::Index channels() const noexcept = 0;
  // Whether standard deviations are given; without, they are left as they are.
  virtual bool knowsUncertainty() const noexcept { return false; }
  // What estimatorFrom() makes this estimator of again.
  virtual NamedMatrices parameters() const = 0;

  // standardDeviation may be null.
  virtual void apply(const double* response, double* mean, double* standardDeviation,
    Eigen::Index pixels) const noexcept = 0;
  // Computed in double and rounded once, unless the estimator says otherwise.
  virtual void apply(const float* response, float* mean, float* standardDeviation,
    Eigen::Index pixels) const noexcept;

  // The same for a matrix; throws std::invalid_argument, naming both numbers, unless
  // response.rows() == channels().
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& response) const;
  // 0 x 0 where the estimator does not know its uncertainty.
  Eigen::MatrixXd standardDeviation(const Eigen::MatrixXd& response) const;

protected:
  ReflectanceEstimator() = default;
  ReflectanceEstimator(const ReflectanceEstimator&) = default;
  ReflectanceEstimator(ReflectanceEstimator&&) = default;
  ReflectanceEstimator& operator=(const ReflectanceEstimator&) = default;
  ReflectanceEstimator& operator=(ReflectanceEstimator&&) = default;

private:
  void requireChannels(const Eigen::MatrixXd& response) const;
};

// An affine transform of the response. Float blocks are computed in float.
class AffineEstimator final : public ReflectanceEstimator
{
public:
  explicit AffineEstimator(AffineTransform transform);

  const AffineTransform& transform() const noexcept { return Transform; }

  Eigen::Index bands() const noexcept override { return Transform.outputs(); }
  Eigen::Index channels() const noexcept override { return Transform.inputs(); }
  // affine.coefficients, N x (K+1).
  NamedMatrices parameters() const override;
  void apply(const double* response, double* mean, double* standardDeviation,
    Eigen::Index pixels) const noexcept override;
  void apply(const float* response, float* mean, float* standardDeviation,
    Eigen::Index pixels) const noexcept override;

private:
  AffineTransform Transform;
};

// The estimator of these parameters, whatever its kind; throws std::invalid_argument where they belong
// to none, or are missing, of the wrong shape or not finite.
std::shared_ptr<const ReflectanceEstimator> estimatorFrom(const NamedMatrices& parameters);

// The matrix of that name; a size other than AnySize must agree. Throws std::invalid_argument naming
// the matrix where it is missing, empty, of another shape, or holds a value that is not finite; 'owner'
// is what has the matrices, for example "the kernel estimator".
constexpr Eigen::Index AnySize = -1;
const Eigen::MatrixXd& requireMatrix(const NamedMatrices& parameters, const std::string& name,
  Eigen::Index rows, Eigen::Index columns, const std::string& owner);

} // namespace msi
