#include "Files.h"

#include <png.h>
#include <tiffio.h>

#include <cmath>
#include <cstdio>
#include <fstream>
#include <memory>
#include <stdexcept>

namespace msi::scenes
{

namespace
{
[[noreturn]] void fail(const std::filesystem::path& file)
{
  throw std::runtime_error("cannot write " + file.string());
}

std::string formatted(double value, int digits)
{
  char text[64];
  std::snprintf(text, sizeof text, "%.*f", digits, value);
  return text;
}
}

void writeTable(const std::filesystem::path& file, const std::vector<TextColumn>& text,
  const std::vector<NumberColumns>& numbers)
{
  std::ofstream out(file, std::ios::binary);
  std::string header;
  for (const TextColumn& column : text)
  {
    header += (header.empty() ? "" : ",") + column.name;
  }
  for (const NumberColumns& block : numbers)
  {
    for (const std::string& name : block.names)
    {
      header += (header.empty() ? "" : ",") + name;
    }
  }
  out << header << '\n';
  const Eigen::Index rows = numbers.front().values.cols();
  for (Eigen::Index row = 0; row < rows; ++row)
  {
    std::string line;
    for (const TextColumn& column : text)
    {
      line += (line.empty() ? "" : ",") + column.cells[static_cast<std::size_t>(row)];
    }
    for (const NumberColumns& block : numbers)
    {
      for (Eigen::Index i = 0; i < block.values.rows(); ++i)
      {
        line += (line.empty() ? "" : ",") + formatted(block.values(i, row), block.digits);
      }
    }
    out << line << '\n';
  }
  if (!out.flush())
  {
    fail(file);
  }
}

std::vector<std::string> wavelengthNames(const std::string& prefix, const WavelengthGrid& grid)
{
  std::vector<std::string> names;
  for (const double wavelength : grid.values())
  {
    names.push_back(prefix + std::to_string(std::lround(wavelength)));
  }
  return names;
}

void writeTiff(const std::filesystem::path& file, const CountImage& image)
{
  const std::unique_ptr<TIFF, void (*)(TIFF*)> tiff(
    TIFFOpen(file.string().c_str(), "w"), TIFFClose);
  if (!tiff)
  {
    fail(file);
  }
  const auto width = static_cast<std::uint32_t>(image.cols());
  const auto height = static_cast<std::uint32_t>(image.rows());
  TIFFSetField(tiff.get(), TIFFTAG_IMAGEWIDTH, width);
  TIFFSetField(tiff.get(), TIFFTAG_IMAGELENGTH, height);
  TIFFSetField(tiff.get(), TIFFTAG_BITSPERSAMPLE, 16);
  TIFFSetField(tiff.get(), TIFFTAG_SAMPLESPERPIXEL, 1);
  TIFFSetField(tiff.get(), TIFFTAG_PHOTOMETRIC, PHOTOMETRIC_MINISBLACK);
  TIFFSetField(tiff.get(), TIFFTAG_PLANARCONFIG, PLANARCONFIG_CONTIG);
  TIFFSetField(tiff.get(), TIFFTAG_ROWSPERSTRIP, height);
  TIFFSetField(tiff.get(), TIFFTAG_COMPRESSION, COMPRESSION_ADOBE_DEFLATE);
  TIFFSetField(tiff.get(), TIFFTAG_PREDICTOR, PREDICTOR_HORIZONTAL);
  CountImage rows = image; // libtiff takes a buffer that it may change
  for (std::uint32_t y = 0; y < height; ++y)
  {
    if (TIFFWriteScanline(tiff.get(), rows.row(y).data(), y, 0) != 1)
    {
      fail(file);
    }
  }
}

void writePng(const std::filesystem::path& file, const LabelImage& image)
{
  png_image header{};
  header.version = PNG_IMAGE_VERSION;
  header.width = static_cast<png_uint_32>(image.cols());
  header.height = static_cast<png_uint_32>(image.rows());
  header.format = PNG_FORMAT_GRAY;
  if (png_image_write_to_file(&header, file.string().c_str(), 0, image.data(), 0, nullptr) == 0)
  {
    fail(file);
  }
}

} // namespace msi::scenes
