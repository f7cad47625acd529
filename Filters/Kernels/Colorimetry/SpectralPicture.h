// What spectra look like in a view: three weights per band and the sRGB encoding.
#pragma once

#include <Eigen/Core>

#include <array>
#include <vector>

namespace msi
{

// Colors of spectra for a display.
//
// Where the bands reach over the visible spectrum (from 490 nm or shorter to 610 nm or longer, at least 3 bands):
// sRGB under D65 for the CIE 1931 2 degree observer, values taken as reflectance, spectra interpolated linearly.
// Elsewhere three bands as red, green and blue: those that were asked for, else the longest, the middle and the
// shortest wavelength; one or two bands as gray.
//
// Shape:  a pixel is `bands` values; a color is 3 bytes.
// Units:  `white` is the value that is shown as white.
// NaN:    a pixel that is not finite is gray (128, 128, 128).
// Errors: the constructor throws std::invalid_argument unless bands >= 1, white is finite and positive, there are no
//         wavelengths or `bands` increasing ones, and the displayed bands exist.
// Cost:   3 multiplications per band and pixel, and a table look-up per channel.
class SpectralPicture
{
public:
  // wavelengths: nm, or none. displayed: 0-based; three (red, green, blue), one (gray) or none.
  SpectralPicture(Eigen::Index bands, const std::vector<double>& wavelengths,
    const std::vector<int>& displayed = {}, double white = 1.0);

  // Whether the colors are sRGB of the spectra; otherwise they are single bands.
  bool isColorimetric() const noexcept { return Colorimetric; }
  // The bands shown as red, green and blue, where the picture is not colorimetric.
  const std::array<int, 3>& shownBands() const noexcept { return Shown; }
  // 3 x bands, to linear sRGB.
  const Eigen::Matrix3Xf& weights() const noexcept { return Weights; }
  // The same picture with another white.
  SpectralPicture withWhite(double white) const;

  void apply(const float* pixels, Eigen::Index count, unsigned char* rgb) const noexcept;

private:
  Eigen::Matrix3Xf Weights;
  std::array<int, 3> Shown{ 0, 0, 0 };
  bool Colorimetric = false;
  double White = 1.0;
};

} // namespace msi
