#include "Formats/Arrays/ArrayFile.h"

#include "Formats/FormatError.h"
#include "Formats/Images/BandInterleave.h"
#include "Formats/Storage/WholeFile.h"

#include <algorithm>
#include <numeric>
#include <utility>

namespace msi
{

namespace
{
constexpr std::string_view Hdf5Signature = "\x89HDF\r\n\x1A\n";
constexpr std::size_t MostListed = 8;
}

std::int64_t NamedArray::count() const noexcept
{
  std::int64_t product = 1;
  for (const std::int64_t length : shape)
  {
    product *= length;
  }
  return product;
}

ArrayFile::ArrayFile(std::string path)
  : Path(std::move(path))
{
}

std::vector<double> ArrayFile::readAll(std::size_t array) const
{
  const NamedArray& wanted = Arrays[array];
  std::vector<unsigned char> bytes;
  read(array, { std::vector<std::int64_t>(wanted.shape.size(), 0), wanted.shape }, bytes);
  std::vector<double> values(static_cast<std::size_t>(wanted.count()));
  const auto size = static_cast<std::ptrdiff_t>(sampleSize(wanted.type));
  interleaveRow(
    wanted.type, { { bytes.data(), size } }, values.size(), SampleConversion{}, values.data());
  return values;
}

std::size_t ArrayFile::require(const std::string& name) const
{
  const auto found = std::find_if(Arrays.begin(), Arrays.end(),
    [&name](const NamedArray& array) { return array.name == name || array.name == "/" + name; });
  if (found == Arrays.end())
  {
    throw FormatError(
      Path, "has no array '" + name + "'", "one of " + listing(), "name one of them");
  }
  return static_cast<std::size_t>(found - Arrays.begin());
}

std::string ArrayFile::shapeText(const NamedArray& array) const
{
  auto shape = array.shape;
  if (Matlab)
  {
    std::reverse(shape.begin(), shape.end());
  }
  std::string text;
  for (std::size_t i = 0; i < shape.size(); ++i)
  {
    text += (i > 0 ? " x " : "") + std::to_string(shape[i]);
  }
  return text;
}

std::string ArrayFile::listing(const std::vector<std::size_t>& which) const
{
  std::string text;
  for (std::size_t i = 0; i < std::min(which.size(), MostListed); ++i)
  {
    const NamedArray& array = Arrays[which[i]];
    text += (i > 0 ? ", " : "") + array.name + " (" + shapeText(array) + ")";
  }
  return text + (which.size() > MostListed ? ", ..." : "");
}

std::string ArrayFile::listing() const
{
  std::vector<std::size_t> all(Arrays.size());
  std::iota(all.begin(), all.end(), 0);
  return listing(all);
}

bool looksLikeMat5(std::string_view beginning) noexcept
{
  return beginning.substr(0, 10) == "MATLAB 5.0";
}

bool looksLikeHdf5(std::string_view beginning) noexcept
{
  for (std::size_t at = 0; at < beginning.size(); at = at == 0 ? 512 : 2 * at)
  {
    if (beginning.substr(at, Hdf5Signature.size()) == Hdf5Signature)
    {
      return true;
    }
  }
  return false;
}

std::unique_ptr<ArrayFile> openArrayFile(const std::string& path)
{
  const std::string beginning = readFileBeginning(path, ArrayFileBeginning);
  if (looksLikeHdf5(beginning))
  {
    return openHdf5File(path);
  }
  if (looksLikeMat5(beginning))
  {
    return openMat5File(path);
  }
  return looksLikeMat4(beginning) ? openMat4File(path) : nullptr;
}

} // namespace msi
