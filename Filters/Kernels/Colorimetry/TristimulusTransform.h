// From spectral reflectance to tristimulus values.
#pragma once

#include "Kernels/Colorimetry/Illuminant.h"
#include "Kernels/Colorimetry/StandardObserver.h"
#include "Kernels/Colorimetry/TristimulusBlocks.h"
#include "Kernels/Spectra/Interpolation.h"
#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

namespace msi
{

// XYZ = weights() * reflectance: the integral at 1 nm folded into one column of weights a band.
//
// Source: CIE 15:2018. The sum runs at 1 nm over 360..830 nm where the illuminant has values;
//         outside its table it counts as dark. Reflectance is interpolated to 1 nm and held at its
//         end values outside its grid. The default, cubic Lagrange, is what ASTM E308 builds its
//         weights with, and agrees with ArgyllCMS to 0.005 in XYZ and 0.01 in L*a*b* on grids coarser
//         than 5 nm. At 5 nm and finer ArgyllCMS interpolates linearly (InterpolationMethod::Linear
//         agrees as closely), which is off by up to 0.15 in L*a*b* where a spectrum rises steeply.
//         There is no correction for the instrument's bandpass.
// Shape:  reflectance bands x samples, one column a sample; XYZ 3 x samples.
// Units:  reflectance factor, 1 = perfect reflecting diffuser, for which Y = 100.
// NaN:    a sample with a NaN gives NaN for itself and for no other.
// Bytes:  a sample's XYZ does not depend on which other samples stand in the block.
// Errors: the constructor throws std::invalid_argument where the observer sees nothing of the
//         illuminant, or the grid does not carry the interpolation method.
class TristimulusTransform
{
public:
  TristimulusTransform(const WavelengthGrid& wavelengths, const Illuminant& illuminant,
    const StandardObserver& observer = StandardObserver::cie1931TwoDegree(),
    InterpolationMethod method = InterpolationMethod::CubicLagrange);

  const WavelengthGrid& wavelengths() const noexcept { return Wavelengths; }
  const Eigen::Matrix3Xd& weights() const noexcept { return Weights; }
  // XYZ of the perfect reflecting diffuser; Y = 100.
  const Eigen::Vector3d& whitePoint() const noexcept { return WhitePoint; }
  // The share, 0..1, of the white point's X, Y and Z that comes from wavelengths outside the grid,
  // where the reflectance is not known but held.
  const Eigen::Vector3d& extrapolatedShare() const noexcept { return ExtrapolatedShare; }

  // Block calls, for shapes already checked: reflectance has wavelengths().size() rows, xyz as many
  // columns as reflectance. For reflectance within 0..1 the float call is within 3e-5 of the
  // double one.
  void apply(const Eigen::Ref<const Eigen::MatrixXd>& reflectance,
    Eigen::Ref<Eigen::Matrix3Xd> xyz) const noexcept;
  void apply(const Eigen::Ref<const Eigen::MatrixXf>& reflectance,
    Eigen::Ref<Eigen::Matrix3Xf> xyz) const noexcept;

  // The same, checked: throws std::invalid_argument where the number of bands disagrees.
  Eigen::Matrix3Xd operator()(const Eigen::MatrixXd& reflectance) const;

private:
  WavelengthGrid Wavelengths;
  Eigen::Matrix3Xd Weights;
  Eigen::Matrix4Xd DoubleWeights; // padded by a row, for aligned loads
  TristimulusBlocks FloatBlocks;
  Eigen::Vector3d WhitePoint;
  Eigen::Vector3d ExtrapolatedShare;
};

} // namespace msi
