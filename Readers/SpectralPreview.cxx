#include "SpectralPreview.h"

#include "Kernels/Colorimetry/Illuminant.h"
#include "Kernels/Colorimetry/SRGB.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <vector>

namespace msi
{

namespace
{
constexpr double Blue = 490.0; // nm: a picture needs bands on both sides
constexpr double Red = 610.0;
constexpr double ShortestVisible = 380.0;
constexpr double LongestVisible = 780.0;

// Bands whose wavelengths are visible; none where they do not reach over the spectrum.
std::vector<Eigen::Index> visibleBands(const SpectralImageInfo& info)
{
  std::vector<Eigen::Index> bands;
  for (std::size_t b = 0; b < info.wavelengths.size(); ++b)
  {
    if (info.wavelengths[b] >= ShortestVisible && info.wavelengths[b] <= LongestVisible)
    {
      bands.push_back(static_cast<Eigen::Index>(b));
    }
  }
  const auto nm = [&](Eigen::Index b) { return info.wavelengths[static_cast<std::size_t>(b)]; };
  if (bands.size() < 3 || nm(bands.front()) > Blue || nm(bands.back()) < Red)
  {
    bands.clear();
  }
  return bands;
}

Eigen::Matrix3Xd colorimetricWeights(
  const SpectralImageInfo& info, const std::vector<Eigen::Index>& bands)
{
  std::vector<double> wavelengths;
  wavelengths.reserve(bands.size());
  for (const auto b : bands)
  {
    wavelengths.push_back(info.wavelengths[static_cast<std::size_t>(b)]);
  }
  const TristimulusTransform tristimulus(WavelengthGrid(std::move(wavelengths)),
    Illuminant::named("D65"), StandardObserver::cie1931TwoDegree(), InterpolationMethod::Linear);
  const Eigen::Matrix3Xd visible =
    SRGB(tristimulus.whitePoint()).linearMatrix() * tristimulus.weights();
  Eigen::Matrix3Xd weights = Eigen::Matrix3Xd::Zero(3, info.bands());
  for (std::size_t i = 0; i < bands.size(); ++i)
  {
    weights.col(bands[i]) = visible.col(static_cast<Eigen::Index>(i));
  }
  return weights;
}

// Red, green and blue.
std::array<int, 3> shownBands(const SpectralImageInfo& info)
{
  const auto& shown = info.displayBands;
  if (shown.size() == 3)
  {
    return { shown[0], shown[1], shown[2] };
  }
  if (!shown.empty() || info.bands() < 3)
  {
    const int gray = shown.empty() ? 0 : shown[0];
    return { gray, gray, gray };
  }
  return { info.bands() - 1, info.bands() / 2, 0 };
}

// The level that is shown as white.
double whiteOf(const SpectralImageFile& file, const Eigen::Matrix3Xd& weights)
{
  constexpr int Rows = 32;
  constexpr int MostColumns = 4096;
  const auto& info = file.info();
  const auto bands = static_cast<Eigen::Index>(info.bands());
  const int width = std::min(info.width, MostColumns);
  const int x0 = (info.width - width) / 2;
  const int rows = std::min(info.height, Rows);
  std::vector<float> values(static_cast<std::size_t>(width) * static_cast<std::size_t>(bands));
  std::vector<float> largest;
  for (int i = 0; i < rows; ++i)
  {
    const int y = static_cast<int>((2LL * i + 1) * info.height / (2LL * rows));
    file.readBlock({ x0, x0 + width, y, y + 1 }, {}, values.data());
    for (int x = 0; x < width; ++x)
    {
      const float* pixel = values.data() + static_cast<Eigen::Index>(x) * bands;
      float most = 0.0F;
      for (Eigen::Index b = 0; b < bands; ++b)
      {
        const bool used = weights.col(b).any();
        most = used && std::isfinite(pixel[b]) ? std::max(most, pixel[b]) : most;
      }
      if (most > 0.0F)
      {
        largest.push_back(most);
      }
    }
  }
  if (largest.empty())
  {
    return 1.0;
  }
  const auto at = largest.begin() + static_cast<std::ptrdiff_t>((largest.size() - 1) * 99 / 100);
  std::nth_element(largest.begin(), at, largest.end());
  return static_cast<double>(*at);
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
}

SpectralPreview::SpectralPreview(const SpectralImageFile& file)
{
  const auto& info = file.info();
  const auto visible = visibleBands(info);
  Eigen::Matrix3Xd weights;
  std::ostringstream text;
  if (!visible.empty())
  {
    weights = colorimetricWeights(info, visible);
    text << "the picture is sRGB under D65";
  }
  else
  {
    const auto bands = shownBands(info);
    weights = Eigen::Matrix3Xd::Zero(3, info.bands());
    for (int i = 0; i < 3; ++i)
    {
      weights(i, bands[static_cast<std::size_t>(i)]) = 1.0;
    }
    text << "the picture shows the bands " << bands[0] + 1 << ", " << bands[1] + 1 << ", "
         << bands[2] + 1 << " as red, green, blue";
  }
  const double white = info.quantity == "reflectance" ? 1.0 : whiteOf(file, weights);
  text << "; white is " << white;
  Weights = (weights / white).cast<float>();
  Description = text.str();
}

void SpectralPreview::apply(
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
