#include "Kernels/Gap/UnmodelledPart.h"

#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Numerics/LeastSquares.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr int Folds = 5;

Eigen::VectorXd ridge(const Eigen::MatrixXd& products, const Eigen::VectorXd& scale, double penalty)
{
  const Eigen::Index count = scale.size();
  Eigen::MatrixXd normal = products.topLeftCorner(count, count);
  normal.diagonal() += penalty * scale + Eigen::VectorXd::Constant(count, 1e-12);
  return normal.ldlt().solve(products.col(count).head(count));
}

// These coefficients of its first parameters, within their bounds; K x p.
CameraEffect unmodelledPart(
  const Eigen::MatrixXd& coefficients, const std::vector<std::string>& channels)
{
  const EffectDefinition& definition = effectWith(EffectTrait::Remainder);
  CameraEffect effect = neutralEffect(definition.name, channels);
  for (Eigen::Index n = 0; n < coefficients.cols(); ++n)
  {
    const EffectParameter& parameter =
      definition.forms.front().parameters[static_cast<std::size_t>(n)];
    for (Eigen::Index k = 0; k < coefficients.rows(); ++k)
    {
      effect.parameters[static_cast<std::size_t>(n * coefficients.rows() + k)] =
        std::clamp(coefficients(k, n), parameter.lower, parameter.upper);
    }
  }
  return effect;
}
}

CameraEffect regularPart(const std::vector<std::vector<Eigen::MatrixXd>>& products,
  const std::vector<std::string>& channels)
{
  const auto K = static_cast<Eigen::Index>(channels.size());
  const Eigen::Index count = products.front().front().cols() - 1;
  Eigen::MatrixXd best = Eigen::MatrixXd::Zero(K, count);
  double least = 0.0; // with nothing
  for (double penalty = 1e-4; penalty < 200.0; penalty *= std::sqrt(10.0))
  {
    Eigen::MatrixXd coefficients(K, count);
    double left = 0.0;
    for (Eigen::Index k = 0; k < K; ++k)
    {
      const auto channel = static_cast<std::size_t>(k);
      Eigen::MatrixXd all = Eigen::MatrixXd::Zero(count + 1, count + 1);
      for (const auto& fold : products)
      {
        all += fold[channel];
      }
      const Eigen::VectorXd scale = all.diagonal().head(count);
      for (const auto& fold : products)
      {
        left += energyLeft(fold[channel], ridge(all - fold[channel], scale, penalty)) -
          fold[channel](count, count);
      }
      coefficients.row(k) = ridge(all, scale, penalty).transpose();
    }
    if (left < least)
    {
      least = left;
      best = std::move(coefficients);
    }
  }
  return unmodelledPart(best, channels);
}

Eigen::MatrixXd withRegularPart(
  const GapData& data, const CameraEffect& rest, const Eigen::MatrixXd& predicted)
{
  const BoundEffect bound(rest, data.camera, -1);
  const SampleScene& scene = data.scene;
  Eigen::MatrixXd response = predicted;
  registered(bound.definition())
    .makeBlock(bound)
    ->apply(Block<double>(response),
      { nullptr, scene.fieldX().data(), scene.fieldY().data(), scene.time().data() });
  return response;
}

CameraEffect regularPart(const GapData& data, const Eigen::MatrixXd& predicted,
  const SampleList& training, std::uint64_t seed)
{
  const EffectDefinition& definition = effectWith(EffectTrait::Remainder);
  const auto count = static_cast<Eigen::Index>(definition.forms.front().parameters.size());
  const Eigen::Index channels = data.channels();
  // It is linear in its parameters: a column is what the parameter 1 adds.
  std::vector<Eigen::MatrixXd> columns;
  for (Eigen::Index n = 0; n < count; ++n)
  {
    Eigen::MatrixXd one = Eigen::MatrixXd::Zero(channels, count);
    one.col(n).setOnes();
    columns.push_back(
      withRegularPart(data, unmodelledPart(one, data.camera.channels()), predicted) - predicted);
  }
  columns.push_back(data.observed - predicted);
  const int folds = std::min(Folds, static_cast<int>(training.size()));
  const std::vector<int> fold = foldsOf(data, training, folds, seed);
  std::vector<std::vector<Eigen::MatrixXd>> products(static_cast<std::size_t>(folds),
    std::vector<Eigen::MatrixXd>(
      static_cast<std::size_t>(channels), Eigen::MatrixXd::Zero(count + 1, count + 1)));
  for (const Eigen::Index i : training)
  {
    auto& ofFold = products[static_cast<std::size_t>(fold[static_cast<std::size_t>(i)])];
    Eigen::MatrixXd rows(channels, count + 1);
    for (Eigen::Index n = 0; n <= count; ++n)
    {
      rows.col(n) = columns[static_cast<std::size_t>(n)].col(i);
    }
    for (Eigen::Index k = 0; k < channels; ++k)
    {
      ofFold[static_cast<std::size_t>(k)] +=
        data.weight(k, i) * rows.row(k).transpose() * rows.row(k);
    }
  }
  return regularPart(products, data.camera.channels());
}

} // namespace msi
