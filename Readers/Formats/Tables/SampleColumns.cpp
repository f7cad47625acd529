#include "Formats/Tables/SampleColumns.h"

#include "Formats/Tables/ReflectanceScale.h"
#include "Formats/Text/CsvText.h"
#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

#include "Kernels/Spectra/Counted.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <map>
#include <set>
#include <utility>

namespace msi
{

namespace
{
constexpr std::size_t MostColumns = 65536;

struct NumberedColumn
{
  double number;
  std::size_t index;
};

struct Columns
{
  std::vector<NumberedColumn> reflectance;
  std::vector<NumberedColumn> responses;
  std::vector<std::size_t> metadata;
};

std::string quoted(std::string_view text)
{
  constexpr std::size_t longest = 40;
  std::string shown(text.substr(0, longest));
  return '\'' + shown + (text.size() > longest ? "...'" : "'");
}

std::string listOf(const TextRow& header)
{
  constexpr std::size_t most = 8;
  std::string list;
  for (std::size_t i = 0; i < std::min(header.size(), most); ++i)
  {
    list += (i > 0 ? ", " : "") + std::string(header[i].text);
  }
  return list + (header.size() > most ? ", ..." : "");
}

void sortWithoutDuplicates(
  const TextTable& table, std::vector<NumberedColumn>& columns, const char* kind)
{
  std::stable_sort(columns.begin(), columns.end(),
    [](const NumberedColumn& a, const NumberedColumn& b) { return a.number < b.number; });
  const auto twin = std::adjacent_find(columns.begin(), columns.end(),
    [](const NumberedColumn& a, const NumberedColumn& b) { return a.number == b.number; });
  if (twin != columns.end())
  {
    const TextCell& first = table.rows[0][twin->index];
    const TextCell& second = table.rows[0][(twin + 1)->index];
    throw FormatError(table.place(second),
      "columns " + quoted(first.text) + " and " + quoted(second.text) + " name the same " + kind,
      std::string("one column for each ") + kind, "remove or rename one of them");
  }
}

Columns classify(const TextTable& table)
{
  Columns columns;
  std::map<std::string, std::size_t> names;
  const TextRow& header = table.rows[0];
  if (header.size() > MostColumns)
  {
    throw FormatError(table.place(header[MostColumns]),
      "the table has " + std::to_string(header.size()) + " columns",
      "at most " + std::to_string(MostColumns) +
        ", one for each wavelength, channel and other datum",
      "one row a sample: the table may have to be transposed");
  }
  for (std::size_t i = 0; i < header.size(); ++i)
  {
    const std::string_view name = header[i].text;
    if (const auto nm = reflectanceColumnWavelength(name, table.decimalComma))
    {
      columns.reflectance.push_back({ *nm, i });
    }
    else if (const auto number = responseColumnNumber(name, table.decimalComma))
    {
      columns.responses.push_back({ *number, i });
    }
    else
    {
      if (name.empty())
      {
        throw FormatError(table.place(header[i]),
          "column " + std::to_string(i + 1) + " has no name",
          "a name in every column of the header", "name the column or remove it");
      }
      if (!names.emplace(lowerCase(name), i).second)
      {
        throw FormatError(table.place(header[i]), "two columns are named " + quoted(name),
          "different names", "rename or remove one of them");
      }
      columns.metadata.push_back(i);
    }
  }
  if (columns.reflectance.empty() && columns.responses.empty() && !isTransform(table))
  {
    throw FormatError(table.place(header[0]),
      "no column is a reflectance or a response (the columns are " + listOf(header) + ")",
      "columns named by wavelength in nm (R400, 400nm, SPEC_400, ...) or C and a number (C1, C400)",
      "rename the columns");
  }
  sortWithoutDuplicates(table, columns.reflectance, "wavelength");
  sortWithoutDuplicates(table, columns.responses, "channel");
  return columns;
}

Eigen::MatrixXd numbersOf(
  const TextTable& table, const std::vector<NumberedColumn>& columns, const char* kind)
{
  Eigen::MatrixXd matrix(static_cast<Eigen::Index>(columns.size()),
    static_cast<Eigen::Index>(columns.empty() ? 0 : table.rows.size() - 1));
  for (Eigen::Index sample = 0; sample < matrix.cols(); ++sample)
  {
    const TextRow& row = table.rows[static_cast<std::size_t>(sample) + 1];
    for (Eigen::Index i = 0; i < matrix.rows(); ++i)
    {
      const std::size_t at = columns[static_cast<std::size_t>(i)].index;
      matrix(i, sample) = requireNumber(table, row[at], table.rows[0][at].text, kind);
    }
  }
  return matrix;
}

WavelengthGrid gridOf(const std::vector<NumberedColumn>& columns)
{
  std::vector<double> nm;
  nm.reserve(columns.size());
  std::transform(columns.begin(), columns.end(), std::back_inserter(nm),
    [](const NumberedColumn& column) { return column.number; });
  return WavelengthGrid(std::move(nm));
}
}

bool isTransform(const TextTable& table)
{
  std::set<std::string> others;
  std::size_t channels = 0;
  for (const TextCell& cell : table.rows[0])
  {
    if (responseColumnNumber(cell.text, table.decimalComma))
    {
      ++channels;
    }
    else
    {
      others.insert(lowerCase(cell.text));
    }
  }
  const bool rowIsABand = others.erase("wavelength") > 0;
  const bool rowIsAChannel = others.erase("channel") > 0;
  if (channels == 0 && rowIsAChannel && others.count("x") > 0 && others.count("y") > 0)
  {
    return true; // displacements of an image's channels
  }
  const bool rowIsOne = rowIsABand != rowIsAChannel;
  others.erase("constant");
  return (channels > 0 && rowIsOne && others.empty()) ||
    (channels == 0 && others == std::set<std::string>{ "matrix", "row", "column", "value" });
}

void requireRectangular(const TextTable& table)
{
  const std::size_t width = table.rows[0].size();
  for (const TextRow& row : table.rows)
  {
    if (row.size() != width)
    {
      const TextCell& place = row.size() > width ? row[width] : row.back();
      const bool cutOff = &row == &table.rows.back() && row.size() < width && table.endsInsideLine;
      throw FormatError(table.place(place),
        "this row has " + counted(static_cast<std::ptrdiff_t>(row.size()), "cell"),
        std::to_string(width) + ", as line " + std::to_string(table.rows[0][0].line) + " has",
        cutOff ? "the file seems to be cut off" : "complete the row or remove it");
    }
  }
}

double requireNumber(
  const TextTable& table, const TextCell& cell, std::string_view columnName, const char* kind)
{
  const auto value = parseNumber(cell.text, table.decimalComma);
  if (value && std::isfinite(*value))
  {
    return *value;
  }
  const std::string column = columnName.empty() ? "" : " in column " + quoted(columnName);
  throw FormatError(table.place(cell),
    (cell.text.empty() ? "empty cell"
                       : quoted(cell.text) + (value ? " is not finite" : " is no number")) +
      column,
    std::string("a ") + kind, "fill in the value or remove the row");
}

bool isHeaderless(const TextTable& table)
{
  const TextRow& first = table.rows[0];
  double previous = 0.0;
  bool areWavelengths = true;
  for (const TextCell& cell : first)
  {
    const auto value = parseNumber(cell.text, table.decimalComma);
    if (!value)
    {
      return false;
    }
    constexpr double shortestColumnWavelength = 200.0;
    areWavelengths = areWavelengths && *value >= shortestColumnWavelength && *value > previous &&
      reflectanceColumnWavelength(cell.text, table.decimalComma);
    previous = *value;
  }
  return !areWavelengths;
}

SampleTable samplesFromText(const TextTable& table, ReflectanceUnit unit)
{
  const Columns columns = classify(table);
  if (table.rows.size() < 2)
  {
    throw FormatError(table.place(table.rows[0][0]), "there is a header but no sample",
      "one row a sample below the header", "check how the file was written");
  }
  requireRectangular(table);

  SampleTable samples;
  for (const std::size_t at : columns.metadata)
  {
    MetadataColumn column{ std::string(table.rows[0][at].text), {} };
    column.text.reserve(table.rows.size() - 1);
    std::transform(table.rows.begin() + 1, table.rows.end(), std::back_inserter(column.text),
      [at](const TextRow& row) { return std::string(withFormula(row[at].text)); });
    samples.metadata.push_back(std::move(column));
  }
  samples.reflectance = numbersOf(table, columns.reflectance, "reflectance");
  samples.responses = numbersOf(table, columns.responses, "response");
  std::vector<double> numbers;
  for (const NumberedColumn& column : columns.responses)
  {
    samples.channelNames.emplace_back(table.rows[0][column.index].text);
    numbers.push_back(column.number);
  }
  if (areResponseWavelengths(numbers))
  {
    samples.channelWavelengths = gridOf(columns.responses);
  }
  if (!columns.reflectance.empty())
  {
    samples.wavelengths = gridOf(columns.reflectance);
  }
  if (!isTransform(table)) // whose coefficients are no responses
  {
    bringToFactor(samples, unit,
      [&table](Eigen::Index sample)
      { return table.place(table.rows[static_cast<std::size_t>(sample) + 1][0]); });
  }
  return samples;
}

} // namespace msi
