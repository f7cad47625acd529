// What a spectral image looks like: colors for a first look at a file.
#ifndef SpectralPreview_h
#define SpectralPreview_h

#include "Formats/SpectralImageFile.h"

#include <Eigen/Core>

#include <string>

namespace msi
{

// Colors of the pixels of one image, which depend on the pixel and the file alone.
//
// Where the bands reach over the visible spectrum: sRGB under D65 (CIE 1931 2 degree observer), values taken as
// reflectance. Elsewhere the bands that the file wants to be shown, else the longest, the middle and the shortest
// wavelength as red, green and blue; one or two bands as gray.
// White: 1 where the file holds reflectance, else the 99th percentile of the largest value of each pixel over some rows
// spread over the image.
class SpectralPreview
{
public:
  explicit SpectralPreview(const SpectralImageFile& file);

  // pixels: bands() values each. rgb: 3 bytes each; a pixel that is not finite is gray (128).
  void apply(const float* pixels, Eigen::Index count, unsigned char* rgb) const noexcept;
  // What the colors are, one remark.
  const std::string& description() const noexcept { return Description; }

private:
  Eigen::Matrix3Xf Weights; // to linear sRGB
  std::string Description;
};

} // namespace msi

#endif
