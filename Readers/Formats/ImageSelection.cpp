#include "Formats/ImageSelection.h"

#include "Formats/FormatError.h"
#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <cstddef>
#include <iterator>
#include <sstream>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
int count(int length, int stride)
{
  return (length + stride - 1) / stride;
}

[[noreturn]] void refuseBands(
  const std::string& name, const std::string& item, const std::string& list)
{
  throw FormatError(name,
    "'" + item + "' in the list of bands '" + list + "' is no band or range of bands",
    "band numbers from 1 on, such as 1-16, 20",
    "correct the list, or leave it empty for all bands");
}

// 0-based, increasing.
std::vector<int> bandsIn(const std::string& list, int bands, const std::string& name)
{
  std::vector<bool> chosen(static_cast<std::size_t>(bands), trimmed(list).empty());
  std::istringstream items(trimmed(list).empty() ? std::string() : list);
  std::string item;
  while (std::getline(items, item, ','))
  {
    const auto dash = item.find('-');
    const auto first = parseInteger(trimmed(item.substr(0, dash)));
    const auto last =
      dash == std::string::npos ? first : parseInteger(trimmed(item.substr(dash + 1)));
    if (!first || !last || *first < 1 || *last < *first)
    {
      refuseBands(name, item, list);
    }
    if (*last > bands)
    {
      throw FormatError(name, "band " + std::to_string(*last) + " was asked for",
        "bands from 1 to " + std::to_string(bands), "correct the list of bands");
    }
    std::fill(chosen.begin() + (*first - 1), chosen.begin() + *last, true);
  }
  std::vector<int> result;
  for (int b = 0; b < bands; ++b)
  {
    if (chosen[static_cast<std::size_t>(b)])
    {
      result.push_back(b);
    }
  }
  return result;
}

void keepWavelengths(std::vector<int>& bands, const SpectralImageInfo& info,
  const ImageSelection& selection, const std::string& name)
{
  const double shortest = selection.shortestWavelength;
  const double longest = selection.longestWavelength;
  if (shortest == 0.0 && longest == 0.0)
  {
    return;
  }
  const std::string range = numberText(shortest) + " to " + numberText(longest) + " nm";
  if (!(shortest <= longest))
  {
    throw FormatError(name, "the range of wavelengths is " + range, "the shorter one first");
  }
  if (info.wavelengths.empty())
  {
    throw FormatError(name,
      "bands from " + range + " were asked for, but its wavelengths are not known", "",
      "choose bands by number, or state the wavelengths");
  }
  bands.erase(std::remove_if(bands.begin(), bands.end(),
                [&](int b)
                {
                  const double nm = info.wavelengths[static_cast<std::size_t>(b)];
                  return nm < shortest || nm > longest;
                }),
    bands.end());
  if (bands.empty())
  {
    throw FormatError(name, "no band lies in " + range,
      "a part of " + numberText(info.wavelengths.front()) + " to " +
        numberText(info.wavelengths.back()) + " nm");
  }
}

void keepGood(std::vector<int>& bands, const SpectralImageInfo& info, const std::string& name)
{
  if (info.goodBands.empty())
  {
    return;
  }
  bands.erase(std::remove_if(bands.begin(), bands.end(),
                [&](int b) { return !info.goodBands[static_cast<std::size_t>(b)]; }),
    bands.end());
  if (bands.empty())
  {
    throw FormatError(name, "marks every selected band as bad (bbl)", "at least one good band",
      "read the bad bands too");
  }
}

PixelRegion regionIn(
  const SpectralImageInfo& info, const ImageSelection& selection, const std::string& name)
{
  const PixelRegion& r = selection.region;
  if (r.width() <= 0 && r.height() <= 0)
  {
    return { 0, info.width, 0, info.height };
  }
  if (r.x0 < 0 || r.y0 < 0 || r.x1 > info.width || r.y1 > info.height || r.width() <= 0 ||
    r.height() <= 0)
  {
    throw FormatError(name,
      "the region of columns " + std::to_string(r.x0) + " to " + std::to_string(r.x1 - 1) +
        " and rows " + std::to_string(r.y0) + " to " + std::to_string(r.y1 - 1) + " was asked for",
      "first and last column within 0 to " + std::to_string(info.width - 1) +
        ", first and last row within 0 to " + std::to_string(info.height - 1),
      "correct the region");
  }
  return r;
}

