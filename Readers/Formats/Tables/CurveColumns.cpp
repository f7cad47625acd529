#include "Formats/Tables/CurveColumns.h"

#include "Formats/Tables/SampleColumns.h"
#include "Formats/Text/NumberText.h"
#include "Formats/Text/SpectralNames.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <numeric>
#include <set>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
constexpr double NanometresPerMicrometre = 1000.0;
constexpr double LongestInMicrometres = 20.0;

std::vector<std::string> namesOf(const TextTable& table, bool headerless)
{
  std::vector<std::string> names;
  std::set<std::string> known;
  for (std::size_t i = 1; i < table.rows[0].size(); ++i)
  {
    std::string name =
      headerless ? "curve" + std::to_string(i) : std::string(table.rows[0][i].text);
    if (name.empty() || !known.insert(name).second)
    {
      throw FormatError(table.place(table.rows[0][i]),
        name.empty() ? "column " + std::to_string(i + 1) + " has no name"
                     : "two columns are named '" + name + "'",
        "different names in the header", "name the column or remove it");
    }
    names.push_back(std::move(name));
  }
  return names;
}
}

bool isWavelengthHeader(std::string_view name)
{
  static constexpr std::array<std::string_view, 6> Names = { "wavelength", "wavelengths", "nm",
    "lambda", "wl", "wave" };
  std::string lower = lowerCase(name);
  lower.erase(
    std::remove_if(lower.begin(), lower.end(),
      [](char c) { return std::string_view(" _()[]").find(c) != std::string_view::npos; }),
    lower.end());
  const auto is = [](std::string_view text)
  { return std::find(Names.begin(), Names.end(), text) != Names.end(); };
  const bool hasUnit = lower.size() > 2 && lower.compare(lower.size() - 2, 2, "nm") == 0;
  return is(lower) || (hasUnit && is(std::string_view(lower).substr(0, lower.size() - 2)));
}

Curves curvesFromText(const TextTable& table)
{
  const TextRow& header = table.rows[0];
  const bool headerless = isHeaderless(table) || parseNumber(header[0].text, table.decimalComma);
  if (!headerless && !isWavelengthHeader(header[0].text))
  {
    throw FormatError(table.place(header[0]),
      "the first column is '" + std::string(header[0].text) + "'",
      "a column named wavelength, one row a wavelength", "rename the column");
  }
  if (header.size() < 2)
  {
    throw FormatError(table.place(header[0]), "there is a wavelength column but no curve",
      "at least two columns", "check how the file was written");
  }
  const std::size_t first = headerless ? 0 : 1;
  if (table.rows.size() == first)
  {
    throw FormatError(table.place(header[0]), "there is a header but no row",
      "one row a wavelength below the header", "check how the file was written");
  }
  requireRectangular(table);

  const std::size_t count = table.rows.size() - first;
  std::vector<double> nm;
  for (std::size_t i = 0; i < count; ++i)
  {
    nm.push_back(
      requireNumber(table, table.rows[first + i][0], header[0].text, "wavelength in nm"));
  }
  std::vector<std::string> notes;
  if (std::all_of(nm.begin(), nm.end(), [](double w) { return w > 0 && w < LongestInMicrometres; }))
  {
    std::transform(nm.begin(), nm.end(), nm.begin(),
      [](double w) { return withoutConversionNoise(w * NanometresPerMicrometre); });
    notes.emplace_back("wavelengths were in micrometres: multiplied by 1000");
  }
  std::vector<std::size_t> order(count);
  std::iota(order.begin(), order.end(), std::size_t{ 0 });
  std::stable_sort(
    order.begin(), order.end(), [&nm](std::size_t a, std::size_t b) { return nm[a] < nm[b]; });
  Eigen::MatrixXd values(
    static_cast<Eigen::Index>(count), static_cast<Eigen::Index>(header.size() - 1));
  std::vector<double> sorted;
  for (Eigen::Index row = 0; row < values.rows(); ++row)
  {
    const std::size_t source = order[static_cast<std::size_t>(row)];
    const TextRow& cells = table.rows[first + source];
    if (!sorted.empty() && sorted.back() == nm[source])
    {
      throw FormatError(table.place(cells[0]),
        "wavelength " + numberText(nm[source]) + " stands here a second time",
        "each wavelength once", "remove one of the rows");
    }
    sorted.push_back(nm[source]);
    for (Eigen::Index column = 0; column < values.cols(); ++column)
    {
      const auto at = static_cast<std::size_t>(column) + 1;
      values(row, column) =
        requireNumber(table, cells[at], headerless ? "" : header[at].text, "number");
    }
  }
  try
  {
    return { WavelengthGrid(std::move(sorted)), namesOf(table, headerless), std::move(values),
      std::move(notes) };
  }
  catch (const std::invalid_argument& error)
  {
    throw FormatError(
      table.place(table.rows[first][0]), error.what(), {}, "state the wavelengths in nanometres");
  }
}

} // namespace msi
