// Least squares by singular value decomposition, shared by the linear fits.
#pragma once

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

struct LeastSquaresSolution
{
  Eigen::MatrixXd coefficients;
  Eigen::Index rank = 0;
  double condition = 0.0; // of the part that counts toward the rank
};

// X of least Frobenius norm among those that minimize |X A - B|, X = B A+.
// A is p x n, B is m x n (one column per equation), X is m x p. Singular values below 'tolerance'
// times the largest count as zero; a negative tolerance means max(p, n) 2^-52.
LeastSquaresSolution solveLeastSquares(
  const Eigen::MatrixXd& a, const Eigen::MatrixXd& b, double tolerance = -1.0);

// Normal equations are products of columns, of which the last is the residual. Squared residual after a change of the others.
double energyLeft(const Eigen::MatrixXd& normal, const Eigen::VectorXd& change);

struct BandedFit
{
  Eigen::MatrixXd coefficients; // n x (n+1), the constant last
  Eigen::Index rank = 0;        // of the weakest row
  double condition = 0.0;       // of the worst row
  Eigen::Index unknowns = 0;    // of all rows together
  std::vector<Eigen::Index> deficientRows;
};

// Coefficients of the largest row: itself, the neighbours that exist, and the constant.
Eigen::Index unknownsPerRow(Eigen::Index rows, Eigen::Index neighbours) noexcept;

// Per row i, least squares of target(i) on input(i-neighbours .. i+neighbours) and a constant, over
// the columns. Both matrices are n x L. A rank-deficient row takes the solution nearest to the
// identity row and is listed.
BandedFit fitBanded(const Eigen::MatrixXd& input, const Eigen::MatrixXd& target,
  Eigen::Index neighbours, double tolerance = -1.0);

// x with a row of ones below.
Eigen::MatrixXd withConstant(const Eigen::MatrixXd& x);

double rootMeanSquare(const Eigen::MatrixXd& values);

// "3", "3 and 5", "3, 5 and 9"; counted from 1.
std::string listOfRows(const std::vector<Eigen::Index>& rows);

} // namespace msi
