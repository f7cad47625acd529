#include "Kernels/Estimation/ReflectanceEstimator.h"

#include "Kernels/Estimation/ExpansionEstimator.h"
#include "Kernels/Estimation/KernelEstimator.h"
#include "Kernels/Estimation/LocalEstimator.h"
#include "Kernels/Estimation/Transfer/TransferEstimator.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <sstream>
#include <stdexcept>
#include <utility>
#include <vector>

namespace msi
{

void ReflectanceEstimator::apply(
  const float* response, float* mean, float* standardDeviation, Eigen::Index pixels) const noexcept
{
  constexpr Eigen::Index piece = 256;
  std::vector<double> in(static_cast<std::size_t>(piece * channels()));
  std::vector<double> out(static_cast<std::size_t>(piece * bands()));
  const bool wantDeviation = standardDeviation != nullptr && knowsUncertainty();
  std::vector<double> deviation(wantDeviation ? out.size() : 0);
  for (Eigen::Index first = 0; first < pixels; first += piece)
  {
    const Eigen::Index count = std::min(piece, pixels - first);
    std::copy_n(response + first * channels(), count * channels(), in.begin());
    apply(in.data(), out.data(), wantDeviation ? deviation.data() : nullptr, count);
    const auto narrow = [](double value) { return static_cast<float>(value); };
    std::transform(out.begin(), out.begin() + count * bands(), mean + first * bands(), narrow);
    if (wantDeviation)
    {
      std::transform(deviation.begin(), deviation.begin() + count * bands(),
        standardDeviation + first * bands(), narrow);
    }
  }
}

void ReflectanceEstimator::requireChannels(const Eigen::MatrixXd& response) const
{
  if (response.rows() != channels())
  {
    reject("the block has ", response.rows(), " values per pixel but the estimator takes ",
      channels(), "; expected the same number");
  }
}

Eigen::MatrixXd ReflectanceEstimator::operator()(const Eigen::MatrixXd& response) const
{
  requireChannels(response);
  Eigen::MatrixXd mean(bands(), response.cols());
  apply(response.data(), mean.data(), nullptr, response.cols());
  return mean;
}

Eigen::MatrixXd ReflectanceEstimator::standardDeviation(const Eigen::MatrixXd& response) const
{
  requireChannels(response);
  if (!knowsUncertainty())
  {
    return {};
  }
  Eigen::MatrixXd mean(bands(), response.cols());
  Eigen::MatrixXd deviation(bands(), response.cols());
  apply(response.data(), mean.data(), deviation.data(), response.cols());
  return deviation;
}

AffineEstimator::AffineEstimator(AffineTransform transform)
  : Transform(std::move(transform))
{
}

NamedMatrices AffineEstimator::parameters() const
{
  return { { "affine.coefficients", Transform.coefficients() } };
}

void AffineEstimator::apply(const double* response, double* mean, double* /*standardDeviation*/,
  Eigen::Index pixels) const noexcept
{
  Transform.apply(response, mean, pixels);
}

void AffineEstimator::apply(const float* response, float* mean, float* /*standardDeviation*/,
  Eigen::Index pixels) const noexcept
{
  Transform.apply(response, mean, pixels);
}

std::shared_ptr<const ReflectanceEstimator> estimatorFrom(const NamedMatrices& parameters)
{
  const auto has = [&](const std::string& name) { return parameters.count(name) != 0; };
  if (has("kernel.points"))
  {
    return std::make_shared<KernelEstimator>(parameters);
  }
  if (has("expansion.coefficients"))
  {
    return std::make_shared<ExpansionEstimator>(parameters);
  }
  if (has("local.points"))
  {
    return std::make_shared<LocalEstimator>(parameters);
  }
  if (parameters.size() == 1 && has("affine.coefficients"))
  {
    return std::make_shared<AffineEstimator>(AffineTransform(parameters.at("affine.coefficients")));
  }
  return std::make_shared<TransferEstimator>(parameters);
}

const Eigen::MatrixXd& requireMatrix(const NamedMatrices& parameters, const std::string& name,
  Eigen::Index rows, Eigen::Index columns, const std::string& owner)
{
  const auto found = parameters.find(name);
  std::ostringstream message;
  if (found == parameters.end())
  {
    message << owner << " has no matrix '" << name << "'";
    throw std::invalid_argument(message.str());
  }
  const Eigen::MatrixXd& matrix = found->second;
  if ((rows != AnySize && matrix.rows() != rows) ||
    (columns != AnySize && matrix.cols() != columns) || matrix.size() == 0)
  {
    const auto size = [](Eigen::Index n) { return n == AnySize ? "any" : std::to_string(n); };
    message << "matrix '" << name << "' of " << owner << " is " << matrix.rows() << " x "
            << matrix.cols() << "; expected " << size(rows) << " x " << size(columns)
            << ", not empty";
    throw std::invalid_argument(message.str());
  }
  if (!matrix.allFinite())
  {
    message << "matrix '" << name << "' of " << owner << " holds a value that is not finite";
    throw std::invalid_argument(message.str());
  }
  return matrix;
}

} // namespace msi
