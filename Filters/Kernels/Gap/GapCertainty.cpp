#include "Kernels/Gap/GapCertainty.h"

#include <cmath>

namespace msi
{

namespace
{
constexpr double DoubtfulRest = 0.05; // of the gap's size
constexpr double LeastOthers = 1e-30; // of an effect's own square
constexpr double LeastCertain = 0.2;  // of a shrink below one half
}

GapVerdict verdictOf(double shrink, double share, bool noiseAlone) noexcept
{
  if (share > 0.0 && (noiseAlone || (shrink >= ExplainedShrink && share >= ExplainedShare)))
  {
    return GapVerdict::Explained;
  }
  return share > 0.0 && shrink >= PartlyShrink ? GapVerdict::PartlyExplained
                                               : GapVerdict::Unexplained;
}

double certainPart(double shrink) noexcept
{
  return shrink * std::fmax(2.0 * shrink - 1.0, LeastCertain);
}

double doubtOf(const std::array<double, 2>& interval) noexcept
{
  const double left = 1.0 - interval[1];
  return std::fmin(std::fmax(left / DoubtfulRest, 0.0), 1.0);
}

std::vector<double> undoneParts(const Eigen::MatrixXd& products)
{
  const Eigen::Index all = products.cols() - 1;
  std::vector<double> undone;
  for (Eigen::Index e = 0; e < all; ++e)
  {
    const double square = products(e, e);
    const double against = square - products(e, all);
    if (!(against > 0.0) || !(square > 0.0))
    {
      undone.push_back(0.0);
      continue;
    }
    const double size = std::sqrt(square);
    // Not zero where the others point against it, but for rounding.
    const double others = std::sqrt(
      std::fmax(products(all, all) - 2.0 * products(e, all) + square, LeastOthers * square));
    const double reached = against / others; // of `size`, along the others
    undone.push_back(reached / size * std::fmin(reached, others) / size);
  }
  return undone;
}

} // namespace msi
