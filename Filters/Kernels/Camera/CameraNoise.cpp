#include "Kernels/Camera/CameraNoise.h"

#include "Kernels/Camera/CameraNoiseKernel.h"
#include "Kernels/Numerics/CounterRandom.h"
#include "Kernels/Numerics/NonNegativeLeastSquares.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <array>
#include <cmath>
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
double nearest(double value) noexcept
{
  constexpr double Shift = 0x1.8p52;
  return std::abs(value) < Shift / 4.0 ? (value + Shift) - Shift : value;
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
// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref that is written through
void NoiseGenerator::addToChunk(Eigen::Ref<Eigen::MatrixXf> response, Eigen::Index firstChannel,
  std::uint64_t firstIndex, std::uint32_t exposure) const noexcept
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

// NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref that is written through
void NoiseGenerator::addToChunk(Eigen::Ref<Eigen::MatrixXd> response, Eigen::Index firstChannel,
  std::uint64_t firstIndex, std::uint32_t exposure) const noexcept
{
  std::array<float, ChunkValues> memory;
  const auto count = static_cast<std::size_t>(response.size());
  const auto draw = [&](std::uint32_t stream)
  {
    CounterRandom(Seed, stream).normals(firstIndex, memory.data(), count);
    return Eigen::Map<Eigen::ArrayXXf>(memory.data(), response.rows(), response.cols())
      .cast<double>();
  };
  if (Noise.fixedPatternGain > 0.0)
  {
    response.array() *= 1.0 + Noise.fixedPatternGain * draw(GainPatternStream);
  }
  if (Noise.fixedPatternOffset > 0.0)
  {
    response.array() += Noise.fixedPatternOffset * draw(OffsetPatternStream);
  }
  if (Noise.read > 0.0 || Noise.shot > 0.0)
  {
    const auto deviates = draw(FirstExposureStream + exposure);
    for (Eigen::Index j = 0; j < response.cols(); ++j)
    {
      for (Eigen::Index k = 0; k < response.rows(); ++k)
      {
        const double u = response(k, j);
        const double factor = DeviationFactor.size() == 0 ? 1.0 : DeviationFactor[firstChannel + k];
        response(k, j) = u + factor * std::sqrt(noiseVariance(Noise, u)) * deviates(k, j);
      }
    }
  }
  if (Noise.quantisationStep > 0.0)
  {
    const double step = Noise.quantisationStep;
    response = response.unaryExpr([step](double u) { return step * nearest(u / step); });
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
      addToChunk(Eigen::Ref<Matrix>(response.block(
                   k, j, std::min(rows, channels - k), std::min(columns, response.cols() - j))),
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
