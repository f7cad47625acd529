#include "Formats/Images/OpenedImage.h"

#include "Formats/FormatError.h"
#include "Formats/Storage/AvailableMemory.h"
#include "Formats/Storage/WholeFile.h"

#include <algorithm>
#include <cstdint>
#include <optional>
#include <utility>

namespace msi
{

namespace
{
constexpr int MostPages = 65536;
constexpr std::int64_t MostPixelsPerSide = 1 << 24;

// Half comes as float.
std::optional<SampleType> sampleTypeOf(const OIIO::TypeDesc& type)
{
  switch (type.basetype)
  {
    case OIIO::TypeDesc::UINT8:
      return SampleType::UInt8;
    case OIIO::TypeDesc::INT8:
      return SampleType::Int8;
    case OIIO::TypeDesc::UINT16:
      return SampleType::UInt16;
    case OIIO::TypeDesc::INT16:
      return SampleType::Int16;
    case OIIO::TypeDesc::UINT32:
      return SampleType::UInt32;
    case OIIO::TypeDesc::INT32:
      return SampleType::Int32;
    case OIIO::TypeDesc::UINT64:
      return SampleType::UInt64;
    case OIIO::TypeDesc::INT64:
      return SampleType::Int64;
    case OIIO::TypeDesc::HALF:
    case OIIO::TypeDesc::FLOAT:
      return SampleType::Float32;
    case OIIO::TypeDesc::DOUBLE:
      return SampleType::Float64;
    default:
      return std::nullopt;
  }
}

std::string pixelsText(const OIIO::ImageSpec& spec)
{
  return std::to_string(spec.width) + " x " + std::to_string(spec.height) + " pixels";
}

// OpenImageIO's texts run over several lines.
std::string oneLine(std::string text)
{
  const std::size_t end = text.find_last_not_of(" \n\r.");
  text.resize(end == std::string::npos ? 0 : end + 1);
  std::replace(text.begin(), text.end(), '\n', ' ');
  return text.empty() ? "no reason is given" : text;
}

// OpenImageIO 2.4 inflates strips of 8 and 16 bit TIFF itself and says nothing when that fails; row by
// row it leaves them to libtiff, which does.
bool mustReadRowByRow(const char* format, const OIIO::ImageSpec& spec)
{
  return std::string(format) == "tiff" && spec.tile_width == 0 &&
    spec.get_string_attribute("compression") == "zip" &&
    spec.get_string_attribute("planarconfig", "contig") == "contig" &&
    (spec.format.basetype == OIIO::TypeDesc::UINT8 ||
      spec.format.basetype == OIIO::TypeDesc::UINT16);
}

// Bytes that the library holds to give any one row: a strip of TIFF, a row of tiles, all of an interlaced PNG.
double decodedAtOnce(const OIIO::ImageSpec& spec)
{
  const int strip = spec.get_int_attribute("tiff:RowsPerStrip", 1);
  const bool interlaced = spec.get_int_attribute("png:interlace", 0) != 0;
  const int rows = interlaced ? spec.height : std::max({ 1, spec.tile_height, strip });
  return static_cast<double>(spec.scanline_bytes(true)) * std::min(rows, spec.height);
}

// The same for tiles, which it inflates itself only where it may use its threads.
void leaveTilesToLibtiff()
{
  static const bool once = OIIO::attribute("tiff:multithread", 0);
  static_cast<void>(once);
}
}

OpenedImage::OpenedImage(std::string path)
  : Path(std::move(path))
  , Stamp(Path)
{
  requireReadableFile(Path);
  leaveTilesToLibtiff();
  OIIO::ImageSpec hints;
  hints.attribute("oiio:UnassociatedAlpha", 1);
  hints.attribute("oiio:RawColor", 1);
  Input = OIIO::ImageInput::open(Path, &hints);
  if (!Input)
  {
    throw FormatError(Path, "cannot be opened as an image (" + oneLine(OIIO::geterror()) + ")",
      "a whole TIFF, PNG, EXR, ENVI, MAT or HDF5 image",
      "check that the file is complete and an image");
  }
  for (int page = 0; page < MostPages; ++page)
  {
    OIIO::ImageSpec spec = Input->spec(page);
    if (spec.undefined())
    {
      break;
    }
    addPage(std::move(spec));
  }
  static_cast<void>(Input->geterror()); // of asking past the last page
  if (Pages.empty())
  {
    throw FormatError(Path, "holds no image", "at least one page", "name another file");
  }
}

void OpenedImage::addPage(OIIO::ImageSpec spec)
{
  const std::string page = "page " + std::to_string(Pages.size() + 1);
  if (spec.width < 1 || spec.height < 1 || spec.nchannels < 1 || spec.depth > 1 ||
    spec.width > MostPixelsPerSide || spec.height > MostPixelsPerSide)
  {
    throw FormatError(Path,
      page + " is " + std::to_string(spec.width) + " x " + std::to_string(spec.height) + " x " +
        std::to_string(spec.depth) + " pixels",
      "a flat image", "check how the file was written");
  }
  const auto type = sampleTypeOf(spec.format);
  if (!type)
  {
    throw FormatError(Path, page + " has samples of type " + spec.format.c_str(),
      "integers or floating point numbers", "convert the file");
  }
  requirePossibleSize(spec, page);
  Pages.push_back(std::move(spec));
  Types.push_back(*type);
}

// A header may ask for any size: samples that are not compressed have to be in the file.
void OpenedImage::requirePossibleSize(const OIIO::ImageSpec& spec, const std::string& page) const
{
  const auto held = static_cast<double>(Stamp.size());
  const bool plain = std::string(formatName()) == "tiff" &&
    spec.get_string_attribute("compression", "none") == "none";
  const double asked = static_cast<double>(spec.image_bytes(true));
  if (plain && held < asked)
  {
    throw FormatError(Path,
      page + " is " + pixelsText(spec) + " of " + memoryText(asked) + ", the file holds " +
        memoryText(held),
      "a complete image", "the file seems to be cut off or damaged; copy it again");
  }
}

void OpenedImage::read(
  int page, int y0, int y1, int c0, int c1, std::vector<unsigned char>& bytes) const
{
  const OIIO::ImageSpec& spec = Pages[static_cast<std::size_t>(page)];
  const OIIO::TypeDesc type =
    spec.format == OIIO::TypeDesc::HALF ? OIIO::TypeDesc(OIIO::TypeDesc::FLOAT) : spec.format;
  const std::size_t pixelBytes = static_cast<std::size_t>(c1 - c0) * type.size();
  const std::size_t rowBytes = static_cast<std::size_t>(spec.width) * pixelBytes;
  int first = y0;
  int last = y1;
  if (spec.tile_width > 0)
  {
    first = y0 / spec.tile_height * spec.tile_height;
    last = std::min((y1 + spec.tile_height - 1) / spec.tile_height * spec.tile_height, spec.height);
  }
  bytes.resize(static_cast<std::size_t>(last - first) * rowBytes);
  requireMemory(decodedAtOnce(spec), Path + ": what of it has to be decoded at once",
    "write it with smaller strips or tiles");
  const int step = mustReadRowByRow(formatName(), spec) ? 1 : last - first;
  bool done = true;
  for (int y = first; done && y < last; y += step)
  {
    unsigned char* const to = bytes.data() + static_cast<std::size_t>(y - first) * rowBytes;
    done = spec.tile_width > 0
      ? Input->read_tiles(page, 0, spec.x, spec.x + spec.width, spec.y + y, spec.y + y + step, 0, 1,
          c0, c1, type, to)
      : Input->read_scanlines(page, 0, spec.y + y, spec.y + y + step, 0, c0, c1, type, to);
    done = done && !Input->has_error(); // it has been seen to return true with an error
  }
  Stamp.requireUnchanged(Path);
  if (!done)
  {
    throw FormatError(Path,
      "rows " + std::to_string(y0 + 1) + " to " + std::to_string(y1) + " cannot be read (" +
        oneLine(Input->geterror()) + ")",
      "a complete image", "the file seems to be cut off or damaged; copy it again");
  }
  if (first != y0 || last != y1)
  {
    const auto begin =
      bytes.begin() + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y0 - first) * rowBytes);
    std::move(begin,
      begin + static_cast<std::ptrdiff_t>(static_cast<std::size_t>(y1 - y0) * rowBytes),
      bytes.begin());
    bytes.resize(static_cast<std::size_t>(y1 - y0) * rowBytes);
  }
}

} // namespace msi
