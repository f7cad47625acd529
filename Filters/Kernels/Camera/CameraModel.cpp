#include "Kernels/Camera/CameraModel.h"

#include "Kernels/Spectra/Interpolation.h"
#include "Kernels/Spectra/Reject.h"

#include <cmath>
#include <utility>

namespace msi
{

CameraModel::CameraModel(WavelengthGrid wavelengths, Eigen::MatrixXd responsivity,
  Eigen::VectorXd dark, std::vector<std::string> channels)
  : Grid(std::move(wavelengths))
  , Responsivity(std::move(responsivity))
  , Dark(std::move(dark))
  , Channels(std::move(channels))
{
  const Eigen::Index count = Responsivity.rows();
  if (count == 0)
  {
    reject("a camera needs at least one channel");
  }
  if (Responsivity.cols() != Grid.size())
  {
    reject("the camera's responsivity has ", Responsivity.cols(), " wavelengths, its grid ",
      Grid.size());
  }
  if (Dark.size() != count)
  {
    reject("the camera has ", count, " channels but ", Dark.size(), " dark responses");
  }
  if (Channels.empty())
  {
    for (Eigen::Index k = 0; k < count; ++k)
    {
      Channels.push_back("C" + std::to_string(k + 1));
    }
  }
  if (static_cast<Eigen::Index>(Channels.size()) != count)
  {
    reject("the camera has ", count, " channels but ", Channels.size(), " channel names");
  }
  for (Eigen::Index k = 0; k < count; ++k)
  {
    const std::string& name = Channels[static_cast<std::size_t>(k)];
    if (!std::isfinite(Dark[k]))
    {
      reject("the dark response of channel ", name, " is ", Dark[k], "; expected a finite number");
    }
    for (Eigen::Index j = 0; j < Grid.size(); ++j)
    {
      if (!std::isfinite(Responsivity(k, j)))
      {
        reject("the responsivity of channel ", name, " at ", Grid[j], " nm is ", Responsivity(k, j),
          "; expected a finite number");
      }
    }
  }
}

CameraModel CameraModel::whiteBalanced() const
{
  const Eigen::VectorXd white = whiteResponse();
  for (Eigen::Index k = 0; k < white.size(); ++k)
  {
    if (!(white[k] > 0.0))
    {
      reject("channel ", Channels[static_cast<std::size_t>(k)], " answers a perfect white with ",
        white[k], "; a white balance needs a value above zero");
    }
  }
  return with(white.cwiseInverse().asDiagonal() * Responsivity, Dark.cwiseQuotient(white));
}

CameraModel CameraModel::with(Eigen::MatrixXd responsivity, Eigen::VectorXd dark) const
{
  return { Grid, std::move(responsivity), std::move(dark), Channels };
}

Eigen::VectorXd CameraModel::centroids() const
{
  return (Responsivity * Grid.vector()).cwiseQuotient(whiteResponse());
}

CameraModel resampled(const CameraModel& camera, const WavelengthGrid& wavelengths)
{
  if (wavelengths == camera.wavelengths())
  {
    return camera;
  }
  return { wavelengths, camera.responsivity() * resamplingMatrix(wavelengths, camera.wavelengths()),
    camera.dark(), camera.channels() };
}

AffineTransform cameraResponse(const Eigen::MatrixXd& responsivity, const Eigen::VectorXd& dark)
{
  Eigen::MatrixXd coefficients(responsivity.rows(), responsivity.cols() + 1);
  coefficients << responsivity, dark;
  return AffineTransform(std::move(coefficients));
}

AffineTransform cameraResponse(const CameraModel& camera)
{
  return cameraResponse(camera.responsivity(), camera.dark());
}

} // namespace msi
