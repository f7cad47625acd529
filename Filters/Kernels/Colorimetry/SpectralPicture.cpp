#include "Kernels/Colorimetry/SpectralPicture.h"

#include "Kernels/Colorimetry/Illuminant.h"
#include "Kernels/Colorimetry/SRGB.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"

#include <algorithm>
#include <cmath>
#include <stdexcept>
#include <string>
#include <utility>

namespace msi
{

namespace
{
constexpr double Blue = 490.0; // nm: a picture needs bands on both sides
constexpr double Red = 610.0;
constexpr double ShortestVisible = 380.0;
constexpr double LongestVisible = 780.0;

// Bands whose wavelengths are visible; none where they do not reach over the spectrum.
std::vector<Eigen::Index> visibleBands(const std::vector<double>& wavelengths)
{
  std::vector<Eigen::Index> bands;
  for (std::size_t b = 0; b < wavelengths.size(); ++b)
  {
    if (wavelengths[b] >= ShortestVisible && wavelengths[b] <= LongestVisible)
    {
      bands.push_back(static_cast<Eigen::Index>(b));
    }
  }
  const auto nm = [&](Eigen::Index b) { return wavelengths[static_cast<std::size_t>(b)]; };
  if (bands.size() < 3 || nm(bands.front()) > Blue || nm(bands.back()) < Red)
  {
    bands.clear();
  }
  return bands;
}

Eigen::Matrix3Xd colorimetricWeights(Eigen::Index count, const std::vector<double>& wavelengths,
  const std::vector<Eigen::Index>& bands)
{
  std::vector<double> visible;
  visible.reserve(bands.size());
  for (const auto b : bands)
  {
    visible.push_back(wavelengths[static_cast<std::size_t>(b)]);
  }
  const TristimulusTransform tristimulus(WavelengthGrid(std::move(visible)),
    Illuminant::named("D65"), StandardObserver::cie1931TwoDegree(), InterpolationMethod::Linear);
  const Eigen::Matrix3Xd linear =
    SRGB(tristimulus.whitePoint()).linearMatrix() * tristimulus.weights();
  Eigen::Matrix3Xd weights = Eigen::Matrix3Xd::Zero(3, count);
  for (std::size_t i = 0; i < bands.size(); ++i)
  {
    weights.col(bands[i]) = linear.col(static_cast<Eigen::Index>(i));
  }
  return weights;
}

std::array<int, 3> bandsToShow(Eigen::Index bands, const std::vector<int>& displayed)
{
  if (displayed.size() == 3)
  {
    return { displayed[0], displayed[1], displayed[2] };
  }
  if (!displayed.empty() || bands < 3)
  {
    const int gray = displayed.empty() ? 0 : displayed[0];
    return { gray, gray, gray };
  }
  return { static_cast<int>(bands) - 1, static_cast<int>(bands) / 2, 0 };
}

constexpr int Steps = 4096;

const std::array<unsigned char, Steps + 1>& encoding()
{
  static const auto table = []
  {
    std::array<unsigned char, Steps + 1> bytes{};
    for (int i = 0; i <= Steps; ++i)
    {
      bytes[static_cast<std::size_t>(i)] = static_cast<unsigned char>(
        std::lround(255.0 * SRGB::encode(static_cast<double>(i) / Steps)));
    }
    return bytes;
  }();
  return table;
}

void requireWhite(double white)
{
  if (!(std::isfinite(white) && white > 0.0))
  {
    throw std::invalid_argument(
      "the white of a picture is " + std::to_string(white) + "; expected a finite value above 0");
  }
}
}

SpectralPicture::SpectralPicture(Eigen::Index bands, const std::vector<double>& wavelengths,
  const std::vector<int>& displayed, double white)
  : White(white)
{
  requireWhite(white);
  const bool exist = std::all_of(
    displayed.begin(), displayed.end(), [&](int band) { return band >= 0 && band < bands; });
  if (bands < 1 || !exist ||
    (!wavelengths.empty() && static_cast<Eigen::Index>(wavelengths.size()) != bands))
  {
    throw std::invalid_argument("a picture of " + std::to_string(bands) + " bands was given " +
      std::to_string(wavelengths.size()) +
      " wavelengths and bands to display; expected as many wavelengths as bands, or none, and "
      "displayed bands that exist");
  }
  const auto visible = visibleBands(wavelengths);
  Colorimetric = !visible.empty();
  Eigen::Matrix3Xd weights;
  if (Colorimetric)
  {
    weights = colorimetricWeights(bands, wavelengths, visible);
  }
  else
  {
    Shown = bandsToShow(bands, displayed);
    weights = Eigen::Matrix3Xd::Zero(3, bands);
    for (int i = 0; i < 3; ++i)
    {
      weights(i, Shown[static_cast<std::size_t>(i)]) = 1.0;
    }
  }
  Weights = (weights / white).cast<float>();
}

SpectralPicture SpectralPicture::withWhite(double white) const
{
  requireWhite(white);
  SpectralPicture other(*this);
  other.Weights = Weights * static_cast<float>(White / white);
  other.White = white;
  return other;
}

void SpectralPicture::apply(
  const float* pixels, Eigen::Index count, unsigned char* rgb) const noexcept
{
  constexpr unsigned char Unknown = 128;
  const auto& encoded = encoding();
  const Eigen::Index bands = Weights.cols();
  for (Eigen::Index i = 0; i < count; ++i, rgb += 3)
  {
    const Eigen::Vector3f linear =
      Weights * Eigen::Map<const Eigen::VectorXf>(pixels + i * bands, bands);
    for (int c = 0; c < 3; ++c)
    {
      rgb[c] = linear.allFinite()
        ? encoded[static_cast<std::size_t>(std::lround(std::clamp(linear[c], 0.0F, 1.0F) * Steps))]
        : Unknown;
    }
  }
}

} // namespace msi
