#undef HWY_TARGET_INCLUDE
#define HWY_TARGET_INCLUDE "Kernels/Numerics/LowerTriangle.cpp"
#include <hwy/foreach_target.h>

#include "Kernels/Numerics/LowerTriangle.h"

#include <hwy/highway.h>

#include <Eigen/Cholesky>

#include <algorithm>

HWY_BEFORE_NAMESPACE();
namespace msi
{
namespace HWY_NAMESPACE
{
namespace hn = hwy::HWY_NAMESPACE;

struct Factors
{
  const double* a;
  Eigen::Index aStride; // from column to column; rows are neighbours
  const double* b;
  Eigen::Index bRowStride;
  Eigen::Index bColumnStride;
  Eigen::Index inner;
};

// Rows of 'Vectors' vectors times one or four columns.
template <int Vectors, int Columns, class D>
HWY_INLINE void addTile(D d, const Factors& f, double* sum, Eigen::Index sumStride)
{
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  const auto zero = hn::Zero(d);
  auto low0 = zero;
  auto low1 = zero;
  auto low2 = zero;
  auto low3 = zero;
  auto high0 = zero;
  auto high1 = zero;
  auto high2 = zero;
  auto high3 = zero;
  const double* a = f.a;
  const double* b = f.b;
  for (Eigen::Index k = 0; k < f.inner; ++k, a += f.aStride, b += f.bRowStride)
  {
    const auto add = [&](auto& low, auto& high, Eigen::Index column) HWY_ATTR
    {
      const auto factor = hn::Set(d, b[column * f.bColumnStride]);
      low = hn::Add(low, hn::Mul(hn::LoadU(d, a), factor));
      if constexpr (Vectors == 2)
      {
        high = hn::Add(high, hn::Mul(hn::LoadU(d, a + lanes), factor));
      }
    };
    add(low0, high0, 0);
    if constexpr (Columns == 4)
    {
      add(low1, high1, 1);
      add(low2, high2, 2);
      add(low3, high3, 3);
    }
  }
  const auto store = [&](auto low, auto high, Eigen::Index column) HWY_ATTR
  {
    double* out = sum + column * sumStride;
    hn::StoreU(hn::Add(hn::LoadU(d, out), low), d, out);
    if constexpr (Vectors == 2)
    {
      hn::StoreU(hn::Add(hn::LoadU(d, out + lanes), high), d, out + lanes);
    }
  };
  store(low0, high0, 0);
  if constexpr (Columns == 4)
  {
    store(low1, high1, 1);
    store(low2, high2, 2);
    store(low3, high3, 3);
  }
}

template <int Vectors, class D>
HWY_INLINE void addRows(D d, Factors f, double* sum, Eigen::Index sumStride, Eigen::Index columns)
{
  Eigen::Index column = 0;
  for (; column + 4 <= columns; column += 4)
  {
    addTile<Vectors, 4>(d, f, sum, sumStride);
    f.b += 4 * f.bColumnStride;
    sum += 4 * sumStride;
  }
  for (; column < columns; ++column)
  {
    addTile<Vectors, 1>(d, f, sum, sumStride);
    f.b += f.bColumnStride;
    sum += sumStride;
  }
}

// The rows that are left go to vectors of half the width, down to single numbers.
template <std::size_t Lanes>
HWY_INLINE void addRest(
  Factors f, double* sum, Eigen::Index sumStride, Eigen::Index rows, Eigen::Index columns)
{
  const hn::CappedTag<double, Lanes> d;
  const auto lanes = static_cast<Eigen::Index>(hn::Lanes(d));
  for (; rows >= lanes; rows -= lanes, f.a += lanes, sum += lanes)
  {
    addRows<1>(d, f, sum, sumStride, columns);
  }
  if constexpr (Lanes > 1)
  {
    addRest<Lanes / 2>(f, sum, sumStride, rows, columns);
  }
}

void addAll(const Eigen::Ref<const Eigen::MatrixXd>& a, const double* b, Eigen::Index bRowStride,
  Eigen::Index bColumnStride, Eigen::Ref<Eigen::MatrixXd> result)
{
  constexpr std::size_t Widest = 8;
  const hn::CappedTag<double, Widest> d;
  const auto two = 2 * static_cast<Eigen::Index>(hn::Lanes(d));
  Factors f{ a.data(), a.outerStride(), b, bRowStride, bColumnStride, a.cols() };
  double* sum = result.data();
  const Eigen::Index sumStride = result.outerStride();
  const Eigen::Index columns = result.cols();
  Eigen::Index rows = result.rows();
  for (; rows >= two; rows -= two, f.a += two, sum += two)
  {
    addRows<2>(d, f, sum, sumStride, columns);
  }
  addRest<Widest>(f, sum, sumStride, rows, columns);
}

} // namespace HWY_NAMESPACE
} // namespace msi
HWY_AFTER_NAMESPACE();

