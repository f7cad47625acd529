// Diagnosis of the gap between a simulated and a real camera: where it lies, which effects cause it, how
// far it shrinks once they are simulated.
#pragma once

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraNoise.h"
#include "Kernels/Camera/SampleScene.h"
#include "Kernels/Gap/GapReport.h"
#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <cstdint>
#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace msi
{

// A capture as numbers.
struct GapCapture
{
  CameraModel camera;         // the simulated camera, K channels
  WavelengthGrid wavelengths; // of the samples' reflectance; resampled to the camera's grid
  // S samples. NaN for one whose position or order is not known, as a lid's: in the middle of the field, captured first.
  SceneSamples samples;
  Eigen::MatrixXd readings;         // K x R, what the real camera answered; NaN: not measured
  std::vector<int> sampleOf;        // R, the sample of each reading; repeats name a sample again
  std::optional<CameraNoise> noise; // read and shot of a reading; empty: the repeats decide
  std::vector<std::string> names{}; // S, of the samples; empty: "sample 1", ..
};

struct GapOptions
{
  std::vector<std::string> without; // effects that may not be blamed
  int maximumCauses = 5;
  int folds = 5;
  std::uint64_t seed = 1; // of folds and resampling
  // The corrected simulator has what is regular in the rest, too (GapRemainder::rmsWithRest), and so has
  // GapReport::gapAfter.
  bool addRest = false;
  // Standard deviation of the measured reflectance. Empty: what the capture itself shows, up to 0.003.
  std::optional<double> reflectanceNoise;
  // Called with a fraction 0..1 and what is being done; false stops the diagnosis. May be called from
  // the threads of parallelFor.
  std::function<bool(double, const char*)> progress;
  // Runs body(0) .. body(count - 1), in any order, on threads of the caller's. Empty: one after the other.
  // The result does not depend on it.
  std::function<void(int count, const std::function<void(int)>& body)> parallelFor;
  // Runs body() while no other thread runs one: a lock of the caller's. Needed with a parallelFor that uses
  // several threads; empty otherwise.
  std::function<void(const std::function<void()>& body)> exclusive;

  void forAll(
    int count, const std::function<void(int)>& body) const; // by parallelFor, where there is one
};

// Empty only where progress() asked to stop.
//
// Method: Documentation/Filters/SimToRealGap.md. Effects of effectLibrary() are fitted to the averaged
//   readings by bounded robust Gauss-Newton; sets of effects compete by their posterior probability (Diagnosis/SetSearch.h);
//   the figures in GapReport::gap come from samples of outer folds, in which everything, choice included, was done
//   without them.
// Errors: std::invalid_argument naming what disagrees: channel counts, samples without number, readings
//   without sample, an unknown name in `without`, fewer than 2 samples with reading and reflectance.
// Where something unknown is more likely than not, a few samples that fit nothing may be left out (a note names them; NaN in
//   GapReport::gapBefore), and the work is done once more or more often.
// NaN in a sample's reflectance takes the sample out, NaN in a reading takes that reading's channel out.
// Cost: about 1 s on one core for 200 samples x 16 channels x 31 wavelengths; linear in the samples.
std::optional<GapReport> diagnoseGap(const GapCapture& capture, const GapOptions& options = {});

} // namespace msi
