#include "Kernels/Camera/ChannelFit.h"

#include "Kernels/Numerics/NonNegativeLeastSquares.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double ReferenceStep = 10.0; // nm, at which the penalty sums are taken as they stand
constexpr PenaltyWeights FirstFit = { 0.0, 1e-3 };

Eigen::MatrixXd roughness(const WavelengthGrid& grid)
{
  const Eigen::Index count = grid.size();
  Eigen::MatrixXd sum = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index j = 1; j + 1 < count; ++j)
  {
    Eigen::RowVectorXd difference = Eigen::RowVectorXd::Zero(count);
    difference.segment<3>(j - 1) << 1.0, -2.0, 1.0;
    sum += difference.transpose() * difference;
  }
  return sum * std::pow(ReferenceStep / *grid.step(), 5);
}
}

ChannelFitProblem::ChannelFitProblem(const WavelengthGrid& wavelengths,
  const Eigen::MatrixXd& reflectance, const Eigen::MatrixXd& response,
  const CameraModelFitOptions& options)
  : Grid(wavelengths)
  , Reflectance(reflectance)
  , Response(response)
  , Options(options)
  , MeanVariance((reflectance.colwise() - reflectance.rowwise().mean()).array().square().mean())
  , Roughness(roughness(wavelengths))
{
}

ChannelMoments ChannelFitProblem::moments(const std::vector<Eigen::Index>& samples) const
{
  const Eigen::MatrixXd r = Reflectance(Eigen::all, samples);
  const Eigen::MatrixXd u = Response(Eigen::all, samples);
  ChannelMoments moments;
  if (Options.dark)
  {
    moments.meanReflectance = Eigen::VectorXd::Zero(r.rows());
    moments.meanResponse = *Options.dark;
  }
  else
  {
    moments.meanReflectance = r.rowwise().mean();
    moments.meanResponse = u.rowwise().mean();
  }
  const Eigen::MatrixXd x = r.colwise() - moments.meanReflectance;
  const Eigen::MatrixXd y = u.colwise() - moments.meanResponse;
  const auto count = static_cast<double>(samples.size());
  moments.covariance = x * x.transpose() / count;
  moments.cross = x * y.transpose() / count;
  return moments;
}

Eigen::VectorXd ChannelFitProblem::centers(const ChannelMoments& moments) const
{
  if (Options.nominal)
  {
    const Eigen::VectorXd nominal = Options.nominal->centroids();
    const double middle = 0.5 * (Grid.front() + Grid.back());
    return nominal.unaryExpr([middle](double c) { return std::isfinite(c) ? c : middle; });
  }
  const auto reach =
    static_cast<Eigen::Index>(std::ceil(2.0 * Options.passbandWidth / *Grid.step()));
  const Eigen::MatrixXd h = moments.covariance + penalty(0.0, FirstFit);
  Eigen::VectorXd centers(moments.cross.cols());
  for (Eigen::Index k = 0; k < centers.size(); ++k)
  {
    const Eigen::VectorXd row = solveNonNegative(h, moments.cross.col(k)).x;
    // The heaviest stretch of three bands, and the centroid around it.
    Eigen::Index peak = 0;
    double heaviest = -1.0;
    for (Eigen::Index j = 0; j < row.size(); ++j)
    {
      const Eigen::Index first = std::max<Eigen::Index>(j - 1, 0);
      const double weight = row.segment(first, std::min(j + 2, row.size()) - first).sum();
      if (weight > heaviest)
      {
        heaviest = weight;
        peak = j;
      }
    }
    const Eigen::Index first = std::max<Eigen::Index>(peak - reach, 0);
    const Eigen::Index count = std::min(peak + reach + 1, row.size()) - first;
    const double sum = row.segment(first, count).sum();
    centers[k] = sum > 0.0
      ? row.segment(first, count).dot(Grid.vector().segment(first, count)) / sum
      : Grid[peak];
  }
  return centers;
}

Eigen::MatrixXd ChannelFitProblem::penalty(double center, const PenaltyWeights& weights) const
{
  const double always = Options.nominal ? 1.0 : 0.0;
  const Eigen::ArrayXd distance = (Grid.vector().array() - center) / Options.passbandWidth;
  Eigen::MatrixXd sum = weights.smoothness * Roughness;
  sum.diagonal().array() +=
    weights.locality * (ReferenceStep / *Grid.step()) * (always + distance.square().square());
  return MeanVariance * sum;
}

Eigen::RowVectorXd ChannelFitProblem::prior(
  const ChannelMoments& moments, Eigen::Index channel) const
{
  if (!Options.nominal)
  {
    return Eigen::RowVectorXd::Zero(Grid.size());
  }
  const Eigen::RowVectorXd row = Options.nominal->responsivity().row(channel);
  const double seen = row * moments.covariance * row.transpose();
  const double scale = seen > 0.0 ? row.dot(moments.cross.col(channel)) / seen : 0.0;
  return std::max(scale, 0.0) * row;
}

FittedRows ChannelFitProblem::solve(const ChannelMoments& moments, const Eigen::VectorXd& centers,
  const PenaltyWeights& weights) const
{
  const Eigen::Index channels = moments.cross.cols();
  FittedRows rows;
  rows.responsivity.resize(channels, Grid.size());
  for (Eigen::Index k = 0; k < channels; ++k)
  {
    const Eigen::MatrixXd p = penalty(centers[k], weights);
    const Eigen::MatrixXd h = moments.covariance + p;
    const NonNegativeSolution solution =
      solveNonNegative(h, moments.cross.col(k) + p * prior(moments, k).transpose());
    rows.responsivity.row(k) = solution.x.transpose();
    rows.steps += solution.steps;
    rows.converged = rows.converged && solution.converged;
    std::vector<Eigen::Index> positive;
    for (Eigen::Index j = 0; j < solution.x.size(); ++j)
    {
      if (solution.x[j] > 0.0)
      {
        positive.push_back(j);
      }
    }
    if (!positive.empty())
    {
      const Eigen::MatrixXd free = h(positive, positive);
      const Eigen::MatrixXd data = moments.covariance(positive, positive);
      rows.freedom += free.ldlt().solve(data).trace() / static_cast<double>(channels);
    }
  }
  rows.dark = moments.meanResponse - rows.responsivity * moments.meanReflectance;
  return rows;
}

Eigen::VectorXd ChannelFitProblem::residual(const FittedRows& rows, Eigen::Index sample) const
{
  return Response.col(sample) - rows.responsivity * Reflectance.col(sample) - rows.dark;
}

std::vector<PenaltyWeights> ChannelFitProblem::candidates() const
{
  std::vector<PenaltyWeights> all;
  for (const double locality : { 1e-7, 1e-6, 1e-5, 3e-5, 1e-4, 3e-4, 1e-3, 3e-3, 1e-2, 1e-1 })
  {
    for (const double smoothness : { 0.0, 1e-6, 1e-5, 1e-4, 1e-3 })
    {
      all.push_back({ locality, smoothness });
    }
  }
  return all;
}

} // namespace msi
