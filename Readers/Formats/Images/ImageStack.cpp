#include "Formats/Images/ImageStack.h"

#include "Formats/FormatError.h"
#include "Formats/Images/BandInterleave.h"
#include "Formats/Images/BandSources.h"
#include "Formats/Images/SampleTypes.h"
#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <cstddef>
#include <cstdint>
#include <limits>
#include <type_traits>
#include <utility>

namespace msi
{

namespace
{
// The stored value that becomes 1.
double unitRange(SampleType type)
{
  return withSampleType(type,
    [](auto value)
    {
      using Stored = decltype(value);
      return std::is_integral_v<Stored> ? static_cast<double>(std::numeric_limits<Stored>::max())
                                        : 1.0;
    });
}

// Red, green and blue of a color picture; else none.
std::vector<int> colorBands(const std::vector<std::string>& names)
{
  std::vector<int> bands;
  for (const char* color : { "R", "G", "B" })
  {
    const auto found = std::find(names.begin(), names.end(), color);
    if (found != names.end())
    {
      bands.push_back(static_cast<int>(found - names.begin()));
    }
  }
  return bands.size() == 3 ? bands : std::vector<int>();
}

class ImageStack final : public SpectralImageFile
{
public:
  ImageStack(BandSources sources, IntegerScaling integers)
    : SpectralImageFile(describe(sources, integers))
    , Sources(std::move(sources))
    , Integers(integers)
  {
  }

private:
  static SpectralImageInfo describe(const BandSources& sources, IntegerScaling integers)
  {
    SpectralImageInfo info;
    const OpenedImage& file = *sources.files.front();
    const OIIO::ImageSpec& spec = file.pages()[0];
    info.width = spec.width;
    info.height = spec.height;
    info.quantity = sources.quantity;
    info.notes = sources.notes;
    info.sampleType =
      spec.format == OIIO::TypeDesc::HALF ? "float16" : sampleTypeName(file.sampleType(0));
    const std::string format = file.formatName();
    info.format = format == "openexr" ? "OpenEXR"
      : format == "tiff"              ? "TIFF"
      : format == "png"               ? "PNG"
                                      : format;
    for (const BandSource& band : sources.bands)
    {
      info.bandNames.push_back(band.name);
      if (band.wavelength)
      {
        info.wavelengths.push_back(*band.wavelength);
      }
    }
    info.displayBands = colorBands(info.bandNames);
    for (const auto& attribute : spec.extra_attribs)
    {
      info.metadata.emplace(lowerCase(attribute.name().string()), attribute.get_string());
    }
    const double largest = unitRange(file.sampleType(0));
    if (integers == IntegerScaling::UnitRange && largest != 1.0)
    {
      info.notes.push_back(info.sampleType + " samples were divided by " + numberText(largest));
    }
    return info;
  }

  void readChecked(const Block& block, float* pixels) const override { readBands(block, pixels); }
  void readChecked(const Block& block, double* pixels) const override { readBands(block, pixels); }

  // Bands of one page are read together, the others one after the other; each into a part of
  // 'storage' of its own. All are then interleaved row by row.
  template <typename Target>
  void readBands(const Block& block, Target* pixels) const
  {
    std::vector<std::size_t> positions(block.bands.size());
    for (std::size_t i = 0; i < positions.size(); ++i)
    {
      positions[i] = i;
    }
    // Pages one after the other, so that each is read once.
    const auto page = [&](std::size_t position)
    {
      const BandSource& band = Sources.bands[static_cast<std::size_t>(block.bands[position])];
      return std::pair(band.file, band.page);
    };
    std::stable_sort(positions.begin(), positions.end(),
      [&](std::size_t a, std::size_t b) { return page(a) < page(b); });
    std::vector<Target> planes; // band after band, where a block comes from several pages
    for (std::size_t begin = 0; begin < positions.size();)
    {
      std::size_t end = begin;
      while (end < positions.size() && page(positions[end]) == page(positions[begin]))
      {
        ++end;
      }
      const std::vector<std::size_t> group(positions.begin() + static_cast<std::ptrdiff_t>(begin),
        positions.begin() + static_cast<std::ptrdiff_t>(end));
      if (group.size() == positions.size())
      {
        readPage(block, group, pixels, block.rowStride);
        return;
      }
      const std::size_t planeSize = static_cast<std::size_t>(block.region.width()) *
        static_cast<std::size_t>(block.region.height());
      planes.resize(planeSize * block.bands.size());
      for (const std::size_t position : group)
      {
        readPage(block, { position }, planes.data() + planeSize * position, block.region.width());
      }
      begin = end;
    }
    interleavePlanes(block, planes, pixels);
  }

