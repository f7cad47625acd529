#include "Kernels/Gap/UnmodelledPart.h"

#include "Kernels/Gap/GapAxes.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
Eigen::VectorXd ridge(const Eigen::MatrixXd& products, const Eigen::VectorXd& scale, double penalty)
{
  const Eigen::Index count = scale.size();
  Eigen::MatrixXd normal = products.topLeftCorner(count, count);
  normal.diagonal() += penalty * scale + Eigen::VectorXd::Constant(count, 1e-12);
  return normal.ldlt().solve(products.col(count).head(count));
}
}

Eigen::MatrixXd regularPart(const std::vector<std::vector<Eigen::MatrixXd>>& products)
{
  const auto channels = static_cast<Eigen::Index>(products.front().size());
  const Eigen::Index count = products.front().front().cols() - 1;
  Eigen::MatrixXd best = Eigen::MatrixXd::Zero(channels, count);
  double least = 0.0; // with nothing
  for (double penalty = 1e-4; penalty < 200.0; penalty *= std::sqrt(10.0))
  {
    Eigen::MatrixXd coefficients(channels, count);
    double left = 0.0;
    for (Eigen::Index k = 0; k < channels; ++k)
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
  return best;
}

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

} // namespace msi
