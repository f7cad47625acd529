#include "Formats/Arrays/ArrayFile.h"

#include "Formats/FormatError.h"
#include "Formats/Storage/FileStamp.h"
#include "Formats/Storage/WholeFile.h"

#include <algorithm>
#include <array>
#include <mutex>
#include <new>
#include <optional>
#include <utility>

#define H5_USE_110_API
#include <hdf5.h>

namespace msi
{

namespace
{
constexpr hsize_t MostElements = hsize_t{ 1 } << 48;

// Debian's HDF5 is not built for threads.
std::mutex& hdf5Mutex()
{
  static std::mutex mutex;
  return mutex;
}

// An identifier of HDF5 and the call that closes it.
class Handle
{
public:
  Handle(hid_t id, herr_t (*closeIt)(hid_t)) noexcept
    : Id(id)
    , Close(closeIt)
  {
  }
  ~Handle() { close(); }
  Handle(const Handle&) = delete;
  Handle& operator=(const Handle&) = delete;
  operator hid_t() const noexcept { return Id; }
  bool ok() const noexcept { return Id >= 0; }
  void close() noexcept
  {
    if (Id >= 0)
    {
      Close(Id);
      Id = -1;
    }
  }

private:
  hid_t Id;
  herr_t (*Close)(hid_t);
};

// HDF5 prints its errors unless told not to.
class SilentErrors
{
public:
  SilentErrors()
  {
    H5Eget_auto2(H5E_DEFAULT, &Function, &Data);
    H5Eset_auto2(H5E_DEFAULT, nullptr, nullptr);
  }
  ~SilentErrors() { H5Eset_auto2(H5E_DEFAULT, Function, Data); }
  SilentErrors(const SilentErrors&) = delete;
  SilentErrors& operator=(const SilentErrors&) = delete;

private:
  H5E_auto2_t Function = nullptr;
  void* Data = nullptr;
};

std::optional<SampleType> sampleTypeOf(hid_t type)
{
  const std::size_t size = H5Tget_size(type);
  if (H5Tget_class(type) == H5T_FLOAT)
  {
    return size <= sizeof(float) ? SampleType::Float32 : SampleType::Float64;
  }
  if (H5Tget_class(type) != H5T_INTEGER)
  {
    return std::nullopt;
  }
  const bool isSigned = H5Tget_sign(type) == H5T_SGN_2;
  switch (size)
  {
    case 1:
      return isSigned ? SampleType::Int8 : SampleType::UInt8;
    case 2:
      return isSigned ? SampleType::Int16 : SampleType::UInt16;
    case 4:
      return isSigned ? SampleType::Int32 : SampleType::UInt32;
    case 8:
      return isSigned ? SampleType::Int64 : SampleType::UInt64;
    default:
      return std::nullopt;
  }
}

hid_t memoryType(SampleType type)
{
  switch (type)
  {
    case SampleType::UInt8:
      return H5T_NATIVE_UINT8;
    case SampleType::Int8:
      return H5T_NATIVE_INT8;
    case SampleType::Int16:
      return H5T_NATIVE_INT16;
    case SampleType::UInt16:
      return H5T_NATIVE_UINT16;
    case SampleType::Int32:
      return H5T_NATIVE_INT32;
    case SampleType::UInt32:
      return H5T_NATIVE_UINT32;
    case SampleType::Int64:
      return H5T_NATIVE_INT64;
    case SampleType::UInt64:
      return H5T_NATIVE_UINT64;
    case SampleType::Float32:
      return H5T_NATIVE_FLOAT;
    case SampleType::Float64:
      break;
  }
  return H5T_NATIVE_DOUBLE;
}

// The text attribute MATLAB_class, or an empty text.
std::string matlabClass(hid_t dataset)
{
  if (H5Aexists(dataset, "MATLAB_class") <= 0)
  {
    return {};
  }
  const Handle attribute(H5Aopen(dataset, "MATLAB_class", H5P_DEFAULT), H5Aclose);
  const Handle type(H5Aget_type(attribute), H5Tclose);
  if (!attribute.ok() || H5Tget_class(type) != H5T_STRING || H5Tis_variable_str(type) > 0)
  {
    return {};
  }
  constexpr std::size_t longest = 64;
  std::string text(std::min(H5Tget_size(type), longest), '\0');
  if (text.size() < H5Tget_size(type) || H5Aread(attribute, type, text.data()) < 0)
  {
    return {};
  }
  return text.substr(0, text.find('\0'));
}

class Hdf5File final : public ArrayFile
{
public:
  explicit Hdf5File(const std::string& path)
    : ArrayFile(path)
    , File(H5Fopen(path.c_str(), H5F_ACC_RDONLY, H5P_DEFAULT), H5Fclose)
  {
    if (!File.ok())
    {
      throw FormatError(path, "cannot be opened as an HDF5 file", "a complete HDF5 or MAT 7.3 file",
        "the file seems to be cut off or damaged");
    }
    Stamp.emplace(descriptor());
    std::vector<std::string> names;
    H5Ovisit(File, H5_INDEX_NAME, H5_ITER_INC, &Hdf5File::onObject, &names);
    for (const std::string& name : names)
    {
      const Handle dataset(H5Dopen2(File, name.c_str(), H5P_DEFAULT), H5Dclose);
      if (dataset.ok())
      {
        add(dataset, name);
        addAttributes(dataset, name + ".");
      }
    }
    const Handle root(H5Gopen2(File, "/", H5P_DEFAULT), H5Gclose);
    addAttributes(root, "");
    if (Arrays.empty())
    {
      throw FormatError(path, "holds no array of real numbers",
        "an HDF5 or MAT 7.3 file with matrices", "name another file");
    }
  }

