// What a spectral image looks like: colors for a first look at a file.
#ifndef SpectralPreview_h
#define SpectralPreview_h

#include "Formats/SpectralImageFile.h"
#include "Kernels/Colorimetry/SpectralPicture.h"

#include <Eigen/Core>

#include <string>

namespace msi
{

// Colors of the pixels of one image (Kernels/Colorimetry/SpectralPicture.h), which depend on the pixel and the file
// alone.
//
// A picture for the screen is shown as it is: 8 bits of red, green and blue, which no wavelengths go with.
//
// White: 1 where the file holds reflectance, else the 99th percentile of the largest value of each pixel over some rows
// spread over the image.
class SpectralPreview
{
public:
  // scaledIntegers: the largest integer is read as 1.
  SpectralPreview(const SpectralImageFile& file, bool scaledIntegers);

  // pixels: bands() values each. rgb: 3 bytes each; a pixel that is not finite is gray (128).
  void apply(const float* pixels, Eigen::Index count, unsigned char* rgb) const noexcept;
  // What the colors are, one remark.
  const std::string& description() const noexcept { return Description; }
  // Whether the colors are those of the spectra.
  bool isColorimetric() const noexcept { return Picture.isColorimetric(); }
  // Whether the file is an ordinary color picture.
  bool isScreenPicture() const noexcept { return ScreenScale > 0.0F; }
  // The value that is shown as white.
  double white() const noexcept { return White; }

private:
  SpectralPicture Picture;
  double White = 1.0;
  float ScreenScale = 0.0F; // from values to bytes of a picture for the screen
  std::string Description;
};

} // namespace msi

#endif
