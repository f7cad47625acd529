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
constexpr Eigen::Index WholeFrom = 4; // more than 1 / this of a group
}

IndexList oddOnes(const std::vector<double>& left, std::size_t leftOut)
{
  if (left.empty())
  {
    return {};
  }
  const double usual =
    std::fmax(orderStatistic(left, static_cast<std::ptrdiff_t>(left.size() / 2)), 1.0);
  const double far =
    std::fmax(Far * Far * usual, BesideLargest * *std::max_element(left.begin(), left.end()));
  IndexList odd;
  double ofOdd = 0.0;
  double all = 0.0;
  for (std::size_t n = 0; n < left.size(); ++n)
  {
    all += left[n];
    if (left[n] > far)
    {
      odd.push_back(static_cast<Eigen::Index>(n));
      ofOdd += left[n];
    }
  }
  const bool few = leftOut + odd.size() <= std::max(Few, (leftOut + left.size()) / OneIn);
  return few && ofOdd > MuchOfLeft * all ? odd : IndexList{};
}

IndexList oddElements(const Eigen::MatrixXd& left, const Eigen::MatrixXi& kind, std::size_t leftOut)
{
  IndexList elements;
  std::vector<std::vector<double>> ofKind(static_cast<std::size_t>(kind.maxCoeff()) + 1);
  for (Eigen::Index e = 0; e < left.size(); ++e)
  {
    if (!std::isnan(left(e)))
    {
      elements.push_back(e);
      ofKind[static_cast<std::size_t>(kind(e))].push_back(left(e));
    }
  }
  std::vector<double> usual;
  usual.reserve(ofKind.size());
  for (const std::vector<double>& values : ofKind)
  {
    usual.push_back(values.empty()
        ? 1.0
        : std::fmax(orderStatistic(values, static_cast<std::ptrdiff_t>(values.size() / 2)), 1.0));
  }
  std::vector<double> relative;
  relative.reserve(elements.size());
  for (const Eigen::Index e : elements)
  {
    relative.push_back(left(e) / usual[static_cast<std::size_t>(kind(e))]);
  }
  Eigen::MatrixXd others = left.array().isNaN().select(0.0, left);
  Eigen::ArrayXi count = (!left.array().isNaN()).cast<int>().colwise().sum();
  Eigen::ArrayXi single = Eigen::ArrayXi::Zero(count.size());
  IndexList odd;
  for (const Eigen::Index n : oddOnes(relative, leftOut))
  {
    odd.push_back(elements[static_cast<std::size_t>(n)]);
    others(odd.back()) = 0.0;
    ++single[odd.back() / left.rows()];
  }
  IndexList groups;
  std::vector<double> mean;
  for (Eigen::Index g = 0; g < left.cols(); ++g)
  {
    if (count[g] > 0)
    {
      groups.push_back(g);
      mean.push_back(others.col(g).sum() / count[g]);
    }
  }
  std::vector<char> whole(static_cast<std::size_t>(left.cols()), 0);
  for (const Eigen::Index n : oddOnes(mean, leftOut / static_cast<std::size_t>(left.rows())))
  {
    whole[static_cast<std::size_t>(groups[static_cast<std::size_t>(n)])] = 1;
  }
  for (const Eigen::Index g : groups)
  {
    if (whole[static_cast<std::size_t>(g)] != 0 || WholeFrom * single[g] > count[g])
    {
      for (Eigen::Index e = g * left.rows(); e < (g + 1) * left.rows(); ++e)
      {
        odd.push_back(e);
      }
    }
  }
  std::sort(odd.begin(), odd.end());
  odd.erase(std::unique(odd.begin(), odd.end()), odd.end());
  return odd;
}

} // namespace msi
