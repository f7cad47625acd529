#include "Kernels/Estimation/Transfer/ReducedTransfer.h"

#include "Kernels/Numerics/ThinSvd.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double BinaryLogarithmOfE = 1.4426950408889634;
// What float leaves of a Gaussian's value; large coefficients would multiply it.
constexpr double FloatRounding = 1e-5;
constexpr double StretchOfPoints = 1.15;
// What of the tolerance goes to directions, components and points; their squares add up to 1.
constexpr double DirectionsPart = 0.3;
constexpr double ComponentsPart = 0.5;
const double PointsPart = std::sqrt(1.0 - 0.3 * 0.3 - 0.5 * 0.5);
const double PointsPartOfBands = std::sqrt(1.0 - 0.3 * 0.3);

double rootMeanSquareRow(const Eigen::MatrixXd& rows)
{
  return std::sqrt(rows.squaredNorm() / static_cast<double>(rows.rows()));
}

// Features on which the reduction is judged, by columns.
Eigen::MatrixXd domainOf(const Eigen::MatrixXd& points)
{
  const Eigen::Index count = points.cols();
  Eigen::MatrixXd domain(points.rows(), 3 * count);
  domain.leftCols(count) = points;
  domain.middleCols(count, count) = StretchOfPoints * points;
  for (Eigen::Index i = 0; i < count; ++i)
  {
    domain.col(2 * count + i) = 0.5 * (points.col(i) + points.col((i + 1) % count));
  }
  return domain;
}

// Gaussians of the points (columns) at the domain (rows); the products of both go through the
// directions, the norms do not.
Eigen::MatrixXd gaussiansOf(const Eigen::MatrixXd& domain, const Eigen::MatrixXd& points,
  const Eigen::MatrixXd& directions, double exponent)
{
  const Eigen::MatrixXd products =
    (directions.transpose() * domain).transpose() * (directions.transpose() * points);
  Eigen::MatrixXd distances = -2.0 * products;
  distances.colwise() += domain.colwise().squaredNorm().transpose();
  distances.rowwise() += points.colwise().squaredNorm();
  return (exponent * distances.array()).exp();
}

struct KeptPoints
{
  std::vector<Eigen::Index> points;
  Eigen::MatrixXd coefficients; // points x components
};

// Columns of 'gaussians' whose combination leaves rows of 'values' that are as long as the tolerance in
// the root mean square; the one that explains most first.
KeptPoints keepPoints(
  const Eigen::MatrixXd& gaussians, const Eigen::MatrixXd& values, double tolerance)
{
  const Eigen::Index rows = gaussians.rows();
  const Eigen::Index columns = gaussians.cols();
  // Ridge regression, so that no coefficient multiplies the rounding of float.
  Eigen::MatrixXd candidates(rows + columns, columns);
  candidates << gaussians,
    FloatRounding * std::sqrt(static_cast<double>(rows)) *
    Eigen::MatrixXd::Identity(columns, columns);
  Eigen::MatrixXd start = Eigen::MatrixXd::Zero(rows + columns, values.cols());
  start.topRows(rows) = values;

  // What the columns not yet kept have outside of the kept ones: their products with the residual, and their squares.
  Eigen::MatrixXd residual = start;
  Eigen::MatrixXd products = candidates.transpose() * start;
  Eigen::ArrayXd squares = candidates.colwise().squaredNorm().transpose();
  Eigen::MatrixXd units(rows + columns, columns);
  KeptPoints kept;
  while (static_cast<Eigen::Index>(kept.points.size()) < columns &&
    rootMeanSquareRow(residual.topRows(rows)) > tolerance)
  {
    const auto count = static_cast<Eigen::Index>(kept.points.size());
    Eigen::ArrayXd explained = products.rowwise().squaredNorm().array() / squares;
    explained(kept.points) = -1.0;
    Eigen::Index next = 0;
    explained.maxCoeff(&next);
    kept.points.push_back(next);
    Eigen::VectorXd unit = candidates.col(next);
    const auto known = units.leftCols(count);
    for (int twice = 0; twice < 2; ++twice) // the second time takes away what rounding left
    {
      unit -= known * (known.transpose() * unit).eval();
    }
    unit.normalize(); // never zero
    units.col(count) = unit;
    const Eigen::RowVectorXd explains = unit.transpose() * residual;
    const Eigen::VectorXd along = candidates.transpose() * unit;
    residual -= unit * explains;
    products -= along * explains;
    squares -= along.array().square();
  }
  const Eigen::MatrixXd chosen = candidates(Eigen::all, kept.points);
  kept.coefficients = (chosen.transpose() * chosen).llt().solve(chosen.transpose() * start);
  return kept;
}