  // The bands at these positions of the block, dense, all of one page.
  template <typename Target>
  void readPage(const Block& block, const std::vector<std::size_t>& positions, Target* out,
    std::ptrdiff_t rowStride) const
  {
    const auto bandAt = [&](std::size_t position) -> const BandSource&
    { return Sources.bands[static_cast<std::size_t>(block.bands[position])]; };
    const BandSource& first = bandAt(positions.front());
    const OpenedImage& file = *Sources.files[first.file];
    int c0 = first.channel;
    int c1 = c0 + 1;
    for (const std::size_t position : positions)
    {
      c0 = std::min(c0, bandAt(position).channel);
      c1 = std::max(c1, bandAt(position).channel + 1);
    }
    std::vector<unsigned char> bytes;
    file.read(first.page, block.region.y0, block.region.y1, c0, c1, bytes);
    const SampleType type = file.sampleType(first.page);
    SampleConversion conversion;
    conversion.divisor = Integers == IntegerScaling::UnitRange ? unitRange(type) : 1.0;
    const std::size_t size = sampleSize(type);
    const std::size_t pixelBytes = static_cast<std::size_t>(c1 - c0) * size;
    std::vector<BandRow> rows(positions.size());
    for (int y = 0; y < block.region.height(); ++y)
    {
      const unsigned char* row = bytes.data() +
        (static_cast<std::size_t>(y) * static_cast<std::size_t>(Info.width) +
          static_cast<std::size_t>(block.region.x0)) *
          pixelBytes;
      for (std::size_t i = 0; i < positions.size(); ++i)
      {
        rows[i] = { row + static_cast<std::size_t>(bandAt(positions[i]).channel - c0) * size,
          static_cast<std::ptrdiff_t>(pixelBytes) };
      }
      interleaveRow(type, rows, static_cast<std::size_t>(block.region.width()), conversion,
        out + y * rowStride);
    }
  }

  template <typename Target>
  static void interleavePlanes(
    const Block& block, const std::vector<Target>& planes, Target* pixels)
  {
    const auto width = static_cast<std::size_t>(block.region.width());
    const std::size_t planeSize = width * static_cast<std::size_t>(block.region.height());
    const SampleType type =
      std::is_same_v<Target, float> ? SampleType::Float32 : SampleType::Float64;
    std::vector<BandRow> rows(block.bands.size());
    for (int y = 0; y < block.region.height(); ++y)
    {
      for (std::size_t b = 0; b < rows.size(); ++b)
      {
        rows[b] = { reinterpret_cast<const unsigned char*>(
                      planes.data() + b * planeSize + static_cast<std::size_t>(y) * width),
          sizeof(Target) };
      }
      interleaveRow(type, rows, width, SampleConversion{}, pixels + y * block.rowStride);
    }
  }

  BandSources Sources;
  IntegerScaling Integers;
};
}

std::unique_ptr<SpectralImageFile> openImageStack(
  const std::vector<std::string>& files, const SpectralImageOptions& options)
{
  return std::make_unique<ImageStack>(findBands(files, options), options.integers);
}

} // namespace msi
