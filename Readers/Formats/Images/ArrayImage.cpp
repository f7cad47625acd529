#include "Formats/Images/ArrayImage.h"

#include "Formats/Arrays/ArrayWavelengths.h"
#include "Formats/FormatError.h"
#include "Formats/Images/BandInterleave.h"
#include "Formats/Images/BandOrder.h"

#include <algorithm>
#include <cstddef>
#include <limits>
#include <numeric>
#include <optional>
#include <utility>

namespace msi
{

namespace
{
// Axes of the array, slowest first. An axis of length 1 may stand for none.
struct CubeAxes
{
  std::optional<std::size_t> row;
  std::optional<std::size_t> column;
  std::optional<std::size_t> band;
};

std::vector<std::size_t> longAxes(const NamedArray& array)
{
  std::vector<std::size_t> axes;
  for (std::size_t axis = 0; axis < array.shape.size(); ++axis)
  {
    if (array.shape[axis] > 1)
    {
      axes.push_back(axis);
    }
  }
  return axes;
}

// A cube, or one band.
bool mayBeImage(const NamedArray& array)
{
  const std::size_t axes = longAxes(array).size();
  return axes == 2 || axes == 3;
}

// Where several arrays have three axes, that with one as long as the wavelengths.
std::size_t chooseArray(const ArrayFile& file, const std::string& variable, std::size_t wavelengths)
{
  if (!variable.empty())
  {
    const std::size_t index = file.require(variable);
    if (!mayBeImage(file.arrays()[index]))
    {
      throw FormatError(file.path(),
        "'" + variable + "' is " + file.shapeText(file.arrays()[index]),
        "an array of three axes (rows, columns, bands), or two for one band", "name another array");
    }
    return index;
  }
  std::vector<std::size_t> cubes;
  for (std::size_t i = 0; i < file.arrays().size(); ++i)
  {
    if (!file.arrays()[i].isText && longAxes(file.arrays()[i]).size() == 3)
    {
      cubes.push_back(i);
    }
  }
  std::vector<std::size_t> fitting;
  for (const std::size_t i : cubes)
  {
    const auto& shape = file.arrays()[i].shape;
    if (std::count(shape.begin(), shape.end(), static_cast<std::int64_t>(wavelengths)) > 0)
    {
      fitting.push_back(i);
    }
  }
  if (cubes.size() > 1 && wavelengths > 1 && fitting.size() == 1)
  {
    return fitting[0];
  }
  if (cubes.size() != 1)
  {
    throw FormatError(file.path(),
      cubes.empty() ? "holds no array of three axes, only " + file.listing()
                    : "holds several arrays of three axes: " + file.listing(cubes),
      "one array of rows, columns and bands",
      cubes.empty() ? "read it as a sample table, or name a matrix" : "name the one to read");
  }
  return cubes[0];
}

class ArrayImage final : public SpectralImageFile
{
public:
  ArrayImage(std::unique_ptr<ArrayFile> file, std::size_t index, const CubeAxes& axes,
    SpectralImageInfo info, std::vector<int> order)
    : SpectralImageFile(std::move(info))
    , File(std::move(file))
    , Index(index)
    , Axes(axes)
    , Order(std::move(order))
  {
  }

private:
  void readChecked(const Block& block, float* pixels) const override { readPart(block, pixels); }
  void readChecked(const Block& block, double* pixels) const override { readPart(block, pixels); }

  template <typename Target>
  void readPart(const Block& block, Target* pixels) const
  {
    const NamedArray& array = File->arrays()[Index];
    ArrayPart part{ std::vector<std::int64_t>(array.shape.size(), 0),
      std::vector<std::int64_t>(array.shape.size(), 1) };
    const auto restrict = [&part](std::optional<std::size_t> axis, int first, int last)
    {
      if (axis)
      {
        part.start[*axis] = first;
        part.size[*axis] = last - first;
      }
    };
    std::vector<int> bands;
    for (const int band : block.bands)
    {
      bands.push_back(Order[static_cast<std::size_t>(band)]);
    }
    const auto [least, most] = std::minmax_element(bands.begin(), bands.end());
    restrict(Axes.row, block.region.y0, block.region.y1);
    restrict(Axes.column, block.region.x0, block.region.x1);
    restrict(Axes.band, *least, *most + 1);
    std::vector<unsigned char> bytes;
    File->read(Index, part, bytes);

    const auto stride = [&](std::optional<std::size_t> axis)
    {
      auto step = static_cast<std::ptrdiff_t>(sampleSize(array.type));
      for (std::size_t inner = axis ? *axis + 1 : array.shape.size(); inner < array.shape.size();
           ++inner)
      {
        step *= part.size[inner];
      }
      return axis ? step : 0;
    };
    std::vector<BandRow> rows(bands.size());
    for (int y = 0; y < block.region.height(); ++y)
    {
      for (std::size_t b = 0; b < rows.size(); ++b)
      {
        rows[b] = { bytes.data() + y * stride(Axes.row) + (bands[b] - *least) * stride(Axes.band),
          stride(Axes.column) };
      }
      interleaveRow(array.type, rows, static_cast<std::size_t>(block.region.width()),
        SampleConversion{}, pixels + y * block.rowStride);
    }
  }

