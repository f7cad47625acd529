// Regression on products or roots of products of responses, run on blocks of pixels.
#pragma once

#include "Kernels/Estimation/ReflectanceEstimator.h"

namespace msi
{

enum class Expansion
{
  Linear,   // u_i
  Squares,  // u_i, u_i^2
  Products, // u_i, u_i u_j for i <= j
  Roots // u_i, sqrt(u_i u_j) for i < j: of the degree of the exposure; negative responses count as 0
};

// Number of terms of K channels.
Eigen::Index expansionTerms(Expansion expansion, Eigen::Index channels) noexcept;
// The terms of one pixel, in the order above.
void expand(
  Expansion expansion, const double* response, Eigen::Index channels, double* terms) noexcept;
// The same for every column.
Eigen::MatrixXd expanded(Expansion expansion, const Eigen::MatrixXd& responses);

// mean = W (terms(scale u); 1).
//
// Source: Hong, Luo and Rhodes, 2001, doi 10.1002/1520-6378(200102)26:1<76::AID-COL8>3.0.CO;2-3
//         (polynomials); Finlayson, Mackiewicz and Hurlbert, 2015, doi 10.1109/TIP.2015.2405336 (roots).
// Names:  expansion.kind (1 x 1, the numbering of Expansion), expansion.scale (K x 1),
//         expansion.coefficients (N x (terms + 1)).
// Errors: the constructor throws std::invalid_argument naming a matrix that is missing, of the wrong
//         shape or not finite.
// Cost:   2 N (terms + 1) flop per pixel, in double.
class ExpansionEstimator final : public ReflectanceEstimator
{
public:
  explicit ExpansionEstimator(const NamedMatrices& parameters);

  NamedMatrices parameters() const override { return Parameters; }
  Eigen::Index bands() const noexcept override { return Transform.outputs(); }
  Eigen::Index channels() const noexcept override { return Scale.size(); }
  using ReflectanceEstimator::apply;
  void apply(const double* response, double* mean, double* standardDeviation,
    Eigen::Index pixels) const noexcept override;

private:
  NamedMatrices Parameters;
  Expansion Kind;
  Eigen::VectorXd Scale;
  AffineTransform Transform;
};

} // namespace msi