#if HWY_ONCE
namespace msi
{

HWY_EXPORT(addAll);

namespace
{
using Block = Eigen::Ref<Eigen::MatrixXd>;
using ConstBlock = Eigen::Ref<const Eigen::MatrixXd>;

// Rows or columns that are worked on together where half of a matrix is zero; no more are factored at once.
constexpr Eigen::Index PanelSize = 32;

template <typename Act>
void forPanels(Eigen::Index size, const Act& act)
{
  for (Eigen::Index first = 0; first < size; first += PanelSize)
  {
    act(first, std::min(first + PanelSize, size));
  }
}

// sum += a b; sum += a b'
void addProduct(const Block& sum, const ConstBlock& a, const ConstBlock& b)
{
  HWY_DYNAMIC_DISPATCH(addAll)(a, b.data(), 1, b.outerStride(), sum);
}

void addTransposedProduct(const Block& sum, const ConstBlock& a, const ConstBlock& b)
{
  HWY_DYNAMIC_DISPATCH(addAll)(a, b.data(), b.outerStride(), 1, sum);
}
}

void addOuterProduct(Block sum, const ConstBlock& a, const ConstBlock& b)
{
  forPanels(sum.cols(),
    [&](Eigen::Index first, Eigen::Index end)
    {
      const Eigen::Index below = sum.rows() - first;
      addTransposedProduct(sum.block(first, first, below, end - first), a.bottomRows(below),
        b.middleRows(first, end - first));
    });
}

void addSquare(Block sum, const ConstBlock& lower, Block work)
{
  const Eigen::Index size = lower.rows();
  auto upper = work.topLeftCorner(size, size);
  upper = lower.transpose();
  forPanels(size,
    [&](Eigen::Index first, Eigen::Index end)
    {
      const auto panel = upper.block(0, first, end, end - first);
      addOuterProduct(sum.topLeftCorner(end, end), panel, panel);
    });
}

void addTimesLower(Block sum, const ConstBlock& a, const ConstBlock& lower)
{
  forPanels(lower.cols(),
    [&](Eigen::Index first, Eigen::Index end)
    {
      const Eigen::Index below = lower.rows() - first;
      addProduct(sum.middleCols(first, end - first), a.rightCols(below),
        lower.block(first, first, below, end - first));
    });
}

void addTimesTransposedLower(Block sum, const ConstBlock& a, const ConstBlock& lower)
{
  forPanels(lower.cols(),
    [&](Eigen::Index first, Eigen::Index end)
    {
      addTransposedProduct(sum.middleCols(first, end - first), a.leftCols(end),
        lower.block(first, 0, end - first, end));
    });
}

bool invertFactor(Block matrix, Eigen::Ref<Eigen::VectorXd> diagonal, Block work)
{
  const Eigen::Index size = matrix.rows();
  if (size <= PanelSize)
  {
    const Eigen::LLT<Block> cholesky(matrix);
    diagonal = matrix.diagonal();
    auto inverse = work.topLeftCorner(size, size);
    inverse.setIdentity();
    matrix.triangularView<Eigen::Lower>().solveInPlace(inverse);
    matrix = inverse;
    return cholesky.info() == Eigen::Success;
  }
  // With the factor in four blocks, A, 0 above C, D: its inverse is A^-1, 0 above -D^-1 C A^-1, D^-1.
  const Eigen::Index upper = size / 2;
  const Eigen::Index lower = size - upper;
  auto a = matrix.topLeftCorner(upper, upper);
  auto c = matrix.bottomLeftCorner(lower, upper);
  auto d = matrix.bottomRightCorner(lower, lower);
  auto product = work.topLeftCorner(lower, upper);
  if (!invertFactor(a, diagonal.head(upper), work))
  {
    return false;
  }
  product.setZero();
  addTimesTransposedLower(product, c, a);
  c = -product;
  addOuterProduct(d, c, product);
  if (!invertFactor(d, diagonal.tail(lower), work))
  {
    return false;
  }
  product.setZero();
  addTimesLower(product, c, a);
  c.setZero();
  forPanels(lower,
    [&](Eigen::Index first, Eigen::Index end)
    {
      addProduct(c.middleRows(first, end - first), d.block(first, 0, end - first, end),
        product.topRows(end));
    });
  matrix.topRightCorner(upper, lower).setZero();
  return true;
}

} // namespace msi
#endif
