#include "Formats/SpectralImageWriter.h"

#include "Formats/FormatError.h"
#include "Formats/Images/ImageDescription.h"
#include "Formats/Images/RowCounter.h"
#include "Formats/Images/SpectralExrName.h"
#include "Formats/Storage/AtomicFile.h"

#include <OpenImageIO/imageio.h>

#include <algorithm>
#include <cstdio>
#include <stdexcept>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
OIIO::ImageSpec specFor(const SpectralImageInfo& info)
{
  const bool emission = info.quantity == "emission";
  OIIO::ImageSpec spec(info.width, info.height, info.bands(), OIIO::TypeDesc::FLOAT);
  spec.alpha_channel = -1;
  spec.z_channel = -1;
  spec.channelnames.clear();
  for (const double nm : info.wavelengths)
  {
    spec.channelnames.push_back(spectralExrName(emission ? 'S' : 'T', nm));
  }
  spec.attribute("DateTime", ""); // the same image gives the same bytes at any time
  spec.attribute("compression", "zip");
  spec.attribute("spectralLayoutVersion", "1.0");
  if (info.quantity == "responses")
  {
    spec.attribute(QuantityAttribute, info.quantity);
  }
  if (emission)
  {
    spec.attribute("emissiveUnits", "W.m^-2.sr^-1");
  }
  return spec;
}

// OpenEXR compresses blocks of 16 rows, each in a thread.
constexpr int RowsAtOnce = 32;

class SpectralExrWriter final : public SpectralImageWriter
{
public:
  SpectralExrWriter(std::string path, const SpectralImageInfo& info)
    : Path(std::move(path))
    , Temporary(temporaryNameBeside(Path))
    , RowSize(static_cast<std::size_t>(info.width) * info.bandNames.size())
    , Rows(info.height)
    , Out(OIIO::ImageOutput::create("exr"))
  {
    if (!Out)
    {
      fail(OIIO::geterror());
    }
    if (!Out->open(Temporary, specFor(info)))
    {
      const std::string reason = Out->geterror();
      std::remove(Temporary.c_str());
      fail(reason);
    }
  }

  ~SpectralExrWriter() override
  {
    Out->close();
    if (!Temporary.empty())
    {
      std::remove(Temporary.c_str());
    }
  }

  void writeRows(int rows, const float* pixels, std::ptrdiff_t rowStride) override
  {
    write(rows, pixels, rowStride);
  }
  void writeRows(int rows, const double* pixels, std::ptrdiff_t rowStride) override
  {
    write(rows, pixels, rowStride);
  }

  void finish() override
  {
    Rows.requireComplete();
    if (!Out->close())
    {
      fail(Out->geterror());
    }
    commitFile(Temporary, Path);
    Temporary.clear();
  }

private:
  template <typename Value>
  void write(int rows, const Value* pixels, std::ptrdiff_t rowStride)
  {
    Rows.expect(rows);
    const std::ptrdiff_t stride = rowStride == 0 ? static_cast<std::ptrdiff_t>(RowSize) : rowStride;
    for (int row = 0; row < rows; row += RowsAtOnce)
    {
      const int count = std::min(RowsAtOnce, rows - row);
      Values.resize(RowSize * static_cast<std::size_t>(count));
      for (int i = 0; i < count; ++i)
      {
        const Value* from = pixels + (row + i) * stride;
        std::transform(from, from + RowSize,
          Values.begin() + i * static_cast<std::ptrdiff_t>(RowSize),
          [](Value value) { return static_cast<float>(value); });
      }
      const int y = Rows.next();
      if (!Out->write_scanlines(y, y + count, 0, OIIO::TypeDesc::FLOAT, Values.data()))
      {
        fail(Out->geterror());
      }
      Rows.add(count);
    }
  }

  [[noreturn]] void fail(std::string reason) const
  {
    std::replace(reason.begin(), reason.end(), '\n', ' ');
    throw FormatError(Path, "cannot be written (" + reason + ")",
      "a writable folder with room in it",
      "check the folder, its access rights and the free space");
  }

  std::string Path;
  std::string Temporary;
  std::size_t RowSize;
  std::vector<float> Values; // of up to RowsAtOnce rows
  RowCounter Rows;
  std::unique_ptr<OIIO::ImageOutput> Out;
};
}

std::unique_ptr<SpectralImageWriter> createSpectralExr(
  const std::string& path, const SpectralImageInfo& info)
{
  requireConsistent(info);
  if (info.wavelengths.empty())
  {
    throw std::invalid_argument(
      "spectral OpenEXR names its channels by wavelength; expected a wavelength for each band");
  }
  auto sorted = info.wavelengths;
  std::sort(sorted.begin(), sorted.end());
  if (std::adjacent_find(sorted.begin(), sorted.end()) != sorted.end())
  {
    throw std::invalid_argument(
      "two bands have the same wavelength; expected one band for each wavelength");
  }
  return std::make_unique<SpectralExrWriter>(path, info);
}

} // namespace msi
