// What the tests of all rooms of kernels share: random matrices, error texts, instruction sets.
#pragma once

#include <hwy/targets.h>

#include <Eigen/Core>

#include <gtest/gtest.h>

#include <cstdint>
#include <limits>
#include <random>
#include <stdexcept>
#include <string>

namespace msi::test
{

constexpr double NaN = std::numeric_limits<double>::quiet_NaN();

// Calls check() with the best instruction set of this processor off, then the two best, and so on.
template <typename Check>
void withLesserInstructionSets(const Check& check)
{
  std::uint32_t disabled = 0;
  for (std::uint32_t best = hwy::SupportedTargets(); (best & (best - 1)) != 0;
       best = hwy::SupportedTargets())
  {
    disabled |= best & (~best + 1U);
    hwy::DisableTargets(disabled);
    SCOPED_TRACE("without targets " + std::to_string(disabled));
    check();
  }
  hwy::DisableTargets(0);
  EXPECT_NE(disabled, 0U) << "only one instruction set was tried";
}

inline double largestDifference(const Eigen::MatrixXd& a, const Eigen::MatrixXd& b)
{
  if (a.rows() != b.rows() || a.cols() != b.cols())
  {
    return std::numeric_limits<double>::infinity();
  }
  return (a - b).cwiseAbs().maxCoeff();
}

template <typename F>
std::string messageOf(F&& call)
{
  try
  {
    call();
  }
  catch (const std::invalid_argument& error)
  {
    return error.what();
  }
  return {};
}

inline Eigen::MatrixXd randomMatrix(Eigen::Index rows, Eigen::Index columns, unsigned seed)
{
  std::mt19937_64 generator(seed);
  std::uniform_real_distribution<double> uniform(-1.0, 1.0);
  return Eigen::MatrixXd::NullaryExpr(rows, columns, [&] { return uniform(generator); });
}

} // namespace msi::test
