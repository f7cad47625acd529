#include "SpectralPreview.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <sstream>
#include <vector>

namespace msi
{

namespace
{
constexpr float LargestByte = 255.0F;

// The level that is shown as white.
double whiteOf(const SpectralImageFile& file, const Eigen::Matrix3Xf& weights)
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
}

SpectralPreview::SpectralPreview(const SpectralImageFile& file, bool scaledIntegers)
  : Picture(file.info().bands(), file.info().wavelengths, file.info().displayBands)
{
  const auto& info = file.info();
  if (info.format != "ENVI" && info.sampleType == "uint8" && info.wavelengths.empty() &&
    info.displayBands.size() == 3)
  {
    ScreenScale = scaledIntegers ? LargestByte : 1.0F;
    Description = "the picture is the file's";
    return;
  }
  std::ostringstream text;
  if (Picture.isColorimetric())
  {
    text << "the picture is sRGB under D65";
  }
  else
  {
    const auto& bands = Picture.shownBands();
    text << "the picture shows the bands " << bands[0] + 1 << ", " << bands[1] + 1 << ", "
         << bands[2] + 1 << " as red, green, blue";
  }
  White = file.info().quantity == "reflectance" ? 1.0 : whiteOf(file, Picture.weights());
  text << "; white is " << White;
  Picture = Picture.withWhite(White);
  Description = text.str();
}

void SpectralPreview::apply(
  const float* pixels, Eigen::Index count, unsigned char* rgb) const noexcept
{
  if (!isScreenPicture())
  {
    Picture.apply(pixels, count, rgb);
    return;
  }
  const auto bands = Picture.weights().cols();
  for (Eigen::Index i = 0; i < count; ++i)
  {
    for (std::size_t color = 0; color < 3; ++color)
    {
      const float value = pixels[i * bands + Picture.shownBands()[color]] * ScreenScale;
      rgb[3 * i + static_cast<Eigen::Index>(color)] =
        static_cast<unsigned char>(std::clamp(value + 0.5F, 0.0F, LargestByte));
    }
  }
}

} // namespace msi
