// What to doubt about measured samples before anything is computed from them: readings of another sample, an exchanged channel, another
// exposure, gamma, saturation, samples that stand twice.
#pragma once

#include "Kernels/Estimation/SampleSet.h"

#include <string>
#include <vector>

namespace msi
{

struct NamedSamples
{
  SampleSet set;
  std::string table;              // "the tuning table", by which it is called
  std::vector<std::string> names; // of the samples
  Eigen::ArrayXd x{}, y{};        // where each is, in any unit; empty: not known
};

// Questions, each a sentence or two that begins with the table; empty: nothing is doubted.
//
// Method: a camera's responses are nearly linear in reflectance. Ridge regression predicts each sample's responses from all others; what
//   that leaves is small beside a mistake. Samples are odd from four times the usual deviation on, where they are few (OddOnes.h). A
//   medium's samples are seen by the camera that the chart shows; another exposure or dark level is asked for, but for what media
//   differ by.
// channels: K names. medium: null, or samples with bands and channels as the chart's. A chart of fewer than 8 samples shows no camera; a
//   medium of fewer than 5 is not compared with it.
// Errors: as fitRidge().
std::vector<std::string> doubtsOf(const NamedSamples& chart,
  const std::vector<std::string>& channels, const NamedSamples* medium = nullptr);

} // namespace msi
