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

SpectralPreview::SpectralPreview(const SpectralImageFile& file)
  : Picture(file.info().bands(), file.info().wavelengths, file.info().displayBands)
{
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
  Picture.apply(pixels, count, rgb);
}

} // namespace msi
