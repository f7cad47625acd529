#include "Formats/Arrays/MatFile.h"

#include "Formats/FormatError.h"

#include <algorithm>
#include <cstring>
#include <utility>

#include <zlib.h>

namespace msi
{

namespace
{
// Calls copyRun(from, to, count) for each run of elements that is contiguous in the whole array; both
// places in elements.
template <typename CopyRun>
void forEachRun(const std::vector<std::int64_t>& shape, const ArrayPart& part, std::size_t axis,
  std::int64_t from, std::int64_t to, const CopyRun& copyRun)
{
  std::int64_t fromStep = 1;
  std::int64_t toStep = 1;
  bool whole = true; // all inner axes are taken whole
  for (std::size_t inner = axis + 1; inner < shape.size(); ++inner)
  {
    fromStep *= shape[inner];
    toStep *= part.size[inner];
    whole = whole && part.size[inner] == shape[inner];
  }
  from += part.start[axis] * fromStep;
  if (whole)
  {
    copyRun(from, to, part.size[axis] * fromStep);
    return;
  }
  for (std::int64_t i = 0; i < part.size[axis]; ++i)
  {
    forEachRun(shape, part, axis + 1, from + i * fromStep, to + i * toStep, copyRun);
  }
}

void swapSamples(std::vector<unsigned char>& bytes, std::size_t size)
{
  for (std::size_t at = 0; size > 1 && at + size <= bytes.size(); at += size)
  {
    std::reverse(bytes.begin() + static_cast<std::ptrdiff_t>(at),
      bytes.begin() + static_cast<std::ptrdiff_t>(at + size));
  }
}
}

bool inflateBytes(
  const std::vector<unsigned char>& stream, std::size_t most, std::vector<unsigned char>& bytes)
{
  constexpr std::size_t step = 1 << 20;
  z_stream state = {};
  if (inflateInit(&state) != Z_OK)
  {
    return false;
  }
  state.next_in = const_cast<Bytef*>(stream.data());
  state.avail_in = static_cast<uInt>(stream.size());
  bytes.clear();
  int status = Z_OK;
  while (status == Z_OK && bytes.size() < most)
  {
    const std::size_t done = bytes.size();
    bytes.resize(std::min(most, done + step));
    state.next_out = bytes.data() + done;
    state.avail_out = static_cast<uInt>(bytes.size() - done);
    status = inflate(&state, Z_NO_FLUSH);
    bytes.resize(bytes.size() - state.avail_out);
    if (bytes.size() == done && status == Z_OK)
    {
      break;
    }
  }
  inflateEnd(&state);
  return status == Z_STREAM_END || (status == Z_OK && bytes.size() == most);
}

MatFile::MatFile(const std::string& path)
  : ArrayFile(path)
  , File(path)
{
  Matlab = true;
}

void MatFile::failAt(std::int64_t offset, const std::string& what) const
{
  throw FormatError(Path, what + " at offset " + std::to_string(offset), "a complete MAT file",
    "the file seems to be cut off or damaged; copy it again");
}

void MatFile::requireInside(std::int64_t offset, std::int64_t size) const
{
  if (size < 0 || offset < 0 || offset > File.size() || size > File.size() - offset)
  {
    throw FormatError(Path,
      "holds " + std::to_string(File.size()) + " bytes, and the element at offset " +
        std::to_string(offset) + " asks for " + std::to_string(size),
      "a complete MAT file", "the file seems to be cut off or damaged; copy it again");
  }
}

void MatFile::add(NamedArray array, const MatData& data)
{
  Arrays.push_back(std::move(array));
  Data.push_back(data);
}

void MatFile::noteLeftOut()
{
  if (LeftOut > 0)
  {
    Notes.push_back(std::to_string(LeftOut) +
      " variables were left out: cells, arrays of structures, sparse, complex or empty arrays");
  }
  if (Arrays.empty())
  {
    throw FormatError(Path, "holds no array of real numbers",
      "a MAT file with matrices, or structures of them", "save the matrices by themselves");
  }
}

const std::vector<unsigned char>& MatFile::inflated(std::size_t array) const
{
  const std::lock_guard<std::mutex> lock(Mutex);
  const MatData& data = Data[array];
  std::vector<unsigned char>& bytes = Inflated[data.elementOffset];
  if (bytes.empty())
  {
    std::vector<unsigned char> stream(static_cast<std::size_t>(data.elementSize));
    File.read(data.elementOffset, stream.data(), stream.size());
    std::size_t needed = 0;
    for (std::size_t i = 0; i < Data.size(); ++i)
    {
      if (Data[i].compressed && Data[i].elementOffset == data.elementOffset)
      {
        needed = std::max(needed,
          static_cast<std::size_t>(Data[i].offset) +
            static_cast<std::size_t>(Arrays[i].count()) * sampleSize(Arrays[i].type));
      }
    }
    std::vector<unsigned char> whole;
    // One more byte than needed makes zlib compare its checksum at the end of the stream.
    if (!inflateBytes(stream, needed + 8, whole) || whole.size() < needed)
    {
      failAt(data.elementOffset, "variable '" + Arrays[array].name + "' cannot be inflated");
    }
    bytes = std::move(whole);
  }
  return bytes;
}

void MatFile::read(
  std::size_t array, const ArrayPart& part, std::vector<unsigned char>& bytes) const
{
  const NamedArray& whole = Arrays[array];
  const MatData& data = Data[array];
  const std::size_t size = sampleSize(whole.type);
  std::int64_t count = 1;
  for (const std::int64_t length : part.size)
  {
    count *= length;
  }
  bytes.resize(static_cast<std::size_t>(count) * size);
  const unsigned char* kept = data.compressed ? inflated(array).data() + data.offset : nullptr;
  forEachRun(whole.shape, part, 0, 0, 0,
    [&](std::int64_t from, std::int64_t to, std::int64_t run)
    {
      unsigned char* const target = bytes.data() + static_cast<std::size_t>(to) * size;
      const std::int64_t offset = from * static_cast<std::int64_t>(size);
      if (kept != nullptr)
      {
        std::memcpy(target, kept + offset, static_cast<std::size_t>(run) * size);
      }
      else
      {
        File.read(data.offset + offset, target, static_cast<std::size_t>(run) * size);
      }
    });
  if (SwapBytes)
  {
    swapSamples(bytes, size);
  }
}

} // namespace msi