Eigen::Index fourfold(Eigen::Index count)
{
  return (count + 3) / 4 * 4;
}

// What the expert's mean is made of, in its space and times its factor.
struct ExpertMean
{
  Eigen::VectorXd constant; // N
  Eigen::MatrixXd linear;   // N x K, of the features
  Eigen::MatrixXd smooth;   // m x N, of the Gaussians
};

ExpertMean meanOf(const TransferExpert& expert, double factor)
{
  const double channels = static_cast<double>(expert.points.rows());
  const Eigen::MatrixXd transposed = factor * expert.coefficients.transpose();
  ExpertMean mean;
  mean.constant = factor * expert.center + transposed * expert.weights.row(0).transpose();
  mean.linear = transposed * expert.weights.row(1).asDiagonal() * expert.points.transpose();
  mean.linear /= channels;
  mean.smooth = expert.weights.row(2).transpose().asDiagonal() * transposed.transpose();
  return mean;
}

// Adds factor (affine (v; 1)) as a function of the features of a linear expert.
void addAffine(
  ExpertMean& mean, const TransferFeatures& features, const Eigen::MatrixXd& affine, double factor)
{
  const Eigen::Index channels = features.center.size();
  const Eigen::VectorXd perResponse =
    (features.responseScale * (-features.logGain.array()).exp()).matrix();
  const Eigen::MatrixXd ofResponse =
    factor * affine.leftCols(channels) * perResponse.asDiagonal(); // of gain v / q
  mean.linear += features.scale * ofResponse;
  mean.constant += ofResponse * (features.center - features.offset) + factor * affine.col(channels);
}

// How many leading singular values leave a remainder within the tolerance; at least one.
Eigen::Index leadingComponents(const Eigen::VectorXd& singular, double tolerance)
{
  Eigen::Index count = singular.size();
  double outside = 0.0;
  while (count > 1)
  {
    outside += std::pow(singular[count - 1], 2);
    if (outside > tolerance * tolerance)
    {
      break;
    }
    --count;
  }
  return count;
}

