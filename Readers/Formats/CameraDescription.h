// A camera on disk: NAME.csv with its curves, NAME.json with all that is not a curve.
#pragma once

#include "Formats/EffectList.h"

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraNoise.h"

#include <optional>
#include <string>
#include <vector>

namespace msi
{

// {"camera": "NAME.csv", "dark": [0.01, 0.02], "white_level": 1,
//  "noise": {"read": 0.001, "shot": 0.002, "fixed_pattern_gain": 0, "fixed_pattern_offset": 0,
//            "quantisation_step": 0},
//  "white_after_effects": false, "effects": [...]}
//
// camera: beside the JSON file unless it is an absolute path; left out: NAME.csv. dark: one number or one a
// channel, in the units of the curves; left out: 0. All other keys may be left out.
struct CameraDescription
{
  CameraModel camera;
  double whiteLevel = 1.0; // counts of the perfect white
  std::optional<CameraNoise> noise = std::nullopt;
  std::vector<CameraEffect> effects = {};
  // The white was taken through the effects: see CameraSimulatorOptions.
  bool whiteAfterEffects = false;
  std::vector<std::string> notes = {};
};

// A .json file with its curves, or any other file: curves alone, as readCameraCurves, without dark response.
// Errors: FormatError naming file, line and key.
CameraDescription readCameraDescription(const std::string& path);

// Writes `path` (.json) and the curves beside it (.csv); numbers read back bit for bit. Each file is complete or
// absent. Errors: std::invalid_argument for a path that does not end in .json or effects that do not fit;
// FormatError where a file cannot be written.
void writeCameraDescription(const std::string& path, const CameraDescription& description);

} // namespace msi
