#include "Kernels/Doubts/OddOnes.h"

#include "Kernels/Numerics/OrderStatistic.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double Far = 4.0;           // deviations of the usual one
constexpr double BesideLargest = 0.1; // of the largest
constexpr std::size_t Few = 3;
constexpr std::size_t OneIn = 8; // at the most
constexpr double MuchOfLeft = 0.25;
}

IndexList oddOnes(const Eigen::VectorXd& left, std::size_t leftOut)
{
  const double usual = std::fmax(orderStatistic(left, left.size() / 2), 1.0);
  const double far = std::fmax(Far * Far * usual, BesideLargest * left.maxCoeff());
  IndexList odd;
  double ofOdd = 0.0;
  for (Eigen::Index n = 0; n < left.size(); ++n)
  {
    if (left[n] > far)
    {
      odd.push_back(n);
      ofOdd += left[n];
    }
  }
  const std::size_t all = leftOut + static_cast<std::size_t>(left.size());
  const bool few = leftOut + odd.size() <= std::max(Few, all / OneIn);
  return few && ofOdd > MuchOfLeft * left.sum() ? odd : IndexList{};
}

} // namespace msi