  ~Hdf5File() override
  {
    const std::lock_guard<std::mutex> lock(hdf5Mutex());
    File.close();
  }

  void read(
    std::size_t index, const ArrayPart& part, std::vector<unsigned char>& bytes) const override
  {
    const std::lock_guard<std::mutex> lock(hdf5Mutex());
    const SilentErrors silent;
    const NamedArray& array = Arrays[index];
    const std::vector<hsize_t> start(part.start.begin(), part.start.end());
    const std::vector<hsize_t> size(part.size.begin(), part.size.end());
    hsize_t count = 1;
    for (const hsize_t length : size)
    {
      count *= length;
    }
    bytes.resize(static_cast<std::size_t>(count) * sampleSize(array.type));
    const Handle dataset(H5Dopen2(File, array.name.c_str(), H5P_DEFAULT), H5Dclose);
    const Handle fileSpace(H5Dget_space(dataset), H5Sclose);
    const Handle memorySpace(
      H5Screate_simple(static_cast<int>(size.size()), size.data(), nullptr), H5Sclose);
    const bool done = H5Sselect_hyperslab(fileSpace, H5S_SELECT_SET, start.data(), nullptr,
                        size.data(), nullptr) >= 0 &&
      H5Dread(dataset, memoryType(array.type), memorySpace, fileSpace, H5P_DEFAULT, bytes.data()) >=
        0;
    if (!done)
    {
      requireFilters(dataset, array.name);
      throw FormatError(Path, "dataset '" + array.name + "' cannot be read",
        "a complete HDF5 or MAT 7.3 file", "the file seems to be cut off or damaged");
    }
    // What lies behind the end of a file the library reads as zeros.
    Stamp->requireUnchanged(descriptor(), Path);
  }

private:
  // Of the one file that the default driver has open.
  int descriptor() const
  {
    void* handle = nullptr;
    return H5Fget_vfd_handle(File, H5P_DEFAULT, &handle) >= 0 && handle != nullptr
      ? *static_cast<const int*>(handle)
      : -1;
  }

