// y = A x + a: from camera response to reflectance, or from response to response.
#pragma once

#include <Eigen/Core>

#include <vector>

namespace msi
{

// An immutable affine transform, run on blocks of pixels.
//
// Source:   W and D in "Correcting cross-media instrument metamerism for reflectance estimation in
//           multispectral imaging", 2011, doi 10.1364/JOSAA.28.000511, Eqs. 4, 10, 14; there the
//           constant is appended to u.
// Shapes:   coefficients are outputs x (inputs + 1); the last column is the constant a.
//           A block is inputs x pixels, column-major and contiguous: one pixel after the other, the
//           tuple order of a VTK array.
// Errors:   the constructor throws std::invalid_argument for an empty matrix, a matrix of one column
//           only (no input), and for a coefficient that is not finite (row and column are named).
// Accuracy: sums run from the constant through input 1, 2, ...; every product and sum is rounded
//           once (no fused operation). So a pixel's bytes depend on nothing but the pixel: not on the
//           block, its place in it, the thread or the instruction set. Against exact arithmetic the
//           error is at most (inputs + 2) eps (|A| |x| + |a|), with eps = 2^-53 for double and, for
//           float, eps = 2^-24 (the coefficients are rounded to float once; those below TinyCoefficient of the
//           largest of their row count as 0).
//           A NaN or infinity stays in its own pixel.
// Cost:     2 x inputs x outputs flop a pixel; SIMD chosen at run time (Highway).
class AffineTransform
{
public:
  static constexpr double TinyCoefficient = 0x1p-100;

  explicit AffineTransform(Eigen::MatrixXd coefficients);
  static AffineTransform identity(Eigen::Index size);

  Eigen::Index inputs() const noexcept { return Coefficients.cols() - 1; }
  Eigen::Index outputs() const noexcept { return Coefficients.rows(); }
  const Eigen::MatrixXd& coefficients() const noexcept { return Coefficients; }
  auto linear() const noexcept { return Coefficients.leftCols(inputs()); }
  auto constant() const noexcept { return Coefficients.col(inputs()); }

  // in: inputs() values a pixel, out: outputs() values a pixel; they must not overlap.
  void apply(const double* in, double* out, Eigen::Index pixels) const noexcept;
  void apply(const float* in, float* out, Eigen::Index pixels) const noexcept;

  // The same for a whole matrix, one column per pixel; throws std::invalid_argument, naming both
  // numbers, unless in.rows() equals inputs().
  Eigen::MatrixXd operator()(const Eigen::MatrixXd& in) const;

  // x -> after(before(x)); throws std::invalid_argument unless after.inputs() == before.outputs().
  static AffineTransform compose(const AffineTransform& after, const AffineTransform& before);

private:
  Eigen::MatrixXd Coefficients;
  // As AffineCoefficients wants them.
  std::vector<double> PackedDouble;
  std::vector<float> PackedFloat;
};

} // namespace msi