template <typename T>
void choose(std::vector<T>& list, const std::vector<int>& bands)
{
  if (list.empty())
  {
    return;
  }
  std::vector<T> chosen;
  std::transform(bands.begin(), bands.end(), std::back_inserter(chosen),
    [&](int b) { return list[static_cast<std::size_t>(b)]; });
  list = std::move(chosen);
}

class SelectedImage final : public SpectralImageFile
{
public:
  SelectedImage(std::unique_ptr<SpectralImageFile> file, SpectralImageInfo info,
    std::vector<int> bands, const PixelRegion& region, int strideX, int strideY)
    : SpectralImageFile(std::move(info))
    , File(std::move(file))
    , Bands(std::move(bands))
    , Region(region)
    , StrideX(strideX)
    , StrideY(strideY)
  {
  }

private:
  void readChecked(const Block& block, float* pixels) const override { read(block, pixels); }
  void readChecked(const Block& block, double* pixels) const override { read(block, pixels); }

  template <typename Value>
  void read(const Block& block, Value* pixels) const
  {
    std::vector<int> bands;
    for (const int band : block.bands)
    {
      bands.push_back(Bands[static_cast<std::size_t>(band)]);
    }
    PixelRegion region;
    region.x0 = Region.x0 + block.region.x0 * StrideX;
    region.x1 = Region.x0 + (block.region.x1 - 1) * StrideX + 1;
    if (StrideX == 1 && StrideY == 1)
    {
      region.y0 = Region.y0 + block.region.y0;
      region.y1 = Region.y0 + block.region.y1;
      File->readBlock(region, bands, pixels, block.rowStride);
      return;
    }
    std::vector<Value> row(static_cast<std::size_t>(region.width()) * bands.size());
    for (int y = 0; y < block.region.height(); ++y)
    {
      region.y0 = Region.y0 + (block.region.y0 + y) * StrideY;
      region.y1 = region.y0 + 1;
      File->readBlock(region, bands, row.data());
      Value* to = pixels + y * block.rowStride;
      for (std::size_t x = 0; x < static_cast<std::size_t>(block.region.width()); ++x)
      {
        const auto* from = row.data() + x * static_cast<std::size_t>(StrideX) * bands.size();
        to = std::copy_n(from, bands.size(), to);
      }
    }
  }

  std::unique_ptr<SpectralImageFile> File;
  std::vector<int> Bands;
  PixelRegion Region;
  int StrideX;
  int StrideY;
};

SpectralImageInfo infoOfPart(SpectralImageInfo info, const std::vector<int>& bands)
{
  const int all = info.bands();
  choose(info.bandNames, bands);
  choose(info.wavelengths, bands);
  choose(info.fwhm, bands);
  choose(info.goodBands, bands);
  std::vector<int> shown;
  for (const int band : info.displayBands)
  {
    const auto found = std::lower_bound(bands.begin(), bands.end(), band);
    if (found != bands.end() && *found == band)
    {
      shown.push_back(static_cast<int>(found - bands.begin()));
    }
  }
  info.displayBands = shown.size() == info.displayBands.size() ? shown : std::vector<int>();
  if (info.bands() < all)
  {
    info.notes.push_back(
      std::to_string(info.bands()) + " of " + std::to_string(all) + " bands are read");
  }
  return info;
}
}

bool ImageSelection::isEverything() const noexcept
{
  return bands.empty() && shortestWavelength == 0.0 && longestWavelength == 0.0 && !onlyGoodBands &&
    region.width() <= 0 && region.height() <= 0 && strideX == 1 && strideY == 1;
}

std::unique_ptr<SpectralImageFile> selectFrom(
  std::unique_ptr<SpectralImageFile> file, const ImageSelection& selection, const std::string& name)
{
  if (selection.isEverything())
  {
    return file;
  }
  if (selection.strideX < 1 || selection.strideY < 1)
  {
    throw FormatError(name,
      "the stride is " + std::to_string(selection.strideX) + " x " +
        std::to_string(selection.strideY),
      "whole numbers from 1 on");
  }
  const auto& whole = file->info();
  auto bands = bandsIn(selection.bands, whole.bands(), name);
  keepWavelengths(bands, whole, selection, name);
  if (selection.onlyGoodBands)
  {
    keepGood(bands, whole, name);
  }
  const auto region = regionIn(whole, selection, name);
  auto info = infoOfPart(whole, bands);
  info.width = count(region.width(), selection.strideX);
  info.height = count(region.height(), selection.strideY);
  return std::make_unique<SelectedImage>(std::move(file), std::move(info), std::move(bands), region,
    selection.strideX, selection.strideY);
}

} // namespace msi
