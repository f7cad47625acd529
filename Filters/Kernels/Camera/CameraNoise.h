// The noise of a camera: shot, read, fixed pattern, quantisation.
#pragma once

#include <Eigen/Core>

#include <cstdint>

namespace msi
{

// Standard deviations relative to white.
//
// variance of one exposure = read^2 + shot^2 max(u, 0)   (the capture contract)
// The fixed pattern is the same in every exposure of one pixel: u (1 + fixedPatternGain g) + fixedPatternOffset o with
// standard normal g and o of that pixel and channel.
struct CameraNoise
{
  double read = 0.0;
  double shot = 0.0;
  double fixedPatternGain = 0.0;
  double fixedPatternOffset = 0.0;
  double quantisationStep = 0.0; // response units; 0 leaves the values continuous
};

double noiseVariance(const CameraNoise& noise, double response) noexcept;

// Read and shot noise whose variances come nearest to those seen at some responses: weighted least squares of the variances.
CameraNoise fittedNoise(
  const Eigen::ArrayXd& response, const Eigen::ArrayXd& variance, const Eigen::ArrayXd& weight);

// Adds noise in place.
//
// Shapes: response K x P. Column j stands for the pixel or sample firstColumn + j, so that any split
//         of an image into blocks gives the same bytes. `exposure` numbers repeats of one scene.
//         deviationFactor: a factor on the temporal standard deviation of each channel; empty: 1.
// Range:  all fields >= 0 and finite (constructor throws std::invalid_argument). NaN stays NaN, in place.
//         A field at zero draws nothing and changes no bit.
// Errors: std::invalid_argument also for a negative factor; a block must have as many rows as factors.
class NoiseGenerator
{
public:
  NoiseGenerator(const CameraNoise& noise, std::uint64_t seed, Eigen::ArrayXd deviationFactor = {});

  void operator()(Eigen::Ref<Eigen::MatrixXd> response, std::uint64_t firstColumn,
    std::uint32_t exposure = 0) const noexcept;
  void operator()(Eigen::Ref<Eigen::MatrixXf> response, std::uint64_t firstColumn,
    std::uint32_t exposure = 0) const noexcept;

  // Temporal variance of one exposure.
  double variance(Eigen::Index channel, double response) const noexcept;

private:
  template <typename Matrix>
  void add(
    Eigen::Ref<Matrix> response, std::uint64_t firstColumn, std::uint32_t exposure) const noexcept;
  void addToChunk(Eigen::Ref<Eigen::MatrixXd> response, Eigen::Index firstChannel,
    std::uint64_t firstIndex, std::uint32_t exposure) const noexcept;
  void addToChunk(Eigen::Ref<Eigen::MatrixXf> response, Eigen::Index firstChannel,
    std::uint64_t firstIndex, std::uint32_t exposure) const noexcept;

  CameraNoise Noise;
  std::uint64_t Seed;
  Eigen::ArrayXd DeviationFactor;
};

} // namespace msi
