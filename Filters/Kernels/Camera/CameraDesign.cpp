#include "Kernels/Camera/CameraDesign.h"

#include "Kernels/Spectra/Reject.h"

#include <array>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
// Absorption coefficient of intrinsic silicon at 300 K, 1/cm, every 20 nm from 360 nm (source in the header).
constexpr double FirstSiliconWavelength = 360.0;
constexpr double SiliconStep = 20.0;
constexpr std::array<double, 33> SiliconAbsorption = { 1.02e6, 2.93e5, 9.52e4, 5.00e4, 3.11e4,
  2.10e4, 1.48e4, 1.11e4, 8.80e3, 7.05e3, 5.78e3, 4.88e3, 4.14e3, 3.52e3, 3.04e3, 2.58e3, 2.21e3,
  1.90e3, 1.66e3, 1.42e3, 1.19e3, 1.01e3, 8.50e2, 7.07e2, 5.91e2, 4.80e2, 3.83e2, 3.06e2, 2.40e2,
  1.83e2, 1.34e2, 9.59e1, 6.40e1 };
constexpr double CentimetresPerMicrometre = 1e-4;

double siliconAbsorption(double wavelength)
{
  const double position = (wavelength - FirstSiliconWavelength) / SiliconStep;
  const auto below = static_cast<std::size_t>(
    std::min(std::floor(position), static_cast<double>(SiliconAbsorption.size() - 2)));
  const double t = position - static_cast<double>(below);
  return std::exp(
    (1.0 - t) * std::log(SiliconAbsorption[below]) + t * std::log(SiliconAbsorption[below + 1]));
}

Eigen::VectorXd integrationWeights(const WavelengthGrid& grid)
{
  const Eigen::Index count = grid.size();
  if (const auto step = grid.step())
  {
    return Eigen::VectorXd::Constant(count, *step);
  }
  Eigen::VectorXd weights = Eigen::VectorXd::Zero(count);
  if (count == 1)
  {
    weights[0] = 1.0;
  }
  for (Eigen::Index j = 1; j < count; ++j)
  {
    const double half = 0.5 * (grid[j] - grid[j - 1]);
    weights[j - 1] += half;
    weights[j] += half;
  }
  return weights;
}

void requireLength(const char* what, Eigen::Index length, const WavelengthGrid& grid)
{
  if (length != grid.size())
  {
    reject("the camera's ", what, " has ", length, " values, its wavelength grid ", grid.size());
  }
}

void requireValid(const BandpassFilter& filter, std::size_t position)
{
  const bool valid = std::isfinite(filter.center) && filter.width > 0.0 && filter.order >= 1.0 &&
    filter.leak >= 0.0 && filter.peak >= filter.leak && filter.peak <= 1.0;
  if (!valid)
  {
    reject("filter ", position + 1, " has center ", filter.center, " nm, width ", filter.width,
      " nm, order ", filter.order, ", peak ", filter.peak, ", leak ", filter.leak,
      "; expected width > 0, order >= 1, 0 <= leak <= peak <= 1");
  }
}

std::string centerName(const BandpassFilter& filter)
{
  std::ostringstream name;
  name << filter.center << "nm";
  return name.str();
}
}

double transmittance(const BandpassFilter& filter, double wavelength) noexcept
{
  const double distance = std::abs(2.0 * (wavelength - filter.center) / filter.width);
  return filter.leak + (filter.peak - filter.leak) * std::exp2(-std::pow(distance, filter.order));
}

Eigen::VectorXd planckianLight(const WavelengthGrid& wavelengths, double temperature)
{
  if (!(temperature > 0.0) || !std::isfinite(temperature))
  {
    reject("the temperature of a Planckian light is ", temperature, " K; expected above 0");
  }
  constexpr double SecondRadiation = 1.438776877e7; // nm K
  const auto radiance = [temperature](double wavelength)
  {
    return std::pow(wavelength / 560.0, -5.0) /
      std::expm1(SecondRadiation / (wavelength * temperature));
  };
  const double reference = radiance(560.0);
  return wavelengths.vector().unaryExpr(
    [&](double wavelength) { return radiance(wavelength) / reference; });
}

Eigen::VectorXd siliconDetector(
  const WavelengthGrid& wavelengths, double thickness, double deadLayer)
{
  constexpr double Last =
    FirstSiliconWavelength + SiliconStep * static_cast<double>(SiliconAbsorption.size() - 1);
  if (!(wavelengths.front() >= FirstSiliconWavelength && wavelengths.back() <= Last))
  {
    reject("the silicon detector is known from ", FirstSiliconWavelength, " to ", Last,
      " nm; the grid runs from ", wavelengths.front(), " to ", wavelengths.back());
  }
  if (!(thickness > 0.0 && deadLayer >= 0.0 && std::isfinite(thickness + deadLayer)))
  {
    throw std::invalid_argument(
      "a silicon detector needs a thickness above zero and a dead layer of zero or more");
  }
  Eigen::VectorXd curve = wavelengths.vector().unaryExpr(
    [&](double wavelength)
    {
      const double alpha = siliconAbsorption(wavelength) * CentimetresPerMicrometre;
      // Electrons per photon, times photons per energy (proportional to the wavelength).
      return wavelength * std::exp(-alpha * deadLayer) * -std::expm1(-alpha * thickness);
    });
  return curve / curve.maxCoeff();
}

CameraModel designCamera(const WavelengthGrid& wavelengths, const CameraParts& parts)
{
  requireLength("light", parts.light.size(), wavelengths);
  requireLength("detector", parts.detector.size(), wavelengths);
  const auto channelCount = static_cast<Eigen::Index>(parts.filters.size());
  const Eigen::VectorXd common =
    parts.light.cwiseProduct(parts.detector).cwiseProduct(integrationWeights(wavelengths));
  Eigen::MatrixXd responsivity(channelCount, wavelengths.size());
  std::vector<std::string> names = parts.channels;
  for (Eigen::Index k = 0; k < channelCount; ++k)
  {
    const auto position = static_cast<std::size_t>(k);
    const BandpassFilter& filter = parts.filters[position];
    requireValid(filter, position);
    responsivity.row(k) =
      wavelengths.vector()
        .unaryExpr([&](double wavelength) { return transmittance(filter, wavelength); })
        .cwiseProduct(common);
    if (parts.channels.empty())
    {
      names.push_back(centerName(filter));
    }
  }
  return CameraModel(
    wavelengths, std::move(responsivity), Eigen::VectorXd::Zero(channelCount), std::move(names))
    .whiteBalanced();
}

} // namespace msi
