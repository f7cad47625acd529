// A camera with everything that can be wrong with one, on images.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraNoise.h"
#include "Kernels/Camera/Imaging/ChannelRegistration.h"
#include "Kernels/Camera/Imaging/ImageWindow.h"
#include "Kernels/Camera/Imaging/RowConvolution.h"
#include "Kernels/Camera/Imaging/ScatterTail.h"
#include "Kernels/Camera/Imaging/SceneMean.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace msi
{

struct ImageSimulatorOptions
{
  CameraNoise noise = {};
  std::uint64_t seed = 1;
  std::uint32_t exposure = 0;          // another number, other temporal noise
  bool whiteAfterEffects = false;      // as in CameraSimulatorOptions
  std::vector<std::string> media = {}; // names of the numbers 0, 1, ... in a medium image
};

// Memory of a run, one for each thread: the rows that neighbourhood effects reach; it grows to what a window needs
// and stays.
struct ImageWorkspace
{
  RegistrationRows registration;
  RowConvolution blur;
  ScatterRows tail;
  std::vector<float> row, reflectance, surround;
  std::vector<double> fieldY;
  std::vector<int> medium;
};

// From a reflectance image (N values a pixel) to a response image (K values a pixel), window by window.
//
// Order:  that of CameraSimulator; after the irradiance of the single pixels: distortion, misregistration, defocus, local
//         stray light, veiling glare, lag, banding; after the detector effects the noise.
// Pieces: a pixel's bytes depend neither on the window nor on the piece that supplied its surround.
//         Without neighbourhood effects and noise they are those of cameraResponse() in single precision.
// Field:  (x, y) run from -1 to 1 over the longer side, from pixel center to pixel center.
// NaN:    stays in its pixel; with distortion, misregistration, defocus or local stray light it spreads over their reach.
// Errors: std::invalid_argument from the constructor as EffectChain, for an empty extent, and for
//         session_drift (it concerns samples captured one after the other); from the calls for a window
//         outside the image or not covered by what is available, or media that are missing.
class ImageSimulator
{
public:
  ImageSimulator(CameraModel camera, std::vector<CameraEffect> effects, const ImageExtent& extent,
    const ImageSimulatorOptions& options = {});
  ~ImageSimulator();
  ImageSimulator(ImageSimulator&&) noexcept;
  ImageSimulator& operator=(ImageSimulator&&) noexcept;

  int wavelengthCount() const noexcept;
  int channelCount() const noexcept;
  // Pixels around a window whose reflectance its response depends on.
  int halo() const noexcept;
  // Whether simulate() needs the mean of the whole scene, gathered by addToMean() before.
  bool needsSceneMean() const noexcept;
  bool needsMedium() const noexcept;

  // reflectance, medium: the pixels of `window` alone.
  void addToMean(const float* reflectance, const int* medium, const ImageWindow& window,
    SceneMean& mean, ImageWorkspace& workspace) const;

  // reflectance, medium: the pixels of `available`, which must cover the window and its halo as far as the
  // image goes. response: the pixels of `window`.
  void simulate(const float* reflectance, const int* medium, const ImageWindow& available,
    const ImageWindow& window, const SceneMean* mean, float* response,
    ImageWorkspace& workspace) const;

private:
  struct Implementation;
  std::unique_ptr<Implementation> Self;
};

} // namespace msi
