// The CIEDE2000 color difference.
#pragma once

#include <Eigen/Core>

namespace msi
{

// The parametric factors of the viewing conditions; 1 : 1 : 1 for the reference conditions. Textile
// work often takes kL = 2.
struct CIEDE2000Factors
{
  double kL = 1.0;
  double kC = 1.0;
  double kH = 1.0;
};

// Delta E00 between CIELAB colors, L* on 0..100.
//
// Source: ISO/CIE 11664-6:2014; branches of the hue mean and difference as in Sharma, Wu and Dalal,
//         "The CIEDE2000 color-difference formula: implementation notes, supplementary test data,
//         and mathematical observations", 2005, doi 10.1002/col.20070.
// Shape:  3 x pairs; a color is a column.
// NaN:    a pair with a NaN gives NaN for itself and for no other.
// Bytes:  a pair's value does not depend on which other pairs stand in the block.
// Accuracy: relative error below 2e-12, also where the hue angle turns over, and below 1e-14 of nearly equal
//         colors (1e-3 to 1e-12 apart). Float blocks are computed in float: relative error below 4e-6 (0 below 1e-18). Symmetric to the bit; the same bytes on every instruction set.
// Cost:   SIMD; see Testing/Benchmarks. Float blocks use fused operations, ten times slower where the processor has none.
// Errors: the constructor throws std::invalid_argument unless all factors are finite and positive.
class CIEDE2000
{
public:
  explicit CIEDE2000(const CIEDE2000Factors& factors = {});

  double operator()(const Eigen::Vector3d& lab1, const Eigen::Vector3d& lab2) const noexcept;

  // Block calls, for shapes already checked: three blocks of as many columns.
  void apply(const Eigen::Ref<const Eigen::Matrix3Xd>& lab1,
    const Eigen::Ref<const Eigen::Matrix3Xd>& lab2,
    Eigen::Ref<Eigen::VectorXd> difference) const noexcept;
  void apply(const Eigen::Ref<const Eigen::Matrix3Xf>& lab1,
    const Eigen::Ref<const Eigen::Matrix3Xf>& lab2,
    Eigen::Ref<Eigen::VectorXf> difference) const noexcept;

private:
  CIEDE2000Factors Factors;
};

} // namespace msi
