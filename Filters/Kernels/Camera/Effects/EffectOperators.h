// What an effect does to numbers, by the place where it acts. Internal to the simulator.
#pragma once

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

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

// Lets one template, Derived::run(block, columns), serve both scalars.
template <typename Derived>
class BlockOperatorOf : public BlockOperator
{
public:
  void apply(Block<double> block, const ColumnContext& columns) const noexcept override
  {
    static_cast<const Derived*>(this)->run(block, columns);
  }
  void apply(Block<float> block, const ColumnContext& columns) const noexcept override
  {
    static_cast<const Derived*>(this)->run(block, columns);
  }
};

// Stray light: mixes a signal with that of its surround, both K x P, in place.
class SurroundOperator
{
public:
  virtual ~SurroundOperator() = default;
  // Of a surround that is not the neighbours alone: its reach on a table, in pitches; 0: the neighbours.
  virtual double reach() const noexcept { return 0.0; }
  virtual void apply(Block<double> block, ConstBlock<double> surround) const noexcept = 0;
  virtual void apply(Block<float> block, ConstBlock<float> surround) const noexcept = 0;
};

template <typename Derived>
class SurroundOperatorOf : public SurroundOperator
{
public:
  void apply(Block<double> block, ConstBlock<double> surround) const noexcept override
  {
    static_cast<const Derived*>(this)->run(block, surround);
  }
  void apply(Block<float> block, ConstBlock<float> surround) const noexcept override
  {
    static_cast<const Derived*>(this)->run(block, surround);
  }
};

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

} // namespace msi
