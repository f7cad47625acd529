// A chart or a book of dyed fabric as an image of any size, computed where it is asked for.
#pragma once

#include "Kernels/Scenes/PatchLayout.h"
#include "Kernels/Scenes/SampleBook.h"
#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <cstdint>
#include <optional>
#include <string>
#include <vector>

namespace msi::scenes
{

enum class SceneSubject
{
  Chart24,  // 6 x 4 printed patches: greys, single inks, overprints
  Chart140, // 14 x 10
  Fabric    // 6 x 4 swatches of dyed cotton on a tartan
};

struct SceneOptions
{
  SceneSubject subject = SceneSubject::Chart24;
  int width = 512; // pixels
  int height = 384;
  std::uint64_t seed = 1;
  // 1: as such papers and fabrics are; 0: even patches, a flat weave.
  double texture = 1.0;
  // Fabric: probability that light leaving a yarn strikes a yarn again; mean over the swatches.
  double interreflection = 0.16;
  double yarnWidth = 4.4; // fabric: mean over the swatches, pixels
};

// Reflectance factor towards a 45/0 camera, relative to a perfect white in even light.
//
// Source: body reflectance of the colorants by KubelkaMunk.h; paper through its surface (Saunderson); fabric by
//         WovenFabric.h: shade r (1 - p) / (1 - p r) from point to point.
// Shapes: wavelengths N, patches P; patch reflectance N x P, the mean over the patch. A pixel's reflectance depends on
//         its place, the options and the wavelength alone, so any piece of any size gives the same bytes.
// Range:  texture 0..3, interreflection 0..0.5, yarn width 2..64 pixels; wavelengths from 360 to 780 nm.
// Errors: std::invalid_argument from the constructor, naming the value and the range, also for an image too small for
//         its patches.
class SyntheticScene
{
public:
  SyntheticScene(const WavelengthGrid& wavelengths, const SceneOptions& options);

  const WavelengthGrid& wavelengths() const noexcept { return Wavelengths; }
  const PatchLayout& layout() const noexcept { return Layout; }
  const std::vector<std::string>& samples() const noexcept { return Samples; }
  const char* medium() const noexcept { return Book ? "fabric" : "paper"; }
  const Eigen::MatrixXd& patchReflectance() const noexcept { return PatchMeans; }

  // 1 .. P well inside a patch, else 0. Row 0 is the top row.
  int label(int x, int y) const noexcept;

  // N values for each of `count` pixels from (x, y) to the right.
  void reflectance(int x, int y, int count, float* values) const;

private:
  WavelengthGrid Wavelengths;
  PatchLayout Layout;
  int Inside;
  std::uint64_t Seed;
  double Texture;
  std::vector<std::string> Samples;
  Eigen::MatrixXd PatchMeans;
  Eigen::ArrayXd Frame;
  std::optional<SampleBook> Book;
};

} // namespace msi::scenes
