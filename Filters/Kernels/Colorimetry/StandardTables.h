// The tables of Data/Tables as they were compiled in; for the classes of this folder.
#pragma once

#include <Eigen/Core>

#include <string_view>
#include <vector>

namespace msi
{

struct StandardTable
{
  std::string_view name; // the file's name without its extension
  Eigen::Index rows;
  Eigen::Index columns;
  const double* data; // row by row; the first column is the wavelength in nm

  using Matrix = Eigen::Matrix<double, Eigen::Dynamic, Eigen::Dynamic, Eigen::RowMajor>;
  Eigen::Map<const Matrix> values() const noexcept { return { data, rows, columns }; }

  std::vector<double> wavelengths() const
  {
    const Eigen::VectorXd first = values().col(0);
    return { first.begin(), first.end() };
  }
};

// All tables, in the order in which CMakeLists.txt lists them.
const std::vector<StandardTable>& standardTables();

} // namespace msi
