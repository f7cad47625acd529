#include "Formats/FileKind.h"

#include "Formats/Arrays/ArrayFile.h"
#include "Formats/CameraDescription.h"
#include "Formats/Curves.h"
#include "Formats/FormatError.h"
#include "Formats/Images/ArrayImage.h"
#include "Formats/SampleTable.h"
#include "Formats/SpectralImageFile.h"
#include "Formats/Storage/WholeFile.h"
#include "Formats/Tables/CgatsTable.h"
#include "Formats/Tables/CurveColumns.h"
#include "Formats/Tables/CxfTable.h"
#include "Formats/Tables/SampleColumns.h"
#include "Formats/Text/DelimitedText.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <exception>
#include <filesystem>
#include <memory>
#include <vector>

namespace msi
{

namespace
{
namespace fs = std::filesystem;

constexpr std::size_t TableBeginning = std::size_t{ 256 } * 1024;

bool isCaptureFolder(const fs::path& folder)
{
  const auto has = [&](const char* name) { return fs::is_regular_file(folder / name); };
  return has("capture.json") && has("camera.csv") && has("samples.csv") && has("responses.csv");
}

FileKind kindOfJson(const fs::path& path)
{
  if (path.filename() == "capture.json" && isCaptureFolder(path.parent_path()))
  {
    return FileKind::Capture;
  }
  readCameraDescription(path.string());
  return FileKind::Camera;
}

// Whether neighbours in a row are nearly always equal, values are whole and there is more than one.
bool looksLikeLabels(const SpectralImageFile& file)
{
  constexpr int Rows = 64;
  constexpr double MostLabels = 100000.0;
  constexpr double LeastEqual = 0.9;
  const auto& info = file.info();
  const int rows = std::min(info.height, Rows);
  std::vector<double> row(static_cast<std::size_t>(info.width));
  double smallest = MostLabels;
  double largest = 0.0;
  std::ptrdiff_t equal = 0;
  std::ptrdiff_t pairs = 0;
  for (int i = 0; i < rows; ++i)
  {
    const int y = static_cast<int>((2LL * i + 1) * info.height / (2LL * rows));
    file.readBlock({ 0, info.width, y, y + 1 }, {}, row.data());
    for (std::size_t x = 0; x < row.size(); ++x)
    {
      if (!(row[x] >= 0.0 && row[x] <= MostLabels && row[x] == std::floor(row[x])))
      {
        return false;
      }
      smallest = std::min(smallest, row[x]);
      largest = std::max(largest, row[x]);
      equal += x > 0 && row[x] == row[x - 1] ? 1 : 0;
      pairs += x > 0 ? 1 : 0;
    }
  }
  return largest > smallest &&
    static_cast<double>(equal) >= LeastEqual * static_cast<double>(pairs);
}

FileKind kindOfImage(const std::string& path)
{
  SpectralImageOptions options;
  options.integers = IntegerScaling::Raw;
  const auto file = openSpectralImage(path, options);
  const auto& info = file->info();
  const bool whole = info.sampleType.find("int") != std::string::npos;
  const bool channel = !info.wavelengths.empty() || !fileNameWavelengths(path).empty();
  return info.bands() == 1 && !channel && whole && looksLikeLabels(*file) ? FileKind::LabelImage
                                                                          : FileKind::SpectralImage;
}

// Columns of a table with one row a wavelength.
FileKind kindOfCurves(const TextTable& table)
{
  const auto& header = table.rows[0];
  const auto isChannel = [](const TextCell& cell)
  { return responseColumnNumber(cell.text) || reflectanceColumnWavelength(cell.text); };
  const bool constant = std::any_of(
    header.begin(), header.end(), [](const TextCell& cell) { return cell.text == "constant"; });
  if (constant)
  {
    return FileKind::SampleTable; // a reflectance transform
  }
  const Curves curves = curvesFromText(table);
  if (std::all_of(header.begin() + 1, header.end(), isChannel))
  {
    return curves.values.minCoeff() >= 0.0 ? FileKind::Camera : FileKind::SampleTable;
  }
  const Eigen::RowVectorXd white = curves.values.colwise().sum();
  return white.minCoeff() >= 0.5 && white.maxCoeff() <= 2.0 ? FileKind::Camera
                                                            : FileKind::SampleTable;
}

FileKind kindOfTable(const std::string& path, std::string text)
{
  if (looksLikeCgats(text))
  {
    return FileKind::SampleTable;
  }
  if (looksLikeXml(text))
  {
    return text.find("CxF") != std::string::npos ? FileKind::SampleTable : FileKind::Unknown;
  }
  if (text.find('\0') != std::string::npos)
  {
    return FileKind::Unknown;
  }
  // A table that is longer than its beginning ends with its last whole line.
  const auto last = text.size() >= TableBeginning ? text.rfind('\n') : std::string::npos;
  if (last != std::string::npos)
  {
    text.resize(last + 1);
  }
  const TextTable table = parseDelimitedText(path, text);
  const auto& header = table.rows[0];
  if (isHeaderless(table))
  {
    readSampleTable(path); // numbers alone: the shape decides
    return FileKind::SampleTable;
  }
  if (isWavelengthHeader(header[0].text) && header.size() > 1)
  {
    return kindOfCurves(table);
  }
  const bool spectral = std::any_of(header.begin(), header.end(),
    [&](const TextCell& cell)
    {
      return reflectanceColumnWavelength(cell.text, table.decimalComma) ||
        responseColumnNumber(cell.text, table.decimalComma);
    });
  return spectral || isTransform(table) ? FileKind::SampleTable : FileKind::Unknown;
}

// No image by itself: a table, or several arrays of which the user names one.
FileKind kindOfArraysToChoose(const std::string& path)
{
  try
  {
    readSampleTable(path);
    return FileKind::SampleTable;
  }
  catch (const std::exception&)
  {
    if (imageVariables(path).empty())
    {
      throw;
    }
    return FileKind::SpectralImage;
  }
}

FileKind kindOfArrays(const std::string& path)
{
  try
  {
    openSpectralImage(path);
    return FileKind::SpectralImage;
  }
  catch (const std::exception&)
  {
    return kindOfArraysToChoose(path);
  }
}

FileKind kindOf(const std::string& name)
{
  const fs::path path(name);
  if (fs::is_directory(path))
  {
    return isCaptureFolder(path) ? FileKind::Capture : FileKind::Unknown;
  }
  requireReadableFile(name);
  if (path.extension() == ".json")
  {
    return kindOfJson(path);
  }
  if (openArrayFile(name))
  {
    return kindOfArrays(name);
  }
  try
  {
    return kindOfImage(name);
  }
  catch (const std::exception&)
  {
    return kindOfTable(name, readFileBeginning(name, TableBeginning));
  }
}
}

FileKind fileKind(const std::string& path) noexcept
{
  try
  {
    return kindOf(path);
  }
  catch (const std::exception&)
  {
    return FileKind::Unknown;
  }
}

} // namespace msi
