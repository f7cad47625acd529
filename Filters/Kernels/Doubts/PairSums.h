// What a real and a simulated series of values have in common.
#pragma once

#include <Eigen/Core>

#include <cmath>
#include <vector>

namespace msi
{

// Sums over the places at which both have a value.
struct PairSums
{
  double n = 0.0, real = 0.0, simulated = 0.0;
  double realSquares = 0.0, simulatedSquares = 0.0, products = 0.0;

  template <typename Scalar>
  void add(Scalar realValue, Scalar simulatedValue) noexcept
  {
    const auto r = static_cast<double>(realValue);
    const auto s = static_cast<double>(simulatedValue);
    if (std::isfinite(r) && std::isfinite(s))
    {
      n += 1.0;
      real += r;
      simulated += s;
      realSquares += r * r;
      simulatedSquares += s * s;
      products += r * s;
    }
  }
  // About the means.
  double ofReal() const noexcept { return realSquares - real * real / count(); }
  double ofSimulated() const noexcept { return simulatedSquares - simulated * simulated / count(); }
  double ofBoth() const noexcept { return products - real * simulated / count(); }
  // Squared and with its sign.
  double correlation() const noexcept
  {
    return ofBoth() * std::fabs(ofBoth()) / (ofSimulated() * std::fmax(ofReal(), 1e-300));
  }
  // The deviation of what is simulated is small beside it.
  bool isFlat() const noexcept { return ofSimulated() <= Flat * Flat * simulatedSquares; }
  // What is real is the same everywhere but for rounding.
  bool isSteady() const noexcept { return ofReal() <= Rounding * realSquares; }
  // Of the straight line through the origin: its slope, and the squares that it leaves.
  double gain() const noexcept { return products / std::fmax(simulatedSquares, 1e-30); }
  double left() const noexcept { return realSquares - gain() * products; }

private:
  static constexpr double Flat = 0.05;
  static constexpr double Rounding = 1e-9;
  double count() const noexcept { return std::fmax(n, 1.0); }
};

inline PairSums sumsOf(const Eigen::VectorXd& observed, const Eigen::VectorXd& simulated)
{
  PairSums sums;
  for (Eigen::Index i = 0; i < observed.size(); ++i)
  {
    sums.add(observed[i], simulated[i]);
  }
  return sums;
}

// Of each channel, K x S.
inline std::vector<PairSums> sumsOfChannels(
  const Eigen::MatrixXd& observed, const Eigen::MatrixXd& simulated)
{
  std::vector<PairSums> sums;
  for (Eigen::Index k = 0; k < observed.rows(); ++k)
  {
    sums.push_back(sumsOf(observed.row(k), simulated.row(k)));
  }
  return sums;
}

} // namespace msi
