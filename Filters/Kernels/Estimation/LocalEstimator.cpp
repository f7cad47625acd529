#include "Kernels/Estimation/LocalEstimator.h"

#include "Kernels/Spectra/Reject.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <limits>
#include <utility>

namespace msi
{

namespace
{
const std::string LocalOwner = "the local estimator";

LocalSamples readSamples(const NamedMatrices& parameters)
{
  LocalSamples samples;
  samples.points = requireMatrix(parameters, "local.points", AnySize, AnySize, LocalOwner);
  const Eigen::Index channels = samples.points.rows();
  const Eigen::Index count = samples.points.cols();
  samples.scale = requireMatrix(parameters, "local.scale", channels, 1, LocalOwner);
  samples.regressors = requireMatrix(parameters, "local.regressors", channels, count, LocalOwner);
  samples.weights = requireMatrix(parameters, "local.weights", count, 1, LocalOwner);
  samples.reflectance = requireMatrix(parameters, "local.reflectance", AnySize, count, LocalOwner);
  samples.noise = requireMatrix(parameters, "local.noise", channels, 1, LocalOwner);
  const Eigen::MatrixXd& scalars = requireMatrix(parameters, "local.scalars", 2, 1, LocalOwner);
  samples.ridge = scalars(0, 0);
  samples.neighbours = static_cast<Eigen::Index>(scalars(1, 0));
  return samples;
}

// What one pixel after the other is computed in.
struct LocalWorkspace
{
  explicit LocalWorkspace(const LocalSamples& s)
    : distances(s.points.cols())
    , covariance(s.points.rows(), s.points.rows())
  {
  }
  Eigen::VectorXd distances;
  std::vector<Eigen::Index> order;
  Eigen::VectorXd weights;
  Eigen::MatrixXd centered;
  Eigen::MatrixXd covariance;
  Eigen::VectorXd regressorMean;
  Eigen::VectorXd solved;
};

void estimatePixel(const LocalSamples& s, const Eigen::VectorXd& response, Eigen::Index without,
  LocalWorkspace& w, Eigen::VectorXd& mean)
{
  const Eigen::VectorXd scaled = response.cwiseProduct(s.scale);
  if (!scaled.allFinite())
  {
    mean.setConstant(std::numeric_limits<double>::quiet_NaN());
    return;
  }
  w.order.clear();
  for (Eigen::Index j = 0; j < s.points.cols(); ++j)
  {
    w.distances[j] = (s.points.col(j) - scaled).squaredNorm();
    if (j != without)
    {
      w.order.push_back(j);
    }
  }
  const auto nearer = [&](Eigen::Index a, Eigen::Index b)
  { return w.distances[a] != w.distances[b] ? w.distances[a] < w.distances[b] : a < b; };
  const auto available = static_cast<Eigen::Index>(w.order.size());
  const Eigen::Index count = std::min(s.neighbours, available);
  // Sorted, so that sums run in the same order whatever the selection does.
  std::partial_sort(
    w.order.begin(), w.order.begin() + std::min(count + 1, available), w.order.end(), nearer);
  const auto distanceOf = [&](Eigen::Index rank)
  { return std::sqrt(w.distances[w.order[static_cast<std::size_t>(rank)]]); };
  constexpr double JustBeyond = 1.001;
  const double reach =
    std::max(count < available ? distanceOf(count) : 0.0, JustBeyond * distanceOf(count - 1));
  w.weights.resize(count);
  double total = 0.0;
  for (Eigen::Index i = 0; i < count; ++i)
  {
    const double share = reach > 0.0 ? distanceOf(i) / reach : 0.0;
    const double kept = 1.0 - share * share * share;
    w.weights[i] = s.weights[w.order[static_cast<std::size_t>(i)]] * kept * kept * kept;
    total += w.weights[i];
  }
  w.weights /= total;

  const auto sampleOf = [&](Eigen::Index i) { return w.order[static_cast<std::size_t>(i)]; };
  w.regressorMean.setZero(s.points.rows());
  for (Eigen::Index i = 0; i < count; ++i)
  {
    w.regressorMean += w.weights[i] * s.regressors.col(sampleOf(i));
  }
  w.centered.resize(s.points.rows(), count);
  w.covariance.setZero();
  for (Eigen::Index i = 0; i < count; ++i)
  {
    w.centered.col(i) = s.regressors.col(sampleOf(i)) - w.regressorMean;
    w.covariance.selfadjointView<Eigen::Lower>().rankUpdate(w.centered.col(i), w.weights[i]);
  }
  constexpr double LeastVariance = 1e-30;
  const double added = s.ridge * w.covariance.trace() / static_cast<double>(s.points.rows());
  w.covariance.diagonal() += s.noise;
  w.covariance.diagonal().array() += added + LeastVariance;
  w.solved = w.covariance.selfadjointView<Eigen::Lower>().ldlt().solve(response - w.regressorMean);
  mean.setZero();
  for (Eigen::Index i = 0; i < count; ++i)
  {
    mean += w.weights[i] * (1.0 + w.centered.col(i).dot(w.solved)) * s.reflectance.col(sampleOf(i));
  }
}
}

LocalEstimator::LocalEstimator(LocalSamples samples)
  : Samples(std::move(samples))
{
  if (Samples.neighbours < 1 || Samples.neighbours > Samples.points.cols())
  {
    reject(LocalOwner, " is to use ", Samples.neighbours, " neighbours of ", Samples.points.cols(),
      " samples; expected a number from 1 to ", Samples.points.cols());
  }
}

LocalEstimator::LocalEstimator(const NamedMatrices& parameters)
  : LocalEstimator(readSamples(parameters))
{
}

NamedMatrices LocalEstimator::parameters() const
{
  return { { "local.scale", Samples.scale }, { "local.points", Samples.points },
    { "local.regressors", Samples.regressors }, { "local.weights", Samples.weights },
    { "local.reflectance", Samples.reflectance }, { "local.noise", Samples.noise },
    { "local.scalars", Eigen::Vector2d(Samples.ridge, static_cast<double>(Samples.neighbours)) } };
}

void LocalEstimator::apply(const double* response, double* mean, double* /*standardDeviation*/,
  Eigen::Index pixels) const noexcept
{
  LocalWorkspace workspace(Samples);
  Eigen::VectorXd one(channels());
  Eigen::VectorXd result(bands());
  for (Eigen::Index pixel = 0; pixel < pixels; ++pixel)
  {
    one = Eigen::Map<const Eigen::VectorXd>(response + pixel * channels(), channels());
    estimatePixel(Samples, one, -1, workspace, result);
    Eigen::Map<Eigen::VectorXd>(mean + pixel * bands(), bands()) = result;
  }
}

Eigen::VectorXd localEstimate(
  const LocalSamples& samples, const Eigen::VectorXd& response, Eigen::Index withoutSample)
{
  LocalWorkspace workspace(samples);
  Eigen::VectorXd result(samples.reflectance.rows());
  estimatePixel(samples, response, withoutSample, workspace, result);
  return result;
}

} // namespace msi
