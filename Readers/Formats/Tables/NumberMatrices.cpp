#include "Formats/Tables/NumberMatrices.h"

#include "Formats/FormatError.h"
#include "Formats/Tables/ReflectanceScale.h"
#include "Formats/Tables/SampleColumns.h"
#include "Formats/Text/NumberText.h"

namespace msi
{

namespace
{
std::string shapeText(const NumberMatrix& matrix)
{
  return (matrix.name.empty() ? std::string("the matrix") : "the matrix '" + matrix.name + "'") +
    " is " + std::to_string(matrix.values.rows()) + " x " + std::to_string(matrix.values.cols());
}

std::string gridText(const WavelengthGrid& grid)
{
  return std::to_string(grid.size()) + " wavelengths (" + numberText(grid.front()) + ".." +
    numberText(grid.back()) + " nm)";
}

Eigen::MatrixXd withBandsAsRows(
  const NumberMatrix& matrix, const WavelengthGrid& grid, std::vector<std::string>& notes)
{
  const bool rowsFit = matrix.values.rows() == grid.size();
  const bool columnsFit = matrix.values.cols() == grid.size();
  if (!rowsFit && !columnsFit)
  {
    throw FormatError(matrix.file, shapeText(matrix), "one side of " + gridText(grid),
      "state the wavelengths of the matrix");
  }
  if (rowsFit && columnsFit)
  {
    notes.emplace_back("the reflectance matrix is square: its rows were taken as samples");
  }
  else
  {
    notes.emplace_back(std::string("the reflectance matrix has ") + (rowsFit ? "columns" : "rows") +
      " as samples and " + gridText(grid));
  }
  return columnsFit ? Eigen::MatrixXd(matrix.values.transpose()) : matrix.values;
}

Eigen::MatrixXd withChannelsAsRows(const NumberMatrix& matrix, const NumberMatrix& reflectance,
  Eigen::Index samples, bool samplesWereRows, std::vector<std::string>& notes)
{
  const bool rowsFit = matrix.values.rows() == samples;
  const bool columnsFit = matrix.values.cols() == samples;
  if (!rowsFit && !columnsFit)
  {
    throw FormatError(matrix.file, shapeText(matrix),
      "one side of " + std::to_string(samples) + ", the samples of " +
        (reflectance.name.empty() ? reflectance.file : "'" + reflectance.name + "'"),
      "give reflectances and responses of the same samples");
  }
  const bool transpose = rowsFit && (!columnsFit || samplesWereRows);
  notes.emplace_back(
    std::string("the response matrix has ") + (transpose ? "rows" : "columns") + " as samples");
  return transpose ? Eigen::MatrixXd(matrix.values.transpose()) : matrix.values;
}
}

NumberMatrix numberMatrixFromText(const TextTable& table)
{
  requireRectangular(table);
  NumberMatrix matrix{ table.file, {},
    Eigen::MatrixXd(static_cast<Eigen::Index>(table.rows.size()),
      static_cast<Eigen::Index>(table.rows[0].size())) };
  for (Eigen::Index row = 0; row < matrix.values.rows(); ++row)
  {
    for (Eigen::Index column = 0; column < matrix.values.cols(); ++column)
    {
      matrix.values(row, column) = requireNumber(table,
        table.rows[static_cast<std::size_t>(row)][static_cast<std::size_t>(column)], {}, "number");
    }
  }
  return matrix;
}

SampleTable samplesFromMatrices(
  const NumberMatrix& reflectance, const NumberMatrix& responses, const SampleTableOptions& options)
{
  SampleTable table;
  const bool assumed = !options.wavelengths;
  const WavelengthGrid grid =
    assumed ? WavelengthGrid::uniform(400.0, 700.0, 10.0) : *options.wavelengths;
  table.reflectance = withBandsAsRows(reflectance, grid, table.notes);
  if (assumed)
  {
    table.notes.emplace_back("the wavelengths are assumed: 400..700 nm in steps of 10");
  }
  table.wavelengths = grid;
  if (responses.values.size() > 0)
  {
    table.responses = withChannelsAsRows(responses, reflectance, table.reflectance.cols(),
      reflectance.values.cols() == grid.size(), table.notes);
    for (Eigen::Index channel = 1; channel <= table.responses.rows(); ++channel)
    {
      table.channelNames.push_back("C" + std::to_string(channel));
    }
  }
  bringToFactor(table, options.unit,
    [&reflectance](Eigen::Index) {
      return FilePlace{ reflectance.file, 0, 0 };
    });
  return table;
}

} // namespace msi
