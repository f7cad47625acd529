// Which capture to take next, so that explanations that this one leaves open are told apart.
#pragma once

#include "Kernels/Gap/Diagnosis/FoundCauses.h"
#include "Kernels/Gap/Samples/SampleObservation.h"

#include <cstdint>
#include <functional>
#include <set>
#include <string>
#include <vector>

namespace msi
{

// A capture that may be taken: of a scene, or of this chart again with the effects on a part of the camera known.
struct CaptureCandidate
{
  CaptureKind kind;
  SceneSamples samples;  // reflectances on the camera's grid
  SampleList again = {}; // samples of the first capture that it shows again, first in `samples`
  std::function<bool(const EffectDefinition&)> known = nullptr; // empty: none
};
// Two captures as one, the next one a scene of its own; what it does not tell is in the middle of the field, captured first.
SceneSamples joined(SceneSamples first, const SceneSamples& next);
// Those that the data's chart allows, and those that measure one of the samples' effects named.
std::vector<CaptureCandidate> captureCandidates(
  const GapData& data, const std::vector<std::string>& effects);

// The captures that would tell which of the effects in question are causes, the best first; empty where none would tell
// much. Effects beside them are a nuisance: explanations that differ in those alone are one.
//
// Each capture is simulated with this camera and chart under every explanation: its mean by the simulator, its
// covariance from the noise, from what the explanation leaves of the gap, and from the uncertainty of the explanation's
// parameters (to first order). What was seen is seen again, but for what the explanation changes; the less the chart's
// spectra span a new one, the less its response is trusted. A capture's worth is the mutual information of explanation and readings,
//   I = sum_h p_h E_{y | h} [ log2 p(y | c(h)) - log2 p(y) ]   bits (Lindley 1956, doi:10.1214/aoms/1177728069),
// with p from `explanations` and c(h) the effects in question that h has, by draws from a counter generator. They are
// ranked by I per minute, getting ready included. A capture that measures a part of the camera or of a sample (a lamp's
// spectrum, fluorescence) is the chart again with the effects on that part known: explanations by them predict no gap
// there.
std::vector<GapNextCapture> nextCaptures(const SampleObservation& data,
  const std::vector<Explanation>& explanations, const std::set<std::string>& inQuestion,
  std::uint64_t seed);

} // namespace msi
