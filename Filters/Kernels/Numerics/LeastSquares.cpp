#include "Kernels/Numerics/LeastSquares.h"

#include "Kernels/Numerics/ThinSvd.h"
#include "Kernels/Spectra/Counted.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace msi
{

LeastSquaresSolution solveLeastSquares(
  const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance)
{
  const auto [left, singular, right] = thinSvd(a.transpose());
  const double relative = tolerance >= 0.0
    ? tolerance
    : static_cast<double>(std::max(a.rows(), a.cols())) * std::numeric_limits<double>::epsilon();
  const double threshold = relative * singular(0);
  LeastSquaresSolution solution;
  while (solution.rank < singular.size() && singular(solution.rank) > threshold)
  {
    ++solution.rank;
  }
  const Eigen::Index rank = solution.rank;
  solution.condition = rank > 0 ? singular(0) / singular(rank - 1) : 0.0;
  solution.coefficients = b * left.leftCols(rank) *
    singular.head(rank).cwiseInverse().asDiagonal() * right.leftCols(rank).transpose();
  return solution;
}

double energyLeft(const Eigen::MatrixXd& normal, const Eigen::VectorXd& change)
{
  const Eigen::Index count = change.size();
  return normal(count, count) - 2.0 * change.dot(normal.col(count).head(count)) +
    change.dot(normal.topLeftCorner(count, count) * change);
}

Eigen::Index unknownsPerRow(Eigen::Index rows, Eigen::Index neighbours) noexcept
{
  return std::min(rows, 2 * neighbours + 1) + 1;
}

BandedFit fitBanded(const Eigen::MatrixXd& input, const Eigen::MatrixXd& target,
  Eigen::Index neighbours, double tolerance)
{
  const Eigen::Index rows = input.rows();
  BandedFit fit;
  fit.coefficients = Eigen::MatrixXd::Identity(rows, rows + 1);
  fit.rank = std::numeric_limits<Eigen::Index>::max();
  for (Eigen::Index row = 0; row < rows; ++row)
  {
    const Eigen::Index first = std::max<Eigen::Index>(row - neighbours, 0);
    const Eigen::Index count = std::min(row + neighbours, rows - 1) - first + 1;
    const auto solution = solveLeastSquares(
      withConstant(input.middleRows(first, count)), target.row(row) - input.row(row), tolerance);
    fit.coefficients.row(row).segment(first, count) += solution.coefficients.leftCols(count);
    fit.coefficients(row, rows) += solution.coefficients(0, count);
    fit.unknowns += count + 1;
    fit.rank = std::min(fit.rank, solution.rank);
    fit.condition = std::max(fit.condition, solution.condition);
    if (solution.rank < count + 1)
    {
      fit.deficientRows.push_back(row);
    }
  }
  return fit;
}

Eigen::MatrixXd withConstant(const Eigen::MatrixXd& x)
{
  Eigen::MatrixXd extended(x.rows() + 1, x.cols());
  extended << x, Eigen::RowVectorXd::Ones(x.cols());
  return extended;
}

double rootMeanSquare(const Eigen::MatrixXd& values)
{
  return std::sqrt(values.squaredNorm() / static_cast<double>(values.size()));
}

std::string listOfRows(const std::vector<Eigen::Index>& rows)
{
  std::vector<std::string> numbers;
  numbers.reserve(rows.size());
  for (const Eigen::Index row : rows)
  {
    numbers.push_back(std::to_string(row + 1));
  }
  return listed(numbers);
}

} // namespace msi