  // Compression comes as plugins, which this library may lack.
  void requireFilters(hid_t dataset, const std::string& name) const
  {
    const Handle properties(H5Dget_create_plist(dataset), H5Pclose);
    const int count = H5Pget_nfilters(properties);
    for (int i = 0; i < count; ++i)
    {
      std::array<char, 64> text{};
      unsigned flags = 0;
      unsigned configuration = 0;
      std::size_t values = 0;
      const H5Z_filter_t filter = H5Pget_filter2(properties, static_cast<unsigned>(i), &flags,
        &values, nullptr, text.size() - 1, text.data(), &configuration);
      if (H5Zfilter_avail(filter) <= 0)
      {
        throw FormatError(Path,
          "dataset '" + name + "' is compressed by the filter " + std::to_string(filter) + " (" +
            text.data() + "), which this HDF5 library does not have",
          "none, or gzip", "write the file anew: h5repack -f GZIP=4");
      }
    }
  }

  // Attributes that are vectors of numbers; others are passed over.
  void addAttributes(hid_t object, const std::string& prefix)
  {
    constexpr hssize_t most = 1 << 16;
    const int count = H5Aget_num_attrs(object);
    for (int i = 0; i < count; ++i)
    {
      const Handle attribute(H5Aopen_by_idx(object, ".", H5_INDEX_NAME, H5_ITER_INC,
                               static_cast<hsize_t>(i), H5P_DEFAULT, H5P_DEFAULT),
        H5Aclose);
      const Handle type(H5Aget_type(attribute), H5Tclose);
      const Handle space(H5Aget_space(attribute), H5Sclose);
      const hssize_t length = H5Sget_simple_extent_npoints(space);
      std::array<char, 256> name{};
      if (!type.ok() || !sampleTypeOf(type) || H5Sget_simple_extent_ndims(space) != 1 ||
        length < 2 || length > most || H5Aget_name(attribute, name.size(), name.data()) < 0)
      {
        continue;
      }
      std::vector<double> values(static_cast<std::size_t>(length));
      if (H5Aread(attribute, H5T_NATIVE_DOUBLE, values.data()) >= 0)
      {
        Attributes.emplace_back(prefix + name.data(), std::move(values));
      }
    }
  }

  // Only collects names: no exception may pass through the library.
  static herr_t onObject(hid_t, const char* name, const H5O_info_t* info, void* names) noexcept
  {
    try
    {
      if (info->type == H5O_TYPE_DATASET)
      {
        static_cast<std::vector<std::string>*>(names)->emplace_back(name);
      }
    }
    catch (const std::bad_alloc&)
    {
      return -1;
    }
    return 0;
  }

  void add(hid_t dataset, const std::string& name)
  {
    const Handle type(H5Dget_type(dataset), H5Tclose);
    const Handle space(H5Dget_space(dataset), H5Sclose);
    const auto sampleType = type.ok() ? sampleTypeOf(type) : std::nullopt;
    const std::string matlab = matlabClass(dataset);
    Matlab = Matlab || !matlab.empty();
    // "#refs#" holds what cells and structures of MATLAB refer to.
    if (!sampleType || !space.ok() || H5Sget_simple_extent_type(space) != H5S_SIMPLE ||
      name.front() == '#')
    {
      return;
    }
    std::vector<hsize_t> shape(
      static_cast<std::size_t>(std::max(H5Sget_simple_extent_ndims(space), 0)));
    H5Sget_simple_extent_dims(space, shape.data(), nullptr);
    hsize_t count = 1;
    for (const hsize_t length : shape)
    {
      if (length == 0 || length > MostElements || count > MostElements / length)
      {
        return;
      }
      count *= length;
    }
    if (!shape.empty())
    {
      Arrays.push_back({ name, { shape.begin(), shape.end() }, *sampleType, matlab == "char" });
    }
  }

  Handle File;
  std::optional<FileStamp> Stamp;
};
}

std::unique_ptr<ArrayFile> openHdf5File(const std::string& path)
{
  requireReadableFile(path);
  const std::lock_guard<std::mutex> lock(hdf5Mutex());
  const SilentErrors silent;
  return std::make_unique<Hdf5File>(path);
}

} // namespace msi
