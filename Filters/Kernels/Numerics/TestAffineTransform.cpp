#include "Kernels/Numerics/AffineTransform.h"
#include "Kernels/Numerics/NumericsTestData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstring>
#include <limits>
#include <utility>
#include <vector>

namespace
{

using msi::test::messageOf;
using msi::test::randomMatrix;

template <typename T>
std::vector<T> run(const msi::AffineTransform& transform, const std::vector<T>& in)
{
  const auto pixels = static_cast<Eigen::Index>(in.size()) / transform.inputs();
  std::vector<T> out(static_cast<std::size_t>(pixels * transform.outputs()));
  transform.apply(in.data(), out.data(), pixels);
  return out;
}

template <typename T>
std::vector<T> randomBlock(Eigen::Index size, unsigned seed)
{
  const Eigen::Matrix<T, Eigen::Dynamic, 1> values = randomMatrix(size, 1, seed).cast<T>();
  return { values.data(), values.data() + size };
}

// The bound of the header, against exact arithmetic (long double).
template <typename T>
void expectWithinBound(Eigen::Index outputs, Eigen::Index inputs)
{
  const Eigen::Index pixels = 7;
  const msi::AffineTransform transform(randomMatrix(outputs, inputs + 1, 3));
  const auto in = randomBlock<T>(inputs * pixels, 4);
  const auto out = run(transform, in);
  const double eps = static_cast<double>(std::numeric_limits<T>::epsilon()) / 2.0;
  for (Eigen::Index p = 0; p < pixels; ++p)
  {
    for (Eigen::Index row = 0; row < outputs; ++row)
    {
      long double exact = transform.constant()(row);
      long double magnitude = std::abs(transform.constant()(row));
      for (Eigen::Index k = 0; k < inputs; ++k)
      {
        const long double term = static_cast<long double>(transform.linear()(row, k)) *
          in[static_cast<std::size_t>(p * inputs + k)];
        exact += term;
        magnitude += std::abs(term);
      }
      const long double error = std::abs(out[static_cast<std::size_t>(p * outputs + row)] - exact);
      EXPECT_LE(error, (inputs + 2) * eps * magnitude)
        << outputs << " x " << inputs << " pixel " << p << " row " << row;
    }
  }
}

template <typename T>
void expectSameBytesForAnySplit(Eigen::Index outputs, Eigen::Index inputs)
{
  const Eigen::Index pixels = 23;
  const msi::AffineTransform transform(randomMatrix(outputs, inputs + 1, 5));
  const auto in = randomBlock<T>(inputs * pixels, 6);
  const auto whole = run(transform, in);
  for (const Eigen::Index piece : { 1, 2, 3, 5, 22 })
  {
    std::vector<T> pieces(whole.size());
    for (Eigen::Index first = 0; first < pixels; first += piece)
    {
      transform.apply(in.data() + first * inputs, pieces.data() + first * outputs,
        std::min(piece, pixels - first));
    }
    EXPECT_EQ(std::memcmp(whole.data(), pieces.data(), whole.size() * sizeof(T)), 0)
      << outputs << " x " << inputs << " in pieces of " << piece;
  }
}

TEST(AffineTransform, ComputesTheAffineMap)
{
  const msi::AffineTransform transform((Eigen::MatrixXd(2, 3) << 1, 2, 10, 3, 4, 20).finished());
  EXPECT_EQ(run<double>(transform, { 1, 1, 2, 5 }), (std::vector<double>{ 13, 27, 22, 46 }));
  EXPECT_EQ(run<float>(transform, { 1, 1, 2, 5 }), (std::vector<float>{ 13, 27, 22, 46 }));
}

TEST(AffineTransform, StaysWithinTheStatedBound)
{
  for (const auto& [outputs, inputs] :
    std::vector<std::pair<int, int>>{ { 31, 16 }, { 31, 9 }, { 3, 31 }, { 1, 1 }, { 64, 40 } })
  {
    expectWithinBound<double>(outputs, inputs);
    expectWithinBound<float>(outputs, inputs);
  }
}

TEST(AffineTransform, SameBytesForAnySplit)
{
  for (const auto& [outputs, inputs] :
    std::vector<std::pair<int, int>>{ { 31, 16 }, { 9, 9 }, { 3, 31 }, { 16, 4 }, { 17, 1 } })
  {
    expectSameBytesForAnySplit<double>(outputs, inputs);
    expectSameBytesForAnySplit<float>(outputs, inputs);
  }
}

TEST(AffineTransform, SameBytesOnEveryInstructionSet)
{
  const msi::AffineTransform transform(randomMatrix(31, 17, 7));
  const auto in = randomBlock<float>(16 * 50, 8);
  const auto wide = randomBlock<double>(16 * 50, 8);
  const auto expected = run(transform, in);
  const auto expectedWide = run(transform, wide);
  msi::test::withLesserInstructionSets(
    [&]
    {
      EXPECT_EQ(run(transform, in), expected);
      EXPECT_EQ(run(transform, wide), expectedWide);
    });
}

TEST(AffineTransform, NaNStaysInItsPixel)
{
  const msi::AffineTransform transform(randomMatrix(31, 17, 9));
  for (std::size_t bad = 0; bad < 6; ++bad)
  {
    auto in = randomBlock<float>(16 * 6, 10);
    const auto clean = run(transform, in);
    in[bad * 16 + 3] = std::numeric_limits<float>::quiet_NaN();
    const auto dirty = run(transform, in);
    for (std::size_t i = 0; i < dirty.size(); ++i)
    {
      EXPECT_TRUE(i / 31 == bad ? std::isnan(dirty[i]) : dirty[i] == clean[i]);
    }
  }
}

TEST(AffineTransform, ComposesAndHasAnIdentity)
{
  const msi::AffineTransform first(randomMatrix(4, 6, 11));
  const msi::AffineTransform second(randomMatrix(7, 5, 12));
  const Eigen::MatrixXd in = randomMatrix(5, 9, 13);
  const auto both = msi::AffineTransform::compose(second, first);
  EXPECT_TRUE(both(in).isApprox(second(first(in)), 1e-14));
  EXPECT_EQ(msi::AffineTransform::identity(5)(in), in);
}

TEST(AffineTransform, RefusesWhatDoesNotFitAndSaysWhy)
{
  using msi::AffineTransform;
  const AffineTransform transform(randomMatrix(31, 17, 14));
  EXPECT_EQ(messageOf([&] { transform(Eigen::MatrixXd::Zero(9, 2)); }),
    "the block has 9 values a pixel but the transform takes 16; expected the same number");
  EXPECT_EQ(messageOf([&] { AffineTransform::compose(transform, transform); }),
    "the second transform takes 16 values but the first gives 31; expected the same number");
  EXPECT_EQ(messageOf([] { AffineTransform(Eigen::MatrixXd(3, 1)); }),
    "an affine transform has 3 rows and 1 columns; expected at least one row (outputs) and two "
    "columns (inputs and constant)");
  Eigen::MatrixXd bad = Eigen::MatrixXd::Zero(2, 3);
  bad(1, 2) = std::numeric_limits<double>::infinity();
  EXPECT_EQ(messageOf([&] { AffineTransform{ bad }; }),
    "coefficient in row 2, column 3 of an affine transform is inf; expected a finite number");
}

}
