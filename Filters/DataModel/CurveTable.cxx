#include "CurveTable.h"

#include "SampleColumns.h"

#include "vtkTable.h"

#include "Formats/Curves.h"

#include <algorithm>
#include <filesystem>
#include <limits>
#include <map>
#include <set>
#include <stdexcept>

namespace msi
{

namespace
{
std::string nameWithoutSeparators(std::string name)
{
  std::replace_if(
    name.begin(), name.end(), [](char c) { return c == ' ' || c == ',' || c == '\t'; }, '-');
  return name;
}
}

std::string readCurveTable(const std::vector<std::string>& files, vtkTable* table)
{
  std::string notes;
  std::vector<Curves> all;
  std::map<double, Eigen::Index> rows;
  for (const auto& file : files)
  {
    auto curves = readCurves(file);
    if (curves.names.size() == 1)
    {
      curves.names[0] = std::filesystem::path(file).stem().string();
    }
    for (const double nm : curves.wavelengths.values())
    {
      rows[nm] = 0;
    }
    for (const auto& note : curves.notes)
    {
      notes += (notes.empty() ? "" : "\n") + note;
    }
    all.push_back(std::move(curves));
  }
  Eigen::VectorXd wavelengths(static_cast<Eigen::Index>(rows.size()));
  Eigen::Index next = 0;
  for (auto& [nm, row] : rows)
  {
    row = next;
    wavelengths(next++) = nm;
  }
  setNumbers(table, WavelengthColumn, wavelengths);
  std::set<std::string> known{ WavelengthColumn };
  for (std::size_t i = 0; i < all.size(); ++i)
  {
    for (Eigen::Index column = 0; column < all[i].values.cols(); ++column)
    {
      const std::string name =
        nameWithoutSeparators(all[i].names[static_cast<std::size_t>(column)]);
      if (!known.insert(name).second)
      {
        throw std::invalid_argument(files[i] + ": a curve is named '" + name +
          "' as another one is; expected different names; rename the file or the column");
      }
      Eigen::VectorXd values =
        Eigen::VectorXd::Constant(next, std::numeric_limits<double>::quiet_NaN());
      for (Eigen::Index row = 0; row < all[i].values.rows(); ++row)
      {
        values(rows.at(all[i].wavelengths[row])) = all[i].values(row, column);
      }
      setNumbers(table, name, values);
    }
  }
  return notes;
}

} // namespace msi
