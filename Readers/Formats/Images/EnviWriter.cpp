#include "Formats/SpectralImageWriter.h"

#include "Formats/FormatError.h"
#include "Formats/Images/EnviHeader.h"
#include "Formats/Images/EnviImage.h"
#include "Formats/Images/ImageDescription.h"
#include "Formats/Images/RowCounter.h"
#include "Formats/Images/SampleEncoder.h"
#include "Formats/Storage/AtomicFile.h"

#include <algorithm>
#include <cstddef>
#include <filesystem>
#include <system_error>
#include <utility>
#include <vector>

namespace msi
{

namespace
{
namespace fs = std::filesystem;

class EnviWriter final : public SpectralImageWriter
{
public:
  EnviWriter(const EnviFiles& files, EnviHeader header)
    : Header(std::move(header))
    , HeaderText(enviHeaderText(Header))
    , Data(files.data)
    , HeaderFile(files.header)
    , Rows(Header.info.height)
  {
    Encoding.type = Header.type;
    Encoding.factor = Header.info.reflectanceScale;
    Encoding.ignoreValue = Header.info.ignoreValue;
    Encoding.swapBytes = Header.byteOrder != NativeByteOrder;
  }

  void writeRows(int rows, const float* pixels, std::ptrdiff_t rowStride) override
  {
    write(rows, pixels, rowStride);
  }
  void writeRows(int rows, const double* pixels, std::ptrdiff_t rowStride) override
  {
    write(rows, pixels, rowStride);
  }

  // The old header goes first and the new one comes last, so that at no time a header stands beside
  // data that are not its own.
  void finish() override
  {
    Rows.requireComplete();
    HeaderFile.append(HeaderText);
    HeaderFile.sync();
    Data.sync();
    std::error_code absent;
    fs::remove(HeaderFile.path(), absent);
    Data.commit();
    HeaderFile.commit();
  }

private:
  template <typename Value>
  void write(int rows, const Value* pixels, std::ptrdiff_t rowStride)
  {
    Rows.expect(rows);
    const std::ptrdiff_t stride =
      rowStride == 0 ? static_cast<std::ptrdiff_t>(width() * bands()) : rowStride;
    const std::size_t rowBytes = width() * bands() * size();
    const int rowsAtOnce =
      static_cast<int>(std::clamp<std::size_t>(EnviChunkBytes / rowBytes, 1, 1 << 16));
    for (int y = 0; y < rows; y += rowsAtOnce)
    {
      const int count = std::min(rowsAtOnce, rows - y);
      Buffer.resize(rowBytes * static_cast<std::size_t>(count));
      for (int row = 0; row < count; ++row)
      {
        encodeRow(pixels + (y + row) * stride, row, count);
      }
      store(count);
      Rows.add(count);
    }
  }

  // One row of pixels into its places in the buffer, which holds 'count' rows in the layout of the
  // file; for BSQ band after band.
  template <typename Value>
  void encodeRow(const Value* pixels, int row, int count)
  {
    const auto y = static_cast<std::size_t>(row);
    CurrentRow = Rows.next() + row;
    if (Header.interleave == Interleave::BIP)
    {
      encode(pixels, 1, width() * bands(), Buffer.data() + y * width() * bands() * size());
      return;
    }
    for (std::size_t b = 0; b < bands(); ++b)
    {
      const std::size_t line = Header.interleave == Interleave::BIL
        ? y * bands() + b
        : b * static_cast<std::size_t>(count) + y;
      encode(pixels + b, bands(), width(), Buffer.data() + line * width() * size());
    }
  }

  template <typename Value>
  void encode(const Value* values, std::size_t stride, std::size_t count, unsigned char* samples)
  {
    if (const auto reason = encodeSamples(Encoding, values, static_cast<std::ptrdiff_t>(stride),
          count, samples, static_cast<std::ptrdiff_t>(size())))
    {
      throw FormatError(Data.path(), "row " + std::to_string(CurrentRow + 1) + ": " + *reason,
        "values that fit into the sample type", "choose another type or reflectance scale factor");
    }
  }

  void store(int count)
  {
    const auto first = static_cast<std::size_t>(Rows.next());
    const std::size_t line = width() * size();
    if (Header.interleave != Interleave::BSQ)
    {
      Data.writeAt(first * bands() * line, Buffer.data(), Buffer.size());
      return;
    }
    const std::size_t piece = static_cast<std::size_t>(count) * line;
    const auto height = static_cast<std::size_t>(Header.info.height);
    for (std::size_t b = 0; b < bands(); ++b)
    {
      Data.writeAt((b * height + first) * line, Buffer.data() + b * piece, piece);
    }
  }

  std::size_t width() const { return static_cast<std::size_t>(Header.info.width); }
  std::size_t bands() const { return Header.info.bandNames.size(); }
  std::size_t size() const { return sampleSize(Header.type); }

  EnviHeader Header;
  std::string HeaderText;
  AtomicFile Data;
  AtomicFile HeaderFile;
  RowCounter Rows;
  int CurrentRow = 0;
  SampleEncoding Encoding;
  std::vector<unsigned char> Buffer;
};
}

std::unique_ptr<SpectralImageWriter> createEnviImage(
  const std::string& path, const SpectralImageInfo& info, const EnviWriteOptions& options)
{
  requireConsistent(info);
  EnviHeader header;
  header.info = info;
  header.interleave = options.interleave;
  header.type = options.type;
  header.byteOrder = options.byteOrder;
  return std::make_unique<EnviWriter>(enviFilesToWrite(path), std::move(header));
}

} // namespace msi
