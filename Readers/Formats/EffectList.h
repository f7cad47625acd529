// A list of camera effects as JSON text: what makes a real camera differ from its model.
#pragma once

#include "Kernels/Camera/CameraEffect.h"

#include <string>
#include <vector>

namespace msi
{

// [{"effect": "filter_shift", "form": "linear", "parameters": {"shift": 2.9, "slope": 0.1}},
//  {"effect": "channel_gain", "parameters": {"gain": 1.02}, "channel": "C3"},
//  {"effect": "medium_gain", "parameters": {"gain": 0.9}, "medium": "fabric"}]
//
// form:       may be left out: the first form of the effect that has all the parameters given.
// parameters: by name, those left out are neutral. One that is per channel takes a list with one number a channel, or
//             one number: for every channel, or for `channel` alone, the others being neutral.
// Errors:     FormatError naming file, line, effect and parameter: no JSON, a name that effectLibrary() does not
//             know, a number that is missing, not finite or out of its range, a list of another length than
//             `channels`, a medium that is missing or idle, a key that is none of these.
std::vector<CameraEffect> parseEffectList(
  const std::string& file, const std::string& text, const std::vector<std::string>& channels);

// The same from a file: such a list, or the description of a camera that has one.
std::vector<CameraEffect> readEffectList(
  const std::string& path, const std::vector<std::string>& channels);

// The text that parseEffectList reads back to the same effects, bit for bit.
// Errors: std::invalid_argument for an effect that does not fit the library or the channels.
std::string effectListText(
  const std::vector<CameraEffect>& effects, const std::vector<std::string>& channels);

} // namespace msi
