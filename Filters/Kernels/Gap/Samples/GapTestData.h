// Captures with a known gap that the tests of this room share.
#pragma once

#include "Kernels/Camera/CameraNoise.h"
#include "Kernels/Camera/CameraTestData.h"
#include "Kernels/Gap/Samples/GapData.h"
#include "Kernels/Gap/Samples/GapNoise.h"
#include "Kernels/Gap/SimToRealGap.h"

#include <algorithm>
#include <string>
#include <utility>
#include <vector>

namespace msi::test
{

constexpr double TestReadNoise = 0.0005;

// A capture of `nominal` whose real camera answers `mean`, K x S: `repeats` readings of each sample, Gaussian noise.
inline GapCapture captureFrom(const CameraModel& nominal, const SceneSamples& samples,
  const Eigen::MatrixXd& mean, int repeats = 2, double readNoise = TestReadNoise)
{
  GapCapture capture{ nominal, visibleGrid(), samples,
    Eigen::MatrixXd(mean.rows(), mean.cols() * repeats), {}, CameraNoise{ readNoise, 0.0 } };
  for (Eigen::Index j = 0; j < capture.readings.cols(); ++j)
  {
    capture.sampleOf.push_back(static_cast<int>(j / repeats));
    capture.readings.col(j) = mean.col(j / repeats);
  }
  NoiseGenerator({ readNoise, 0.0 }, 5)(capture.readings, 0);
  return capture;
}

// What sevenChannels() with `effects` answers to the samples.
inline GapCapture captureOf(const SceneSamples& samples, std::vector<CameraEffect> effects,
  int repeats = 2, double readNoise = TestReadNoise)
{
  const CameraSimulator real(sevenChannels(), std::move(effects));
  return captureFrom(sevenChannels(), samples, real.respond(SampleScene(visibleGrid(), samples)),
    repeats, readNoise);
}

inline GapCapture captureWith(std::vector<CameraEffect> effects, Eigen::Index samples = 96)
{
  return captureOf(rasterSamples(samples), std::move(effects));
}

inline GapReport diagnosisOf(const GapCapture& capture, const GapOptions& options = {})
{
  return *diagnoseGap(capture, options);
}

// Ready for a fit: averaged, with variance and weights.
inline GapData dataOf(const GapCapture& capture)
{
  GapData data = prepareGapData(capture, {});
  data.variance = readingVariance(data, findNoise(data, capture.noise).reading);
  setWeights(data);
  return data;
}

inline bool says(const std::vector<std::string>& notes, const std::string& part)
{
  return std::any_of(notes.begin(), notes.end(),
    [&part](const std::string& note) { return note.find(part) != std::string::npos; });
}

} // namespace msi::test
