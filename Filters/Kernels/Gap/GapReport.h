// What a diagnosis of the gap between a simulated and a real camera has to say.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Camera/CameraModel.h"

#include <array>
#include <optional>
#include <string>
#include <utility>
#include <vector>

namespace msi
{

enum class GapVerdict
{
  NoGap,
  Explained,
  PartlyExplained,
  Unexplained
};

// "no gap", "explained", "partly explained", "unexplained"
const char* nameOf(GapVerdict verdict) noexcept;

// Root mean squares over channels and samples, response relative to white, on samples that took no part
// in choosing or fitting the effects.
//   shrink = 1 - sqrt(max(0, after^2 - floor^2)) / sqrt(before^2 - floor^2), within [-1, 1];
//   0 where there is no gap to shrink. The interval is a 95 % bootstrap over samples.
struct GapFigures
{
  double rmsBefore = 0.0;
  double rmsAfter = 0.0;
  double noiseFloor = 0.0;
  double shrink = 0.0;
  std::array<double, 2> shrinkInterval{ 0.0, 0.0 };
};

struct GapCell
{
  std::string cell;   // "C3", "fabric", "x 0.5..1, y 0..0.5", ...
  double share = 0.0; // of the gap's energy
};

// One axis along which the gap may lie: channel, medium, scene, position, level, order, spectral_shape,
// sample. The shares are of the gap's energy above noise before any effect; Shapley values of the
// cross-validated R^2 of the axes' bases, so that correlated axes are not counted twice.
struct GapAxis
{
  std::string axis;
  double share = 0.0;
  std::vector<GapCell> worst;
};

// A place in the capture order where the gap's level jumps.
struct GapChangePoint
{
  double order = 0.0;      // in the units of the capture's order column
  double change = 0.0;     // relative change of the response
  double deviations = 0.0; // the change over its standard error
};

struct GapParameter
{
  std::string name;
  double value = 0.0;
  std::string unit;
  double standardError = 0.0; // robust against samples whose channels err together
};

struct GapCause
{
  std::string effect;
  std::string form;
  std::string medium;                  // empty unless the effect acts on one medium
  double share = 0.0;                  // of the gap's size; Shapley value of the held-out shrink
  double shrink = 0.0;                 // by this effect alone
  std::vector<std::string> equivalent; // effects that this data cannot tell from it; at most two
  std::vector<GapParameter> parameters;
  double probability = 0.0; // of this effect, and not another or an unknown one, being a cause
  bool perChannel = false;  // a number for every channel, and not because of the light
};

struct GapCandidate
{
  std::string effect;
  std::string form;
  std::string medium;
  double shrink = 0.0;                              // by this effect alone, cross-validated
  std::array<double, 2> shrinkInterval{ 0.0, 0.0 }; // 95 % bootstrap over samples
};

struct GapRemainder
{
  double share = 0.0; // of the gap's size
  std::string where;  // empty where nothing is left
  // What the rest depends on, the largest part of its energy first: level, wavelength, order, position, medium, scene,
  // neighbour, sample.
  std::vector<std::pair<std::string, double>> dependsOn;
  // Root mean square of the gap, as GapFigures::rmsAfter, once what is regular in the rest is simulated, too: the effect of the
  // trait Remainder, linear in response, neighbouring channels, place and time. Empty where the interval of how far the rest
  // shrinks by it contains 0.
  std::optional<double> rmsWithRest = std::nullopt;
};

struct GapNextCapture
{
  std::string capture;
  std::vector<std::string> separates; // effects that it tells apart
  // Of information about which effects are the causes, and of work. Empty where there is no capture.
  std::optional<double> expectedBits, minutes;
};

struct GapReport
{
  GapVerdict verdict = GapVerdict::NoGap;
  GapFigures gap;
  std::vector<GapAxis> where; // the largest share first
  std::vector<GapChangePoint> changePoints;
  std::vector<GapCause> causes;        // in the order of sortCauses()
  std::vector<std::string> uncredited; // effects of the correction that help it but are no cause
  bool unconfirmed = false; // the causes show in too few samples for those left out to confirm them
  std::vector<GapCandidate> candidates; // the largest shrink first
  GapRemainder unexplained;
  // Of "nothing" being the cause, of something "unknown" and of each effect being one; the largest first.
  std::vector<std::pair<std::string, double>> probabilities;
  double probabilityOf(const std::string& name) const; // 0 where it is not told
  std::vector<GapNextCapture> nextCaptures;            // that would tell more; the best first
  std::vector<std::string> notes;                      // what the data cannot decide, and why
  // The corrected simulator is CameraSimulator(camera, correction, { whiteAfterEffects }) with the capture's
  // own camera.
  std::vector<CameraEffect> correction;
  bool whiteAfterEffects = false;
  // K x S, real minus simulated, before and after the correction; NaN where nothing was measured.
  Eigen::MatrixXd gapBefore;
  Eigen::MatrixXd gapAfter;
};

} // namespace msi
