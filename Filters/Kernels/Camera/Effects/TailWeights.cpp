#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Camera/Effects/TailWeights.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Camera/Effects/TailWeights.h"

#include <hwy/highway.h>

#include <algorithm>
#include <cmath>
#include <utility>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

struct Terms
{
  const double* columns;
  std::size_t rows;
  const int* chosen;
  const double* weights;
  std::size_t count;
};

// Rows from `first` on, one vector from there and three more from `second`, `third`, `fourth` on: apart, for the sums of
// one vector wait for one another. Vectors may overlap; what they share comes out the same.
template <class D>
HWY_INLINE void sumFour(D d, const Terms& terms, double* sum, std::size_t first, std::size_t second,
  std::size_t third, std::size_t fourth)
{
  auto sum0 = hn::Zero(d);
  auto sum1 = sum0;
  auto sum2 = sum0;
  auto sum3 = sum0;
  for (std::size_t i = 0; i < terms.count; ++i)
  {
    const auto weight = hn::Set(d, terms.weights[i]);
    const double* column = terms.columns + static_cast<std::size_t>(terms.chosen[i]) * terms.rows;
    sum0 = hn::Add(sum0, hn::Mul(weight, hn::LoadU(d, column + first)));
    sum1 = hn::Add(sum1, hn::Mul(weight, hn::LoadU(d, column + second)));
    sum2 = hn::Add(sum2, hn::Mul(weight, hn::LoadU(d, column + third)));
    sum3 = hn::Add(sum3, hn::Mul(weight, hn::LoadU(d, column + fourth)));
  }
  hn::StoreU(sum0, d, sum + first);
  hn::StoreU(sum1, d, sum + second);
  hn::StoreU(sum2, d, sum + third);
  hn::StoreU(sum3, d, sum + fourth);
}

// All rows; at least as many as the vector has lanes.
template <class D>
HWY_INLINE void sumRows(D d, const Terms& terms, double* sum)
{
  const std::size_t lanes = hn::Lanes(d);
  const std::size_t last = terms.rows - lanes;
  for (std::size_t first = 0; first < terms.rows; first += 4 * lanes)
  {
    sumFour(d, terms, sum, std::min(first, last), std::min(first + lanes, last),
      std::min(first + 2 * lanes, last), std::min(first + 3 * lanes, last));
  }
}

// sum = weights[0] column(chosen[0]) + weights[1] column(chosen[1]) + ..., in this order, every product and sum rounded
// once. columns: `rows` values a column, one column after the other.
void sumColumns(const double* columns, std::size_t rows, const int* chosen, const double* weights,
  std::size_t count, double* sum)
{
  const Terms terms{ columns, rows, chosen, weights, count };
  const hn::ScalableTag<double> d;
  const hn::CappedTag<double, 2> two;
  const hn::CappedTag<double, 1> one;
  if (rows >= hn::Lanes(d))
  {
    sumRows(d, terms, sum);
  }
  else if (rows >= hn::Lanes(two))
  {
    sumRows(two, terms, sum);
  }
  else
  {
    sumRows(one, terms, sum);
  }
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(sumColumns);

TailWeights::TailWeights(const SampleScene& scene, double reach, std::vector<char> usable)
  : Reach(reach)
  , Usable(std::move(usable))
{
  std::vector<double> weight;
  weight.reserve(scene.distances().size());
  for (const double pitches : scene.distances())
  {
    weight.push_back(std::exp(-pitches / reach));
  }
  for (const std::vector<SampleScene::Other>& surround : scene.surround())
  {
    First.push_back(Others.size());
    Sums.push_back(0.0);
    for (const SampleScene::Other& other : surround)
    {
      if (Usable[static_cast<std::size_t>(other.sample)] != 0)
      {
        Others.push_back(other.sample);
        Weights.push_back(weight[static_cast<std::size_t>(other.distance)]);
        Sums.back() += Weights.back();
      }
    }
  }
  First.push_back(Others.size());
}

Eigen::MatrixXd TailWeights::mean(const Eigen::MatrixXd& signal) const
{
  Eigen::MatrixXd surround(signal.rows(), signal.cols());
  for (Eigen::Index j = 0; j < signal.cols(); ++j)
  {
    const std::size_t first = First[static_cast<std::size_t>(j)];
    const std::size_t end = First[static_cast<std::size_t>(j) + 1];
    const double sum = Sums[static_cast<std::size_t>(j)];
    if (sum > 0.0)
    {
      HWY_DYNAMIC_DISPATCH(sumColumns)
      (signal.data(), static_cast<std::size_t>(signal.rows()), Others.data() + first,
        Weights.data() + first, end - first, surround.col(j).data());
      surround.col(j) /= sum;
    }
    else
    {
      surround.col(j) = signal.col(j);
    }
  }
  return surround;
}

} // namespace msi
#endif
