// The inner loop of AffineTransform.
#pragma once

#include <Eigen/Core>

namespace msi
{

// Coefficients as the inner loop reads them: the constant, then one column per input, each of
// 'outputs' values and zeros up to 'stride'.
template <typename T>
struct AffineCoefficients
{
  const T* values;
  Eigen::Index inputs;
  Eigen::Index outputs;
  Eigen::Index stride;
};

// At least the widest vector of any instruction set Highway dispatches to here (512 bit).
template <typename T>
constexpr Eigen::Index AffineStrideUnit = static_cast<Eigen::Index>(64 / sizeof(T));

void runAffine(const AffineCoefficients<double>& coefficients, const double* in, double* out,
  Eigen::Index pixels) noexcept;
void runAffine(const AffineCoefficients<float>& coefficients, const float* in, float* out,
  Eigen::Index pixels) noexcept;

} // namespace msi
