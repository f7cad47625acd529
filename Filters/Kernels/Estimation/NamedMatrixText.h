// Named matrices as text, as the reference program and the tests exchange them: a line
// "name rows columns", then one line per row.
#pragma once

#include <Eigen/Core>

#include <istream>
#include <map>
#include <ostream>
#include <string>

namespace msi
{

inline std::map<std::string, Eigen::MatrixXd> readNamedMatrices(std::istream& in)
{
  std::map<std::string, Eigen::MatrixXd> matrices;
  std::string name;
  Eigen::Index rows = 0;
  Eigen::Index columns = 0;
  while (in >> name >> rows >> columns)
  {
    Eigen::MatrixXd& matrix = matrices[name];
    matrix.resize(rows, columns);
    for (Eigen::Index row = 0; row < rows; ++row)
    {
      for (Eigen::Index column = 0; column < columns; ++column)
      {
        in >> matrix(row, column);
      }
    }
  }
  return matrices;
}

inline void writeNamedMatrix(
  std::ostream& out, const std::string& name, const Eigen::MatrixXd& matrix)
{
  const Eigen::IOFormat exact(Eigen::FullPrecision, Eigen::DontAlignCols, " ", "\n");
  out << name << ' ' << matrix.rows() << ' ' << matrix.cols() << '\n'
      << matrix.format(exact) << '\n';
}

} // namespace msi
