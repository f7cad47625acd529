#include "DisplacementTable.h"

#include "SampleColumns.h"

#include "vtkDataArray.h"
#include "vtkNew.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <cmath>
#include <cstddef>
#include <sstream>
#include <stdexcept>

namespace msi
{

namespace
{
constexpr const char* DisplacedChannelColumn = "channel";
constexpr std::array<const char*, 4> DisplacementColumns = { "x", "y", "magnification",
  "rotation" };
// Beyond these no two channels show the same scene; in pixels, relative, in degrees.
constexpr std::array<double, 4> LargestDisplacements = { 1000.0, 1000.0, 0.2, 45.0 };

Eigen::Array4d fourOf(const ChannelDisplacement& d)
{
  return { d.right, d.down, d.magnification, d.rotation };
}
}

void writeDisplacements(const std::vector<ChannelDisplacement>& displacements,
  const SpectralAxis& channels, const std::array<double, 2>& spacing, vtkTable* table)
{
  const Eigen::Array4d units(spacing[0], spacing[1], 1.0, 1.0);
  const auto count = static_cast<Eigen::Index>(displacements.size());
  Eigen::MatrixXd columns(count, 9);
  vtkNew<vtkStringArray> names;
  names->SetName(DisplacedChannelColumn);
  for (Eigen::Index k = 0; k < count; ++k)
  {
    const ChannelDisplacement& d = displacements[static_cast<std::size_t>(k)];
    names->InsertNextValue(channels.names[static_cast<std::size_t>(k)]);
    columns.row(k) << (fourOf(d) * units).matrix().transpose(),
      (d.standardError * units).matrix().transpose(), d.agreement;
  }
  table->AddColumn(names);
  for (std::size_t i = 0; i < DisplacementColumns.size(); ++i)
  {
    setNumbers(table, DisplacementColumns[i], columns.col(static_cast<Eigen::Index>(i)));
  }
  for (std::size_t i = 0; i < DisplacementColumns.size(); ++i)
  {
    setNumbers(table, std::string(DisplacementColumns[i]) + " error",
      columns.col(static_cast<Eigen::Index>(i) + 4));
  }
  setNumbers(table, "agreement", columns.col(8));
}

std::vector<ChannelDisplacement> readDisplacements(
  vtkTable* table, const SpectralAxis& channels, const std::array<double, 2>& spacing)
{
  auto* names = table->GetColumnByName(DisplacedChannelColumn);
  std::array<vtkDataArray*, 4> columns{};
  for (std::size_t i = 0; i < columns.size(); ++i)
  {
    columns[i] = vtkDataArray::SafeDownCast(table->GetColumnByName(DisplacementColumns[i]));
    if (!columns[i] || !names)
    {
      throw std::invalid_argument(std::string("the table of displacements has no column '") +
        (names ? DisplacementColumns[i] : DisplacedChannelColumn) +
        "'; expected channel, x, y, magnification, rotation, as Channel Displacement gives them");
    }
  }
  const auto count = static_cast<std::size_t>(table->GetNumberOfRows());
  if (count != channels.size())
  {
    throw std::invalid_argument("the table of displacements has " + std::to_string(count) +
      " rows, but the image has " + describe(channels, "channels") + "; expected one row each");
  }
  const std::array<double, 4> units = { spacing[0], spacing[1], 1.0, 1.0 };
  std::vector<ChannelDisplacement> displacements;
  for (std::size_t k = 0; k < count; ++k)
  {
    const auto row = static_cast<vtkIdType>(k);
    const std::string name = names->GetVariantValue(row).ToString();
    if (name != channels.names[k])
    {
      throw std::invalid_argument("row " + std::to_string(k + 1) +
        " of the table of displacements is of channel '" + name + "'; expected '" +
        channels.names[k] + "', the image's channels in their order");
    }
    std::array<double, 4> values{};
    for (std::size_t i = 0; i < values.size(); ++i)
    {
      values[i] = columns[i]->GetComponent(row, 0) / units[i];
      if (!(std::abs(values[i]) <= LargestDisplacements[i]))
      {
        std::ostringstream text;
        text << "row " << k + 1 << " of the table of displacements has " << DisplacementColumns[i]
             << " = " << columns[i]->GetComponent(row, 0) << "; expected a number from "
             << -LargestDisplacements[i] * units[i] << " to " << LargestDisplacements[i] * units[i];
        throw std::invalid_argument(text.str());
      }
    }
    displacements.push_back({ values[0], values[1], values[2], values[3] });
  }
  return displacements;
}

} // namespace msi
