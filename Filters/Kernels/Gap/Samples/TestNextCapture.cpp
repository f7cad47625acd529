#include "Kernels/Gap/Samples/NextCapture.h"

#include "Kernels/Gap/Samples/GapTestData.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace
{

using namespace msi::test;

// Whether the second capture names what the first leaves open; empty where it leaves nothing open.
std::optional<bool> toldByNext(const msi::SceneSamples& samples, const msi::CameraEffect& planted)
{
  const msi::GapCapture first = captureOf(samples, { planted });
  const msi::GapReport report = diagnosisOf(first);
  if (report.nextCaptures.empty())
  {
    return std::nullopt;
  }
  const msi::GapNextCapture& next = report.nextCaptures.front();
  const std::vector<msi::CaptureCandidate> candidates =
    msi::captureCandidates(dataOf(first), next.separates);
  const auto taken = std::find_if(candidates.begin(), candidates.end(),
    [&next](const msi::CaptureCandidate& candidate)
    { return candidate.kind.name == next.capture; });
  EXPECT_NE(taken, candidates.end()) << next.capture;
  // What is known is taken into the simulated camera: where it was the cause, no gap is left.
  if (taken->known && taken->known(msi::requireEffect(planted.name)))
  {
    return true;
  }
  msi::GapOptions options;
  for (const msi::EffectDefinition& effect : msi::effectLibrary())
  {
    if (taken->known && taken->known(effect))
    {
      options.without.push_back(effect.name);
    }
  }
  // Where a part of the camera is known, the chart once more is in the candidate's own samples.
  const msi::SceneSamples both =
    taken->known ? taken->samples : msi::joined(first.samples, taken->samples);
  const msi::GapReport after = diagnosisOf(captureOf(both, { planted }), options);
  return !after.causes.empty() && after.causes.front().effect == planted.name;
}

TEST(NextCapture, TellsWhatTheFirstCaptureLeavesOpen)
{
  const std::vector<std::pair<const char*, double>> planted{ { "exposure_gain", 1.05 },
    { "medium_gain", 1.05 }, { "filter_shift", 2.5 }, { "illuminant_drift", 0.05 },
    { "filter_bandwidth", 1.2 }, { "channel_crosstalk", 0.03 }, { "veiling_glare", 0.02 },
    { "dark_offset", 0.01 }, { "detector_nonlinearity", 0.05 }, { "filter_leak", 0.01 },
    { "specular_component", 0.02 }, { "translucency", 0.05 }, { "fluorescence", 0.03 } };
  int open = 0;
  int told = 0;
  for (const bool placed : { true, false })
  {
    msi::SceneSamples samples = rasterSamples(96);
    samples.medium.assign(96, "paper");
    if (!placed)
    {
      samples.x.resize(0);
      samples.y.resize(0);
      samples.order.resize(0);
    }
    for (const auto& [name, value] : planted)
    {
      const bool ofMedium = msi::requireEffect(name).need == msi::EffectNeed::Medium;
      msi::CameraEffect effect =
        msi::neutralEffect(name, sevenChannels().channels(), "", ofMedium ? "paper" : "");
      effect.parameters.front() = value;
      const std::optional<bool> outcome = toldByNext(samples, effect);
      open += outcome ? 1 : 0;
      told += outcome.value_or(false) ? 1 : 0;
    }
  }
  EXPECT_GE(open, 8);
  EXPECT_GE(told, 0.85 * open) << told << " of " << open;
}

}

// Four sets of effects, each as likely: what shows two effects apart from each other tells more than what shows one.
TEST(NextCapture, OfCapturesThatShowEffectsTheOneThatTellsMost)
{
  const std::vector<msi::Explanation> explanations{ { { "defocus" }, nullptr, 0.25 },
    { { "misregistration" }, nullptr, 0.25 }, { { "lag" }, nullptr, 0.25 },
    { { "dark_offset" }, nullptr, 0.25 } };
  const auto captures =
    msi::separatingCaptures(explanations, { "defocus", "misregistration", "lag", "dark_offset" });
  // 1 bit and a half in 20 minutes, .81 in 11, .81 in 20.
  ASSERT_EQ(captures.size(), 3U);
  const double oneOfFour = 2.0 - 0.75 * std::log2(3.0);
  EXPECT_EQ(captures[0].capture, "grid target for each filter");
  EXPECT_NEAR(captures[0].expectedBits.value(), 1.5, 1e-12);
  EXPECT_EQ(captures[1].capture, "lens cap");
  EXPECT_NEAR(captures[1].expectedBits.value(), oneOfFour, 1e-12);
  EXPECT_NEAR(captures[2].expectedBits.value(), oneOfFour, 1e-12);
  EXPECT_TRUE(msi::separatingCaptures(explanations, { "banding" }).empty());
}
