// The spaces in which the experts of the method "transfer" work.
#pragma once

#include <algorithm>
#include <cmath>

namespace msi
{

enum class TransferSpace
{
  Linear,
  SquareRoot // of responses and reflectances, with the sign kept
};

inline double toSpace(TransferSpace space, double value) noexcept
{
  return space == TransferSpace::Linear ? value : std::copysign(std::sqrt(std::abs(value)), value);
}

inline double fromSpace(TransferSpace space, double value) noexcept
{
  return space == TransferSpace::Linear ? value : value * std::abs(value);
}

// d toSpace / d value, held finite around zero.
inline double slopeToSpace(TransferSpace space, double value) noexcept
{
  return space == TransferSpace::Linear ? 1.0 : 0.5 / std::sqrt(std::max(std::abs(value), 1e-4));
}

// d fromSpace / d value at the value whose image is 'reflectance', held above zero.
constexpr double LeastSlopeReflectance = 1e-3;
inline double slopeFromSpace(TransferSpace space, double reflectance) noexcept
{
  return space == TransferSpace::Linear
    ? 1.0
    : 2.0 * std::sqrt(std::max(std::abs(reflectance), LeastSlopeReflectance));
}

} // namespace msi
