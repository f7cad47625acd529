// What an effect does to numbers, by the place where it acts, and short ways to say it. Internal to the simulator.
#pragma once

#include "Kernels/Camera/Effects/BoundEffect.h"

#include <Eigen/Core>

#include <cstddef>
#include <memory>
#include <type_traits>
#include <utility>

namespace msi
{

template <typename Scalar>
using Block = Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>>;
template <typename Scalar>
using ConstBlock = Eigen::Ref<const Eigen::Matrix<Scalar, Eigen::Dynamic, Eigen::Dynamic>>;

// What is known about the columns of a block; one value a column. A null pointer: not known.
struct ColumnContext
{
  const int* medium = nullptr; // number among the media that effects act on, -1 for all others
  const double* fieldX = nullptr;
  const double* fieldY = nullptr;
  const double* time = nullptr;
};

// Changes the responsivity K x N once.
class ResponsivityOperator
{
public:
  virtual ~ResponsivityOperator() = default;
  virtual void apply(Eigen::MatrixXd& responsivity) const = 0;
};

// Changes a block in place, column by column: reflectances N x P or responses K x P. An element's bytes
// depend on its own column alone.
class BlockOperator
{
public:
  virtual ~BlockOperator() = default;
  virtual void apply(Block<double> block, const ColumnContext& columns) const noexcept = 0;
  virtual void apply(Block<float> block, const ColumnContext& columns) const noexcept = 0;
};

// Calls run(block, columns) in both precisions.
template <typename Run>
class BlockOperatorOf final : public BlockOperator
{
public:
  explicit BlockOperatorOf(Run run)
    : Both(std::move(run))
  {
  }
  void apply(Block<double> block, const ColumnContext& columns) const noexcept override
  {
    Both(block, columns);
  }
  void apply(Block<float> block, const ColumnContext& columns) const noexcept override
  {
    Both(block, columns);
  }

private:
  Run Both;
};
template <typename Run>
std::unique_ptr<BlockOperator> blockOperator(Run run)
{
  return std::make_unique<BlockOperatorOf<Run>>(std::move(run));
}

// One value a channel (or wavelength), ready in both precisions.
class ChannelValues
{
public:
  ChannelValues() = default;
  explicit ChannelValues(Eigen::ArrayXd values)
    : Double(std::move(values))
    , Float(Double.cast<float>())
  {
  }
  template <typename Scalar>
  const auto& as() const noexcept
  {
    if constexpr (std::is_same_v<Scalar, double>)
    {
      return Double;
    }
    else
    {
      return Float;
    }
  }

private:
  Eigen::ArrayXd Double;
  Eigen::ArrayXf Float;
};

// A number of an effect in the precision of what it acts on.
template <typename Scalar>
Scalar inPrecision(double number) noexcept
{
  return static_cast<Scalar>(number);
}
template <typename Scalar>
const auto& inPrecision(const ChannelValues& values) noexcept
{
  return values.as<Scalar>();
}

// change(u, numbers...) for all values, an array K x P. The numbers, double or ChannelValues, come in its precision.
template <typename Change, typename... Numbers>
std::unique_ptr<BlockOperator> onAll(Change change, Numbers... numbers)
{
  return blockOperator(
    [change, numbers...](auto block, const ColumnContext&)
    {
      using Scalar = typename decltype(block)::Scalar;
      change(block.array(), inPrecision<Scalar>(numbers)...);
    });
}

// The same for the reflectances r of the effect's medium, an array of N values at a time.
template <typename Change, typename... Numbers>
std::unique_ptr<BlockOperator> onMedium(
  const BoundEffect& effect, Change change, Numbers... numbers)
{
  return blockOperator(
    [change, numbers..., medium = effect.medium()](auto block, const ColumnContext& columns)
    {
      using Scalar = typename decltype(block)::Scalar;
      for (Eigen::Index j = 0; j < block.cols(); ++j)
      {
        if (columns.medium[j] == medium)
        {
          change(block.col(j).array(), inPrecision<Scalar>(numbers)...);
        }
      }
    });
}

// Multiplies channel k of every column by factor(k, x, y); all channels by that of the first where the effect is the same in all.
template <typename Factor>
std::unique_ptr<BlockOperator> onField(const BoundEffect& effect, Factor factor)
{
  return blockOperator(
    [factor, ofChannels = effect.form().name == "per_channel"](
      auto signal, const ColumnContext& columns)
    {
      using Scalar = typename decltype(signal)::Scalar;
      for (Eigen::Index j = 0; j < signal.cols(); ++j)
      {
        const auto at = [&](Eigen::Index k)
        { return static_cast<Scalar>(factor(k, columns.fieldX[j], columns.fieldY[j])); };
        if (!ofChannels)
        {
          signal.col(j) *= at(0);
          continue;
        }
        for (Eigen::Index k = 0; k < signal.rows(); ++k)
        {
          signal(k, j) *= at(k);
        }
      }
    });
}

// Calls body(values, count) for all values of a block: together where they lie one after the other, else column by column.
template <typename Scalar, typename Body>
void forRuns(Block<Scalar> block, Body body) noexcept
{
  if (block.outerStride() == block.rows())
  {
    body(block.data(), static_cast<std::size_t>(block.size()));
    return;
  }
  for (Eigen::Index j = 0; j < block.cols(); ++j)
  {
    body(block.col(j).data(), static_cast<std::size_t>(block.rows()));
  }
}

// Mixes a signal with that of its surround, both K x P, in place: u + fraction surround, or + fraction (surround - u) where light
// only changes its place.
class StrayLight
{
public:
  // fraction: of each channel. reach: of a surround that is not the neighbours alone, on a table, in pitches; 0: the neighbours.
  StrayLight(Eigen::ArrayXd fraction, bool added, double reach = 0.0)
    : Fraction(std::move(fraction))
    , Added(added)
    , Reach(reach)
  {
  }
  double reach() const noexcept { return Reach; }
  template <typename Scalar>
  void mix(Block<Scalar> signal, ConstBlock<Scalar> surround) const noexcept
  {
    for (Eigen::Index j = 0; j < signal.cols(); ++j)
    {
      auto u = signal.col(j).array();
      if (Added)
      {
        u += Fraction.as<Scalar>() * surround.col(j).array();
      }
      else
      {
        u += Fraction.as<Scalar>() * (surround.col(j).array() - u);
      }
    }
  }

private:
  ChannelValues Fraction;
  bool Added;
  double Reach;
};

} // namespace msi
