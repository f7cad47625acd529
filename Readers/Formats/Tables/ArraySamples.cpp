#include "Formats/Tables/ArraySamples.h"

#include "Formats/Arrays/ArrayWavelengths.h"
#include "Formats/FormatError.h"
#include "Formats/Tables/NumberMatrices.h"
#include "Formats/Text/NumberText.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <functional>
#include <optional>
#include <utility>

namespace msi
{

namespace
{
constexpr std::int64_t MostElements = std::int64_t{ 1 } << 28;

bool isMatrix(const NamedArray& array)
{
  return array.shape.size() == 2 && array.shape[0] > 1 && array.shape[1] > 1 &&
    array.count() <= MostElements;
}

class ArraySamples
{
public:
  ArraySamples(const ArrayFile& file, const SampleTableOptions& options)
    : File(file)
    , Options(options)
  {
  }

  SampleTable read()
  {
    std::string source;
    if (!Options.wavelengths)
    {
      std::vector<double> nm = findWavelengths(File, source);
      if (!nm.empty() && std::is_sorted(nm.begin(), nm.end(), std::less_equal<>()))
      {
        Options.wavelengths = WavelengthGrid(std::move(nm));
      }
    }
    const std::size_t bands =
      static_cast<std::size_t>(Options.wavelengths ? Options.wavelengths->size() : 31);
    const std::size_t reflectance = choose(Options.reflectanceVariable, bands);
    const NumberMatrix reflectanceMatrix = matrix(reflectance);
    const NamedArray& array = File.arrays()[reflectance];
    const bool firstIsSpectral = array.shape[0] == static_cast<std::int64_t>(bands);
    const std::int64_t samples = array.shape[firstIsSpectral ? 1 : 0];
    const auto responses = chooseResponses(reflectance, samples);
    SampleTable table = samplesFromMatrices(
      reflectanceMatrix, responses ? matrix(*responses) : NumberMatrix{}, Options);
    if (!source.empty() && Options.wavelengths)
    {
      table.notes.push_back("wavelengths are those of '" + source + "'");
    }
    addNames(table);
    return table;
  }

private:
  std::size_t choose(const std::string& name, std::size_t side) const
  {
    if (!name.empty())
    {
      return requireMatrix(name);
    }
    const auto fitting = matricesWithSide(static_cast<std::int64_t>(side), File.arrays().size());
    if (fitting.size() != 1)
    {
      throw FormatError(File.path(),
        (fitting.empty() ? "no matrix has" : "several matrices have") + std::string(" a side of ") +
          std::to_string(side) + "; it holds " + File.listing(),
        "one matrix with a side as long as the wavelengths",
        "state the wavelengths, or name the variable of the reflectance");
    }
    return fitting[0];
  }

  std::optional<std::size_t> chooseResponses(std::size_t reflectance, std::int64_t samples) const
  {
    if (!Options.responseVariable.empty())
    {
      return requireMatrix(Options.responseVariable);
    }
    const auto fitting = matricesWithSide(samples, reflectance);
    return fitting.size() == 1 ? std::optional(fitting[0]) : std::nullopt;
  }

  std::size_t requireMatrix(const std::string& name) const
  {
    const std::size_t index = File.require(name);
    if (!isMatrix(File.arrays()[index]))
    {
      throw FormatError(File.path(), "'" + name + "' is " + File.shapeText(File.arrays()[index]),
        "a matrix of bands and samples", "name another variable");
    }
    return index;
  }

  std::vector<std::size_t> matricesWithSide(std::int64_t side, std::size_t except) const
  {
    std::vector<std::size_t> fitting;
    for (std::size_t i = 0; i < File.arrays().size(); ++i)
    {
      const NamedArray& array = File.arrays()[i];
      if (i != except && !array.isText && isMatrix(array) &&
        (array.shape[0] == side || array.shape[1] == side))
      {
        fitting.push_back(i);
      }
    }
    return fitting;
  }

  NumberMatrix matrix(std::size_t index) const
  {
    const NamedArray& array = File.arrays()[index];
    const std::vector<double> values = File.readAll(index);
    const auto bad = std::find_if(
      values.begin(), values.end(), [](double value) { return !std::isfinite(value); });
    if (bad != values.end())
    {
      throw FormatError(File.path(),
        "'" + array.name + "' holds " + numberText(*bad) + " as element " +
          std::to_string(bad - values.begin() + 1),
        "finite numbers", "remove the sample");
    }
    // Column by column where MATLAB wrote it, else row by row.
    const Eigen::Map<const Eigen::MatrixXd> stored(values.data(), array.shape[1], array.shape[0]);
    return { File.path(), array.name,
      File.isMatlab() ? Eigen::MatrixXd(stored) : Eigen::MatrixXd(stored.transpose()) };
  }

  void addNames(SampleTable& table) const
  {
    for (std::size_t i = 0; i < File.arrays().size(); ++i)
    {
      const NamedArray& array = File.arrays()[i];
      if (!array.isText || array.shape.size() != 2 || array.shape[1] != table.sampleCount() ||
        array.count() > MostElements)
      {
        continue;
      }
      const std::vector<double> codes = File.readAll(i);
      MetadataColumn names{ "sample", {} };
      for (std::int64_t row = 0; row < array.shape[1]; ++row)
      {
        std::string name;
        for (std::int64_t column = 0; column < array.shape[0]; ++column)
        {
          const double code = codes[static_cast<std::size_t>(column * array.shape[1] + row)];
          name += code >= 32 && code < 127 ? static_cast<char>(code) : ' ';
        }
        names.text.emplace_back(trimmed(name));
      }
      table.metadata.push_back(std::move(names));
      return;
    }
  }

  const ArrayFile& File;
  SampleTableOptions Options;
};
}

SampleTable samplesFromArrays(const ArrayFile& file, const SampleTableOptions& options)
{
  return ArraySamples(file, options).read();
}

} // namespace msi
