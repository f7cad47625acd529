#include "Formats/Images/EnviImage.h"

#include "Formats/FormatError.h"
#include "Formats/Images/BandInterleave.h"
#include "Formats/Images/BandOrder.h"
#include "Formats/Images/EnviHeader.h"
#include "Formats/Storage/RandomAccessFile.h"
#include "Formats/Storage/WholeFile.h"

#include <algorithm>
#include <cstddef>
#include <utility>

namespace msi
{

namespace
{
class EnviImage final : public SpectralImageFile
{
public:
  EnviImage(EnviHeader header, const std::string& dataFile, std::vector<int> order)
    : SpectralImageFile(std::move(header.info))
    , Data(dataFile)
    , Layout(header.interleave)
    , Type(header.type)
    , Offset(header.headerOffset)
    , Order(std::move(order))
  {
    Conversion.divisor = Info.reflectanceScale;
    Conversion.hasIgnoreValue = Info.ignoreValue.has_value();
    Conversion.ignoreValue = Info.ignoreValue.value_or(0.0);
    Conversion.swapBytes = header.byteOrder != NativeByteOrder;
  }

  const RandomAccessFile& data() const noexcept { return Data; }

private:
  void readChecked(const Block& block, float* pixels) const override { readRows(block, pixels); }
  void readChecked(const Block& block, double* pixels) const override { readRows(block, pixels); }

  // Some rows at a time: from the file into a buffer, from there into the pixels.
  template <typename Target>
  void readRows(const Block& block, Target* pixels) const
  {
    const Span span = spanOf(block);
    const std::size_t rowBytes = span.bands * span.columns * sampleSize(Type);
    const int height = block.region.height();
    const int rowsAtOnce = static_cast<int>(
      std::clamp<std::size_t>(EnviChunkBytes / rowBytes, 1, static_cast<std::size_t>(height)));
    std::vector<unsigned char> buffer(rowBytes * static_cast<std::size_t>(rowsAtOnce));
    std::vector<BandRow> rows(block.bands.size());
    for (int y = 0; y < height; y += rowsAtOnce)
    {
      const int count = std::min(rowsAtOnce, height - y);
      fill(span, block.region.y0 + y, count, buffer.data());
      for (int row = 0; row < count; ++row)
      {
        for (std::size_t b = 0; b < rows.size(); ++b)
        {
          rows[b] = bandRow(span, block, b, row, count, buffer.data());
        }
        interleaveRow(Type, rows, static_cast<std::size_t>(block.region.width()), Conversion,
          pixels + (y + row) * block.rowStride);
      }
    }
  }

  // What is read of each row: [firstColumn, + columns) of [firstBand, + bands), or for BSQ of the bands
  // of the block one by one.
  struct Span
  {
    std::size_t firstBand;
    std::size_t bands;
    std::size_t firstColumn;
    std::size_t columns;
    std::vector<int> fileBands; // of the block
  };

  Span spanOf(const Block& block) const
  {
    Span span{ 0, 0, 0, 0, {} };
    for (const int band : block.bands)
    {
      span.fileBands.push_back(Order[static_cast<std::size_t>(band)]);
    }
    span.firstColumn = static_cast<std::size_t>(block.region.x0);
    span.columns = static_cast<std::size_t>(block.region.width());
    if (Layout == Interleave::BSQ)
    {
      span.bands = span.fileBands.size();
    }
    else
    {
      const auto [least, most] = std::minmax_element(span.fileBands.begin(), span.fileBands.end());
      span.firstBand = static_cast<std::size_t>(*least);
      span.bands = static_cast<std::size_t>(*most - *least) + 1;
      // Between the lines of two bands of BIL lies the rest of the line: read it too.
      if (Layout == Interleave::BIL && span.bands > 1)
      {
        span.firstColumn = 0;
        span.columns = static_cast<std::size_t>(Info.width);
      }
      if (Layout == Interleave::BIP && span.columns > 1)
      {
        span.firstBand = 0;
        span.bands = static_cast<std::size_t>(Info.bands());
      }
    }
    return span;
  }

  void readSamples(std::int64_t first, std::size_t count, unsigned char* to) const
  {
    const std::size_t size = sampleSize(Type);
    Data.read(Offset + first * static_cast<std::int64_t>(size), to, count * size);
  }

