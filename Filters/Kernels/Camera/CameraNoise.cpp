#include "Kernels/Camera/CameraNoise.h"

#include "Kernels/Camera/CameraNoiseKernel.h"
#include "Kernels/Numerics/CounterRandom.h"
#include "Kernels/Numerics/NonNegativeLeastSquares.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <limits>
#include <utility>

namespace msi
{

namespace
{
// Streams of CounterRandom.
constexpr std::uint32_t GainPatternStream = 0;
constexpr std::uint32_t OffsetPatternStream = 1;
constexpr std::uint32_t FirstExposureStream = 2;

constexpr Eigen::Index ChunkValues = 4096;

// The nearest whole number, halves to even: what std::nearbyint does, without a call. Larger values than a
// mantissa holds are whole already.
template <typename Scalar>
Scalar nearest(Scalar value) noexcept
{
  constexpr Scalar Shift =
    Scalar(3) * (Scalar(1) / std::numeric_limits<Scalar>::epsilon()) / Scalar(2);
  return std::abs(value) < Shift / Scalar(4) ? (value + Shift) - Shift : value;
}

void requireNotNegative(const char* name, double value)
{
  if (!(value >= 0.0) || !std::isfinite(value))
  {
    reject("the camera noise '", name, "' is ", value, "; expected zero or more");
  }
}
}

double noiseVariance(const CameraNoise& noise, double response) noexcept
{
  return noise.read * noise.read + noise.shot * noise.shot * (response > 0.0 ? response : 0.0);
}

CameraNoise fittedNoise(
  const Eigen::ArrayXd& response, const Eigen::ArrayXd& variance, const Eigen::ArrayXd& weight)
{
  Eigen::MatrixXd terms(response.size(), 2);
  terms << Eigen::VectorXd::Ones(response.size()), response.max(0.0).matrix();
  const Eigen::MatrixXd weighted = weight.matrix().asDiagonal() * terms;
  const Eigen::VectorXd squares =
    solveNonNegative(terms.transpose() * weighted, weighted.transpose() * variance.matrix()).x;
  return { std::sqrt(squares[0]), std::sqrt(squares[1]) };
}

// Value number i of the chunk is number firstIndex + i of its streams.
template <>
void NoiseGenerator::addToChunk<Eigen::MatrixXf>(Eigen::Ref<Eigen::MatrixXf> response,
  Eigen::Index firstChannel, std::uint64_t firstIndex, std::uint32_t exposure) const noexcept
{
  using Chunk = std::array<float, ChunkValues>;
  Chunk gain;
  Chunk offset;
  Chunk temporal;
  Chunk factor;
  const auto count = static_cast<std::size_t>(response.size());
  const auto draw = [&](std::uint32_t stream, Chunk& memory)
  {
    CounterRandom(Seed, stream).normals(firstIndex, memory.data(), count);
    return memory.data();
  };
  NoiseTerms terms;
  if (Noise.fixedPatternGain > 0.0)
  {
    terms.gainPattern = draw(GainPatternStream, gain);
    terms.gain = static_cast<float>(Noise.fixedPatternGain);
  }
  if (Noise.fixedPatternOffset > 0.0)
  {
    terms.offsetPattern = draw(OffsetPatternStream, offset);
    terms.offset = static_cast<float>(Noise.fixedPatternOffset);
  }
  if (Noise.read > 0.0 || Noise.shot > 0.0)
  {
    terms.temporal = draw(FirstExposureStream + exposure, temporal);
    terms.readVariance = static_cast<float>(Noise.read * Noise.read);
    terms.shotVariance = static_cast<float>(Noise.shot * Noise.shot);
    if (DeviationFactor.size() > 0)
    {
      Eigen::Map<Eigen::ArrayXXf> factors(factor.data(), response.rows(), response.cols());
      factors.colwise() = DeviationFactor.segment(firstChannel, response.rows()).cast<float>();
      terms.factor = factor.data();
    }
  }
  terms.step = static_cast<float>(Noise.quantisationStep);
  const auto rows = static_cast<std::size_t>(response.rows());
  if (response.outerStride() == response.rows())
  {
    addNoise(terms, response.data(), count);
    return;
  }
  const auto advance = [rows](const float*& values)
  { values = values == nullptr ? nullptr : values + rows; };
  for (Eigen::Index j = 0; j < response.cols(); ++j)
  {
    addNoise(terms, response.col(j).data(), rows);
    advance(terms.gainPattern);
    advance(terms.offsetPattern);
    advance(terms.temporal);
    advance(terms.factor);
  }
}

template <typename Matrix>
void NoiseGenerator::addToChunk(Eigen::Ref<Matrix> response, Eigen::Index firstChannel,
  std::uint64_t firstIndex, std::uint32_t exposure) const noexcept
{
  using Scalar = typename Matrix::Scalar;
  using Deviates = Eigen::Map<Eigen::Array<float, Eigen::Dynamic, Eigen::Dynamic>>;
  std::array<float, ChunkValues> memory;
  const auto count = static_cast<std::size_t>(response.size());
  const auto draw = [&](std::uint32_t stream)
  {
    CounterRandom(Seed, stream).normals(firstIndex, memory.data(), count);
    return Deviates(memory.data(), response.rows(), response.cols()).template cast<Scalar>();
  };
  if (Noise.fixedPatternGain > 0.0)
  {
    const auto gain = static_cast<Scalar>(Noise.fixedPatternGain);
    response.array() *= Scalar(1) + gain * draw(GainPatternStream);
  }
  if (Noise.fixedPatternOffset > 0.0)
  {
    response.array() += static_cast<Scalar>(Noise.fixedPatternOffset) * draw(OffsetPatternStream);
  }
  if (Noise.read > 0.0 || Noise.shot > 0.0)
  {
    const auto deviates = draw(FirstExposureStream + exposure);
    const auto read2 = static_cast<Scalar>(Noise.read * Noise.read);
    const auto shot2 = static_cast<Scalar>(Noise.shot * Noise.shot);
    for (Eigen::Index j = 0; j < response.cols(); ++j)
    {
      for (Eigen::Index k = 0; k < response.rows(); ++k)
      {
        const Scalar u = response(k, j);
        const Scalar deviation = std::sqrt(read2 + shot2 * (u > Scalar(0) ? u : Scalar(0)));
        const Scalar factor = DeviationFactor.size() == 0
          ? Scalar(1)
          : static_cast<Scalar>(DeviationFactor[firstChannel + k]);
        response(k, j) = u + factor * deviation * deviates(k, j);
      }
    }
  }
  if (Noise.quantisationStep > 0.0)
  {
    const auto step = static_cast<Scalar>(Noise.quantisationStep);
    response = response.unaryExpr([step](Scalar u) { return step * nearest(u / step); });
  }
}

template <typename Matrix>
void NoiseGenerator::add(
  Eigen::Ref<Matrix> response, std::uint64_t firstColumn, std::uint32_t exposure) const noexcept
{
  const Eigen::Index channels = response.rows();
  const Eigen::Index rows = std::min(channels, ChunkValues);
  const Eigen::Index columns = rows > 0 ? ChunkValues / rows : 1;
  for (Eigen::Index j = 0; j < response.cols(); j += columns)
  {
    for (Eigen::Index k = 0; k < channels; k += rows)
    {
      // Columns are taken together only where a chunk holds all of their channels.
      const std::uint64_t index =
        (firstColumn + static_cast<std::uint64_t>(j)) * static_cast<std::uint64_t>(channels) +
        static_cast<std::uint64_t>(k);
      addToChunk<Matrix>(
        response.block(k, j, std::min(rows, channels - k), std::min(columns, response.cols() - j)),
        k, index, exposure);
    }
  }
}

NoiseGenerator::NoiseGenerator(
  const CameraNoise& noise, std::uint64_t seed, Eigen::ArrayXd deviationFactor)
  : Noise(noise)
  , Seed(seed)
  , DeviationFactor(std::move(deviationFactor))
{
  requireNotNegative("read", noise.read);
  requireNotNegative("shot", noise.shot);
  requireNotNegative("fixed pattern gain", noise.fixedPatternGain);
  requireNotNegative("fixed pattern offset", noise.fixedPatternOffset);
  requireNotNegative("quantisation step", noise.quantisationStep);
  for (const double factor : DeviationFactor)
  {
    requireNotNegative("deviation factor", factor);
  }
}

double NoiseGenerator::variance(Eigen::Index channel, double response) const noexcept
{
  const double plain = noiseVariance(Noise, response);
  return DeviationFactor.size() == 0 ? plain
                                     : plain * DeviationFactor[channel] * DeviationFactor[channel];
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref that is written through
void NoiseGenerator::operator()(Eigen::Ref<Eigen::MatrixXd> response, std::uint64_t firstColumn,
  std::uint32_t exposure) const noexcept
{
  add<Eigen::MatrixXd>(response, firstColumn, exposure);
}

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref that is written through
void NoiseGenerator::operator()(Eigen::Ref<Eigen::MatrixXf> response, std::uint64_t firstColumn,
  std::uint32_t exposure) const noexcept
{
  add<Eigen::MatrixXf>(response, firstColumn, exposure);
}

} // namespace msi
