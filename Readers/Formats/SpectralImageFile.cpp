#include "Formats/SpectralImageFile.h"

#include <numeric>
#include <stdexcept>
#include <utility>

namespace msi
{

SpectralImageFile::SpectralImageFile(SpectralImageInfo info)
  : Info(std::move(info))
{
}

SpectralImageFile::Block SpectralImageFile::checked(
  const PixelRegion& region, const std::vector<int>& bands, std::ptrdiff_t rowStride) const
{
  if (region.x0 < 0 || region.y0 < 0 || region.x1 > Info.width || region.y1 > Info.height ||
    region.x0 > region.x1 || region.y0 > region.y1)
  {
    throw std::invalid_argument("region [" + std::to_string(region.x0) + ", " +
      std::to_string(region.x1) + ") x [" + std::to_string(region.y0) + ", " +
      std::to_string(region.y1) + ") is not within the image of " + std::to_string(Info.width) +
      " x " + std::to_string(Info.height) + " pixels");
  }
  Block block{ region, bands, rowStride };
  if (bands.empty())
  {
    block.bands.resize(static_cast<std::size_t>(Info.bands()));
    std::iota(block.bands.begin(), block.bands.end(), 0);
  }
  for (const int band : block.bands)
  {
    if (band < 0 || band >= Info.bands())
    {
      throw std::invalid_argument("band " + std::to_string(band) + " is not within the image of " +
        std::to_string(Info.bands()) + " bands");
    }
  }
  if (rowStride == 0)
  {
    block.rowStride =
      static_cast<std::ptrdiff_t>(region.width()) * static_cast<std::ptrdiff_t>(block.bands.size());
  }
  return block;
}

void SpectralImageFile::readBlock(const PixelRegion& region, const std::vector<int>& bands,
  float* pixels, std::ptrdiff_t rowStride) const
{
  const Block block = checked(region, bands, rowStride);
  if (region.width() > 0 && region.height() > 0)
  {
    readChecked(block, pixels);
  }
}

void SpectralImageFile::readBlock(const PixelRegion& region, const std::vector<int>& bands,
  double* pixels, std::ptrdiff_t rowStride) const
{
  const Block block = checked(region, bands, rowStride);
  if (region.width() > 0 && region.height() > 0)
  {
    readChecked(block, pixels);
  }
}

std::unique_ptr<SpectralImageFile> openSpectralImage(
  const std::string& file, const SpectralImageOptions& options)
{
  return openSpectralImage(std::vector<std::string>{ file }, options);
}

} // namespace msi
