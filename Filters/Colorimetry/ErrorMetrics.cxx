#include "ErrorMetrics.h"

#include "Kernels/Difference/SpectralRms.h"

#include <algorithm>
#include <stdexcept>

namespace msi
{

ErrorMetrics::ErrorMetrics(const SpectralAxis& bands, const std::vector<std::string>& illuminants,
  const std::string& observer, const CIEDE2000Factors& factors)
  : Bands(static_cast<Eigen::Index>(bands.size()))
  , Difference(factors)
{
  if (!bands.wavelengths)
  {
    throw std::invalid_argument("the estimate has no wavelengths (field data 'Wavelength'); color "
                                "difference needs reflectance whose wavelengths are known");
  }
  for (const auto& name : illuminants)
  {
    TristimulusTransform tristimulus(
      *bands.wavelengths, Illuminant::named(name), StandardObserver::named(observer));
    const CIELAB lab(tristimulus.whitePoint());
    Colors.push_back({ std::move(tristimulus), lab });
  }
}

std::vector<Eigen::VectorXd> ErrorMetrics::operator()(
  const Eigen::MatrixXd& estimate, const Eigen::MatrixXd& reference) const
{
  std::vector<Eigen::VectorXd> errors(1 + Colors.size(), Eigen::VectorXd(estimate.cols()));
  spectralRms(reference, estimate, errors[0]);
  for (std::size_t i = 0; i < Colors.size(); ++i)
  {
    Eigen::Matrix3Xd lab[2];
    for (int side = 0; side < 2; ++side)
    {
      lab[side] = Colors[i].tristimulus(side == 0 ? estimate : reference);
      Colors[i].lab.fromXYZ(lab[side], lab[side]);
    }
    Difference.apply(lab[0], lab[1], errors[i + 1]);
  }
  return errors;
}

void ErrorMetrics::apply(const float* estimate, const float* reference, Eigen::Index pixels,
  const std::vector<float*>& errors) const noexcept
{
  constexpr Eigen::Index Block = 256;
  Eigen::Matrix<float, 3, Block> labs[2];
  for (Eigen::Index at = 0; at < pixels; at += Block)
  {
    const auto count = std::min(Block, pixels - at);
    using Spectra = Eigen::Map<const Eigen::MatrixXf>;
    const Spectra blocks[] = { Spectra(estimate + at * Bands, Bands, count),
      Spectra(reference + at * Bands, Bands, count) };
    spectralRms(blocks[1], blocks[0], Eigen::Map<Eigen::VectorXf>(errors[0] + at, count));
    for (std::size_t i = 0; i < Colors.size(); ++i)
    {
      for (int side = 0; side < 2; ++side)
      {
        auto lab = labs[side].leftCols(count);
        Colors[i].tristimulus.apply(blocks[side], lab);
        Colors[i].lab.fromXYZ(lab, lab);
      }
      Difference.apply(labs[0].leftCols(count), labs[1].leftCols(count),
        Eigen::Map<Eigen::VectorXf>(errors[i + 1] + at, count));
    }
  }
}

} // namespace msi