  std::unique_ptr<ArrayFile> File;
  std::size_t Index;
  CubeAxes Axes;
  std::vector<int> Order; // band of the array for each band
};

class ArrayImageOpener
{
public:
  ArrayImageOpener(std::unique_ptr<ArrayFile> file, const SpectralImageOptions& options)
    : File(std::move(file))
    , Options(options)
    , Wavelengths(
        options.wavelengths.empty() ? findWavelengths(*File, Source) : options.wavelengths)
    , Index(chooseArray(*File, options.variable, Wavelengths.size()))
    , Array(File->arrays()[Index])
  {
  }

  std::unique_ptr<SpectralImageFile> open()
  {
    Info.notes = File->notes();
    chooseAxes();
    Info.width = length(Axes.column);
    Info.height = length(Axes.row);
    Info.format = File->isMatlab() ? "MAT" : "HDF5";
    Info.sampleType = sampleTypeName(Array.type);
    Info.metadata["variable"] = Array.name;
    for (int b = 1; b <= length(Axes.band); ++b)
    {
      Info.bandNames.push_back("Band " + std::to_string(b));
    }
    takeWavelengths();
    std::vector<int> order = sortByWavelength(Info);
    return std::make_unique<ArrayImage>(
      std::move(File), Index, Axes, std::move(Info), std::move(order));
  }

private:
  int length(std::optional<std::size_t> axis) const
  {
    const std::int64_t value = axis ? Array.shape[*axis] : 1;
    if (value > std::numeric_limits<int>::max())
    {
      throw FormatError(File->path(), "'" + Array.name + "' is " + File->shapeText(Array),
        "axes of less than 2^31", "divide the image");
    }
    return static_cast<int>(value);
  }

  void chooseAxes()
  {
    // In the order in which the program that wrote the file counts them.
    std::vector<std::size_t> axes = longAxes(Array);
    if (File->isMatlab())
    {
      std::reverse(axes.begin(), axes.end());
    }
    if (axes.size() == 3)
    {
      const auto band = axes.begin() + spectralAxis(axes);
      Axes.band = *band;
      axes.erase(band);
    }
    Axes.row = axes[0];
    Axes.column = axes[1];
  }

  std::ptrdiff_t spectralAxis(const std::vector<std::size_t>& axes)
  {
    const auto isSpectral = [this](std::size_t axis)
    { return Array.shape[axis] == static_cast<std::int64_t>(Wavelengths.size()); };
    if (!Wavelengths.empty() && std::count_if(axes.begin(), axes.end(), isSpectral) == 1)
    {
      return std::find_if(axes.begin(), axes.end(), isSpectral) - axes.begin();
    }
    const auto shortest = std::min_element(axes.begin(), axes.end(),
      [this](std::size_t a, std::size_t b) { return Array.shape[a] < Array.shape[b]; });
    const std::ptrdiff_t chosen = File->isMatlab() ? 2 : shortest - axes.begin();
    Info.notes.push_back("bands were taken along axis " + std::to_string(chosen + 1) + " of '" +
      Array.name + "', which is " + File->shapeText(Array));
    return chosen;
  }

  void takeWavelengths()
  {
    if (!Options.wavelengths.empty())
    {
      takeGivenWavelengths(Info, Options.wavelengths, File->path());
    }
    else if (static_cast<int>(Wavelengths.size()) == Info.bands())
    {
      Info.wavelengths = Wavelengths;
      Info.notes.push_back("wavelengths are those of '" + Source + "'");
    }
    else if (!Wavelengths.empty())
    {
      Info.notes.push_back("the wavelengths are unknown: '" + Source + "' has " +
        std::to_string(Wavelengths.size()) + " values, the image " + std::to_string(Info.bands()) +
        " bands");
    }
  }

  std::unique_ptr<ArrayFile> File;
  const SpectralImageOptions& Options;
  std::string Source; // of the wavelengths
  std::vector<double> Wavelengths;
  std::size_t Index;
  const NamedArray& Array;
  CubeAxes Axes;
  SpectralImageInfo Info;
};
}

std::unique_ptr<SpectralImageFile> openArrayImage(
  std::unique_ptr<ArrayFile> file, const SpectralImageOptions& options)
{
  return ArrayImageOpener(std::move(file), options).open();
}

std::vector<std::string> imageVariables(const std::string& path)
{
  std::vector<std::string> names;
  const auto file = openArrayFile(path);
  for (const NamedArray& array : file ? file->arrays() : std::vector<NamedArray>{})
  {
    if (!array.isText && mayBeImage(array))
    {
      names.push_back(array.name);
    }
  }
  return names;
}

} // namespace msi
