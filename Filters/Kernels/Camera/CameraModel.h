// A multispectral camera as numbers: spectral responsivity, dark response, channel names.
#pragma once

#include "Kernels/Numerics/AffineTransform.h"
#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

// The matrix M and the dark response b of u = M r + b, immutable.
//
// Source: "Correcting cross-media instrument metamerism for reflectance estimation in multispectral
//         imaging", 2011, doi:10.1364/JOSAA.28.000511, Eq. 3.
// Shapes: responsivity K x N (channels x wavelengths), dark K.
// Units:  response relative to white; light x filter x detector x wavelength step are multiplied
//         into the responsivity already, so that a plain sum over wavelengths is the integral.
// Range:  every element finite. Negative responsivity is allowed (a fit may carry it).
// Errors: std::invalid_argument naming the two numbers that disagree, or the element at fault.
class CameraModel
{
public:
  // Empty names become C1, C2, ...
  CameraModel(WavelengthGrid wavelengths, Eigen::MatrixXd responsivity, Eigen::VectorXd dark,
    std::vector<std::string> channels = {});

  const WavelengthGrid& wavelengths() const noexcept { return Grid; }
  const Eigen::MatrixXd& responsivity() const noexcept { return Responsivity; }
  const Eigen::VectorXd& dark() const noexcept { return Dark; }
  const std::vector<std::string>& channels() const noexcept { return Channels; }
  Eigen::Index channelCount() const noexcept { return Responsivity.rows(); }

  // Response to a perfect white, without the dark response: the row sums of the responsivity.
  Eigen::VectorXd whiteResponse() const { return Responsivity.rowwise().sum(); }

  // The same camera with every channel scaled so that a perfect white gives 1 above dark. The dark
  // response is scaled alike. Throws where a channel's white response is not above zero.
  CameraModel whiteBalanced() const;

  // The same camera with another responsivity (K x N) or dark response.
  CameraModel with(Eigen::MatrixXd responsivity, Eigen::VectorXd dark) const;

  // Responsivity-weighted mean wavelength of each channel, nm; NaN where a row has no weight.
  Eigen::VectorXd centroids() const;

private:
  WavelengthGrid Grid;
  Eigen::MatrixXd Responsivity;
  Eigen::VectorXd Dark;
  std::vector<std::string> Channels;
};

// The camera M T with T = resamplingMatrix(wavelengths, camera's grid): it answers to a spectrum on `wavelengths` as
// the given camera answers to that spectrum interpolated to its own grid. The response to white is kept.
// Errors: as resamplingMatrix.
CameraModel resampled(const CameraModel& camera, const WavelengthGrid& wavelengths);

// The ideal response u = M r + b, no noise and no unmodelled effect, from N reflectances to K responses a column.
// A response's bytes depend on its own reflectance alone; accuracy and cost as stated for AffineTransform.
AffineTransform cameraResponse(const Eigen::MatrixXd& responsivity, const Eigen::VectorXd& dark);
AffineTransform cameraResponse(const CameraModel& camera);

} // namespace msi