  // Rows [y, y + count) into the buffer: for BSQ band after band, else row after row.
  void fill(const Span& span, int y, int count, unsigned char* buffer) const
  {
    const std::int64_t width = Info.width;
    const std::int64_t height = Info.height;
    const std::int64_t bands = Info.bands();
    const std::size_t size = sampleSize(Type);
    const auto rows = static_cast<std::size_t>(count);
    if (Layout == Interleave::BSQ)
    {
      const std::size_t plane = rows * span.columns * size;
      for (std::size_t b = 0; b < span.bands; ++b)
      {
        const std::int64_t first = (span.fileBands[b] * height + y) * width;
        readPieces(first + static_cast<std::int64_t>(span.firstColumn), width, span.columns, rows,
          buffer + b * plane);
      }
      return;
    }
    const std::int64_t pitch = width * bands;
    const std::int64_t within = Layout == Interleave::BIL
      ? static_cast<std::int64_t>(span.firstBand) * width +
        static_cast<std::int64_t>(span.firstColumn)
      : static_cast<std::int64_t>(span.firstColumn) * bands +
        static_cast<std::int64_t>(span.firstBand);
    readPieces(y * pitch + within, pitch, span.bands * span.columns, rows, buffer);
  }

  // 'rows' pieces of 'length' samples, 'pitch' samples apart; at once where they touch.
  void readPieces(std::int64_t first, std::int64_t pitch, std::size_t length, std::size_t rows,
    unsigned char* to) const
  {
    if (pitch == static_cast<std::int64_t>(length))
    {
      readSamples(first, length * rows, to);
      return;
    }
    for (std::size_t row = 0; row < rows; ++row)
    {
      readSamples(first + static_cast<std::int64_t>(row) * pitch, length,
        to + row * length * sampleSize(Type));
    }
  }

  // Where in the buffer band b of the block stands in one of the rows.
  BandRow bandRow(const Span& span, const Block& block, std::size_t b, int row, int count,
    const unsigned char* buffer) const
  {
    const std::size_t size = sampleSize(Type);
    const auto y = static_cast<std::size_t>(row);
    const std::size_t column = static_cast<std::size_t>(block.region.x0) - span.firstColumn;
    if (Layout == Interleave::BSQ)
    {
      const std::size_t line = b * static_cast<std::size_t>(count) + y;
      return { buffer + line * span.columns * size, static_cast<std::ptrdiff_t>(size) };
    }
    const std::size_t band = static_cast<std::size_t>(span.fileBands[b]) - span.firstBand;
    const unsigned char* start = buffer + y * span.bands * span.columns * size;
    if (Layout == Interleave::BIL)
    {
      return { start + (band * span.columns + column) * size, static_cast<std::ptrdiff_t>(size) };
    }
    return { start + (column * span.bands + band) * size,
      static_cast<std::ptrdiff_t>(span.bands * size) };
  }

  RandomAccessFile Data;
  Interleave Layout;
  SampleType Type;
  std::int64_t Offset;
  std::vector<int> Order; // band of the file for each band
  SampleConversion Conversion;
};

// Both sizes and how the expected one comes about.
std::string sizeText(const EnviHeader& header)
{
  return std::to_string(header.expectedFileSize()) + " bytes (header offset " +
    std::to_string(header.headerOffset) + " + " + std::to_string(header.info.width) +
    " samples x " + std::to_string(header.info.height) + " lines x " +
    std::to_string(header.info.bands()) + " bands x " + std::to_string(sampleSize(header.type)) +
    " bytes)";
}

void checkSize(EnviHeader& header, const EnviFiles& files)
{
  const std::int64_t size = RandomAccessFile(files.data).size();
  if (size < header.expectedFileSize())
  {
    throw FormatError(files.data, "holds " + std::to_string(size) + " bytes",
      sizeText(header) + ", as " + files.header + " says",
      "the file seems to be cut off, or the header belongs to another file");
  }
  if (size > header.expectedFileSize())
  {
    header.info.notes.push_back("the data file holds " + std::to_string(size) +
      " bytes, the header asks for " + sizeText(header) + ": the rest was left unread");
  }
}
}

std::unique_ptr<SpectralImageFile> openEnviImage(
  const EnviFiles& files, const SpectralImageOptions& options)
{
  EnviHeaderOptions headerOptions;
  headerOptions.ownWavelengths = options.wavelengths.empty();
  headerOptions.classification = options.labels;
  EnviHeader header =
    parseEnviHeader(files.header, readTextFile(files.header, "an ENVI header"), headerOptions);
  checkSize(header, files);
  header.info.format = "ENVI";
  takeGivenWavelengths(header.info, options.wavelengths, files.header);
  std::vector<int> order = sortByWavelength(header.info);
  return std::make_unique<EnviImage>(std::move(header), files.data, std::move(order));
}

std::unique_ptr<SpectralImageFile> openEnviLibrary(const EnviFiles& files)
{
  EnviHeaderOptions headerOptions;
  headerOptions.library = true;
  EnviHeader header =
    parseEnviHeader(files.header, readTextFile(files.header, "an ENVI header"), headerOptions);
  checkSize(header, files);
  header.info.format = "ENVI Spectral Library";
  std::vector<int> order = sortByWavelength(header.info);
  return std::make_unique<EnviImage>(std::move(header), files.data, std::move(order));
}

} // namespace msi
