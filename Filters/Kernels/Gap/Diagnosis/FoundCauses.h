// What is said about the effects that were found: how large, how certain, what else it may be.
#pragma once

#include "Kernels/Gap/Diagnosis/SetSearch.h"
#include "Kernels/Gap/GapReport.h"

#include <cstdint>
#include <set>
#include <string>
#include <utility>
#include <vector>

namespace msi
{

// Shapley values of the held-out shrink over the positions of a fit; their sum is that of the whole fit.
// shrink: of every subset of the positions, by the bits that are set; later: positions that come after all others.
//
// A number for each channel can also do what one number for all channels does. Where they do the same, the effect with the
// common number is credited with it: it gets its Shapley value under precedence constraints (Faigle and Kern 1992,
// doi:10.1007/BF01258278) where that is larger than the plain one, those that come later the smaller of both. Numbers of channels that
// are mostly their mean are one number in this, if the effect has a form with one: an exposure is another effect than gains.
std::vector<double> sharesUnderPrecedence(
  const std::vector<double>& shrink, const std::vector<char>& later);

// The causes in the order of sortCauses(); their shares sum to `shrink`, the held-out shrink of the whole diagnosis.
std::vector<GapCause> foundCauses(const Observation& data, const FoundSets& found, double shrink);

// Probability that something that the library does not have is behind the gap.
//   explained: part of the size of the gap, on samples held out; after the right causes little is left.
//   chanceOfCurve: numbers of single channels that follow a curve look like one effect with one number. Where chance has p
//     for it, that multiplies the odds by at most 1 / (-e p ln p) (Sellke, Bayarri and Berger 2001,
//     doi:10.1198/000313001300339950).
//   standIns: signs that effects stand for another: two causes of one medium, an effect of a medium that all media have, a gain
//     in disguise, a parameter at the end of its range.
//     Each is e times likelier than one unknown effect in the place of all.
// Never less likely than an effect of the library is before the data speak.
double unknownProbability(double explained, double chanceOfCurve = 1.0, int standIns = 0);

// The likeliest fit of each set of effects, whatever their forms and media; their probabilities sum to 1, the largest first.
struct Explanation
{
  std::set<std::string> effects;
  FitPointer fit;
  double probability = 0.0;
};
std::set<std::string> inBoth(const std::set<std::string>& a, const std::set<std::string>& b);
std::vector<Explanation> explanationsOf(const Observation& data, const FoundSets& found);

// The two of the effects in question about which the explanations agree the least.
std::vector<std::string> disputed(
  const std::vector<Explanation>& explanations, const std::set<std::string>& inQuestion);

// The causes and their equivalents.
std::set<std::string> inQuestion(const std::vector<GapCause>& causes);

inline constexpr double LeastBits = 0.1; // that a capture is worth being named for

// By bits per minute, getting ready included; the most first.
void sortByWorth(std::vector<GapNextCapture>& captures);

// The captures that show an effect in question by itself (EffectDefinition::separatingCapture), each with the information in bits
// about the explanations if it tells without doubt whether its effects are there; sorted by worth.
std::vector<GapNextCapture> separatingCaptures(
  const std::vector<Explanation>& explanations, const std::set<std::string>& inQuestion);

// Of "nothing", of "unknown", and of each effect being a cause.
// gap: whether there is one beyond noise. none: probability that none of the explanations is true, but something unknown (a gap), or
// nothing (no gap).
std::vector<std::pair<std::string, double>> effectProbabilities(
  const std::vector<Explanation>& explanations, bool gap, double none);

// What the data say of a gap beside the sets that were found.
struct Evidence
{
  double credited = 0.0;  // what the shares of the causes sum to; 0: they are not believed at all
  double explained = 0.0; // part of the gap's size
  double takenForNoise = 0.0; // part of the gap's energy, where only what is left shows the noise
  bool gap = false;           // if they are not: whether there is one beyond noise
  double noticed = 1.0;       // if there is none: odds that they are causes all the same, at most 1
  std::vector<GapAxis> rest = {}; // along which lies what the causes leave
};

// Completes a report that has its figures and axes: causes, what they leave, verdict, candidates and probabilities. seed: of
// intervals. GapReport::unconfirmed is looked at.
std::vector<Explanation> conclude(GapReport& report, const Observation& data,
  const FoundSets& found, const Evidence& evidence, std::uint64_t seed);

} // namespace msi