ReducedTransferExpert reduceExpert(
  const TransferExpert& expert, const ExpertMean& mean, double tolerance, double& error)
{
  const Eigen::Index channels = expert.points.rows();
  const double exponent = -0.5 / (expert.length * expert.length * static_cast<double>(channels));
  const Eigen::MatrixXd domain = domainOf(expert.points);
  const Eigen::MatrixXd identity = Eigen::MatrixXd::Identity(channels, channels);
  const Eigen::MatrixXd smooth =
    gaussiansOf(domain, expert.points, identity, exponent) * mean.smooth;
  const Eigen::MatrixXd whole = smooth + (mean.linear * domain).transpose();
  // An error of the root counts by the slope of its square.
  const double slope = expert.features.space == TransferSpace::Linear
    ? 1.0
    : 2.0 * std::sqrt((whole.rowwise() + mean.constant.transpose()).array().square().mean());
  const double perRow = tolerance / slope * std::sqrt(static_cast<double>(mean.constant.size()));

  const Eigen::MatrixXd axes = thinSvd(expert.points).left;
  Eigen::MatrixXd gaussians;
  Eigen::Index directions = 0;
  do
  {
    ++directions;
    gaussians = gaussiansOf(domain, expert.points, axes.leftCols(directions), exponent);
  } while (directions < axes.cols() &&
    rootMeanSquareRow(gaussians * mean.smooth - smooth) > DirectionsPart * perRow);

  // Components of the bands where few of them say all; else the bands themselves.
  const ThinSvd components = thinSvd(whole.transpose());
  Eigen::MatrixXd expansion = components.left.leftCols(leadingComponents(
    components.singular, ComponentsPart * perRow * std::sqrt(static_cast<double>(whole.rows()))));
  KeptPoints best = keepPoints(gaussians, smooth * expansion, PointsPart * perRow);
  const Eigen::Index bands = mean.constant.size();
  const Eigen::Index inputs = channels + static_cast<Eigen::Index>(best.points.size());
  const bool isCompressed =
    fourfold(expansion.cols()) * inputs + fourfold(bands) * expansion.cols() <
    fourfold(bands) * inputs;
  if (!isCompressed)
  {
    expansion = Eigen::MatrixXd::Identity(bands, bands);
    best = keepPoints(gaussians, smooth, PointsPartOfBands * perRow);
  }

  const Eigen::MatrixXd points = expert.points(Eigen::all, best.points);
  const Eigen::MatrixXd chosenAxes = axes.leftCols(directions);
  const Eigen::VectorXd noConstants = Eigen::VectorXd::Zero(expansion.cols());
  const Eigen::VectorXd& constants = isCompressed ? noConstants : mean.constant;
  const TransferFeatures& features = expert.features;
  const Eigen::VectorXd gains = features.logGain.array().exp() / features.responseScale;
  const auto toFloat = [](const Eigen::VectorXd& values)
  {
    const Eigen::VectorXf narrow = values.cast<float>();
    return std::vector<float>(narrow.data(), narrow.data() + narrow.size());
  };
  ReducedTransferExpert reduced;
  reduced.space = features.space;
  reduced.gain = toFloat(gains);
  reduced.offset = toFloat(features.offset);
  reduced.scale = toFloat(Eigen::VectorXd::Constant(channels, 1.0 / features.scale));
  reduced.center = toFloat(features.center / features.scale);
  reduced.decay = static_cast<float>(exponent * BinaryLogarithmOfE);
  reduced.projection = GroupedMatrix(chosenAxes.transpose(), Eigen::VectorXd::Zero(directions));
  reduced.points = GroupedMatrix(
    -2.0 * exponent * BinaryLogarithmOfE * (chosenAxes.transpose() * points).transpose(),
    exponent * BinaryLogarithmOfE * points.colwise().squaredNorm().transpose());
  Eigen::MatrixXd ofBoth(expansion.cols(), channels + points.cols());
  ofBoth << expansion.transpose() * mean.linear, best.coefficients.transpose();
  reduced.components = GroupedMatrix(ofBoth, constants);
  if (isCompressed)
  {
    reduced.expansion = GroupedMatrix(expansion, mean.constant);
  }

  const Eigen::MatrixXd difference = whole -
    ((mean.linear * domain).transpose() * expansion +
      gaussiansOf(domain, points, chosenAxes, exponent) * best.coefficients) *
      expansion.transpose();
  error =
    slope * rootMeanSquareRow(difference) / std::sqrt(static_cast<double>(mean.constant.size()));
  return reduced;
}
}

GroupedMatrix::GroupedMatrix(const Eigen::MatrixXd& matrix, const Eigen::VectorXd& constants)
  : rows(fourfold(matrix.rows()))
  , columns(matrix.cols())
{
  for (Eigen::Index first = 0; first < rows; first += 4)
  {
    for (Eigen::Index column = -1; column < columns; ++column)
    {
      for (Eigen::Index row = first; row < first + 4; ++row)
      {
        const bool inside = row < matrix.rows();
        const double value = !inside ? 0.0 : column < 0 ? constants[row] : matrix(row, column);
        values.push_back(static_cast<float>(value));
      }
    }
  }
}

ReducedTransfer reduceTransfer(const TransferMixture& mixture, double tolerance)
{
  ReducedTransfer reduced;
  reduced.channels = mixture.affine.cols() - 1;
  reduced.bands = mixture.affine.rows();
  for (std::size_t i = 0; i < mixture.experts.size(); ++i)
  {
    const TransferExpert& expert = mixture.experts[i];
    const bool isLinear = expert.features.space == TransferSpace::Linear;
    const double share = mixture.meanShares[i];
    if (share <= 0.0 && !(isLinear && mixture.affineShare > 0.0))
    {
      continue;
    }
    // y |y| of sqrt(share) y is share y |y|.
    ExpertMean mean = meanOf(expert, isLinear ? share : std::sqrt(share));
    if (isLinear)
    {
      addAffine(mean, expert.features, mixture.affine, mixture.affineShare);
    }
    double error = 0.0;
    reduced.experts.push_back(reduceExpert(expert, mean, std::sqrt(0.5) * tolerance, error));
    reduced.error = std::hypot(reduced.error, error);
  }
  return reduced;
}

} // namespace msi
