#include "Kernels/Estimation/TransferEstimator.h"

#include "Kernels/Estimation/TransferBlocks.h"

#include <algorithm>
#include <array>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
constexpr std::array<TransferSpace, 2> Spaces{ TransferSpace::Linear, TransferSpace::SquareRoot };

std::string prefixOf(TransferSpace space)
{
  return space == TransferSpace::Linear ? "linear." : "squareRoot.";
}

constexpr Eigen::Index Any = -1;

// The matrix of that name; a given size must agree.
const Eigen::MatrixXd& require(
  const NamedMatrices& parameters, const std::string& name, Eigen::Index rows, Eigen::Index columns)
{
  const auto found = parameters.find(name);
  std::ostringstream message;
  if (found == parameters.end())
  {
    message << "the transfer estimator has no matrix '" << name << "'";
    throw std::invalid_argument(message.str());
  }
  const Eigen::MatrixXd& matrix = found->second;
  if ((rows != Any && matrix.rows() != rows) || (columns != Any && matrix.cols() != columns) ||
    matrix.size() == 0)
  {
    const auto size = [](Eigen::Index n) { return n == Any ? "any" : std::to_string(n); };
    message << "matrix '" << name << "' of the transfer estimator is " << matrix.rows() << " x "
            << matrix.cols() << "; expected " << size(rows) << " x " << size(columns)
            << ", not empty";
    throw std::invalid_argument(message.str());
  }
  if (!matrix.allFinite())
  {
    message << "matrix '" << name << "' of the transfer estimator holds a value that is not finite";
    throw std::invalid_argument(message.str());
  }
  return matrix;
}

PackedTransferExpert readExpert(
  const NamedMatrices& parameters, TransferSpace space, Eigen::Index bands)
{
  const std::string prefix = prefixOf(space);
  const Eigen::MatrixXd& points = require(parameters, prefix + "points", Any, Any);
  const Eigen::Index channels = points.rows();
  const Eigen::Index count = points.cols();
  const Eigen::MatrixXd& scalars = require(parameters, prefix + "scalars", 7, 1);
  const Eigen::MatrixXd& perChannel = require(parameters, prefix + "channels", channels, 3);
  for (const Eigen::Index scale : { 2, 3, 4 })
  {
    if (!(scalars(scale) > 0.0))
    {
      std::ostringstream message;
      message << "element " << scale + 1 << " of matrix '" << prefix
              << "scalars' of the transfer estimator is " << scalars(scale)
              << "; expected a positive number";
      throw std::invalid_argument(message.str());
    }
  }
  TransferExpert expert;
  expert.features.space = space;
  expert.features.responseScale = scalars(2);
  expert.features.scale = scalars(3);
  expert.features.logGain = perChannel.col(0);
  expert.features.offset = perChannel.col(1);
  expert.features.center = perChannel.col(2);
  expert.points = points;
  expert.weights = require(parameters, prefix + "weights", 3, count);
  expert.length = scalars(4);
  expert.priorConstant = scalars(5);
  expert.priorLinear = scalars(6);
  expert.coefficients = require(parameters, prefix + "coefficients", count, bands);
  expert.center = require(parameters, prefix + "center", bands, 1);
  expert.reduction = require(parameters, prefix + "reduction", count, count);
  return { expert, scalars(0), scalars(1) };
}

PackedTransfer readMixture(const NamedMatrices& parameters)
{
  const Eigen::MatrixXd& variance = require(parameters, "bandVariance", Any, 1);
  if (variance.minCoeff() < 0.0)
  {
    throw std::invalid_argument(
      "matrix 'bandVariance' of the transfer estimator holds a negative variance");
  }
  const Eigen::Index bands = variance.size();
  std::vector<PackedTransferExpert> experts;
  for (const TransferSpace space : Spaces)
  {
    experts.push_back(readExpert(parameters, space, bands));
    if (experts.back().channels != experts.front().channels)
    {
      std::ostringstream message;
      message << "the experts of the transfer estimator take " << experts.front().channels
              << " and " << experts.back().channels << " channels; expected the same number";
      throw std::invalid_argument(message.str());
    }
  }
  const PackedAffineExpert affine(
    require(parameters, "affine.coefficients", bands, experts.front().channels + 1),
    require(parameters, "affine.share", 1, 1)(0, 0));
  return { std::move(experts), affine,
    std::vector<double>(variance.data(), variance.data() + bands) };
}

// What readMixture has read.
NamedMatrices knownParameters(const NamedMatrices& parameters)
{
  NamedMatrices known;
  for (const auto& [name, matrix] : parameters)
  {
    const auto startsWith = [&name = name](const std::string& prefix)
    { return name.compare(0, prefix.size(), prefix) == 0; };
    if (name == "bandVariance" || startsWith("affine.") ||
      startsWith(prefixOf(TransferSpace::Linear)) ||
      startsWith(prefixOf(TransferSpace::SquareRoot)))
    {
      known[name] = matrix;
    }
  }
  return known;
}
}

struct TransferEstimator::Implementation
{
  PackedTransfer Mixture;
  NamedMatrices Parameters;
};

TransferEstimator::TransferEstimator(const NamedMatrices& parameters)
  : Impl(std::make_shared<const Implementation>(
      Implementation{ readMixture(parameters), knownParameters(parameters) }))
{
}

NamedMatrices TransferEstimator::parameters() const
{
  return Impl->Parameters;
}

Eigen::Index TransferEstimator::bands() const noexcept
{
  return Impl->Mixture.experts.front().bands;
}

Eigen::Index TransferEstimator::channels() const noexcept
{
  return Impl->Mixture.experts.front().channels;
}

void TransferEstimator::apply(const double* response, double* mean, double* standardDeviation,
  Eigen::Index pixels) const noexcept
{
  runTransfer(Impl->Mixture, response, mean, standardDeviation, pixels);
}

void TransferEstimator::apply(
  const float* response, float* mean, float* standardDeviation, Eigen::Index pixels) const noexcept
{
  constexpr Eigen::Index piece = 256;
  std::vector<double> in(static_cast<std::size_t>(piece * channels()));
  std::vector<double> out(static_cast<std::size_t>(piece * bands()));
  std::vector<double> deviation(standardDeviation != nullptr ? out.size() : 0);
  for (Eigen::Index first = 0; first < pixels; first += piece)
  {
    const Eigen::Index count = std::min(piece, pixels - first);
    std::copy_n(response + first * channels(), count * channels(), in.begin());
    apply(in.data(), out.data(), standardDeviation != nullptr ? deviation.data() : nullptr, count);
    const auto narrow = [](double value) { return static_cast<float>(value); };
    std::transform(out.begin(), out.begin() + count * bands(), mean + first * bands(), narrow);
    if (standardDeviation != nullptr)
    {
      std::transform(deviation.begin(), deviation.begin() + count * bands(),
        standardDeviation + first * bands(), narrow);
    }
  }
}

void TransferEstimator::requireChannels(const Eigen::MatrixXd& response) const
{
  if (response.rows() != channels())
  {
    std::ostringstream message;
    message << "the block has " << response.rows()
            << " values a pixel but the transfer estimator takes " << channels()
            << "; expected the same number";
    throw std::invalid_argument(message.str());
  }
}

Eigen::MatrixXd TransferEstimator::operator()(const Eigen::MatrixXd& response) const
{
  requireChannels(response);
  Eigen::MatrixXd mean(bands(), response.cols());
  apply(response.data(), mean.data(), nullptr, response.cols());
  return mean;
}

Eigen::MatrixXd TransferEstimator::standardDeviation(const Eigen::MatrixXd& response) const
{
  requireChannels(response);
  Eigen::MatrixXd mean(bands(), response.cols());
  Eigen::MatrixXd deviation(bands(), response.cols());
  apply(response.data(), mean.data(), deviation.data(), response.cols());
  return deviation;
}

NamedMatrices transferParameters(const TransferMixture& mixture)
{
  NamedMatrices parameters;
  parameters["bandVariance"] = mixture.bandVariance;
  parameters["affine.coefficients"] = mixture.affine;
  parameters["affine.share"] = Eigen::MatrixXd::Constant(1, 1, mixture.affineShare);
  for (std::size_t i = 0; i < mixture.experts.size(); ++i)
  {
    const TransferExpert& expert = mixture.experts[i];
    const TransferFeatures& features = expert.features;
    const std::string prefix = prefixOf(features.space);
    Eigen::MatrixXd channels(features.center.size(), 3);
    channels << features.logGain, features.offset, features.center;
    Eigen::VectorXd scalars(7);
    scalars << mixture.meanShares[i], mixture.varianceShares[i], features.responseScale,
      features.scale, expert.length, expert.priorConstant, expert.priorLinear;
    parameters[prefix + "scalars"] = scalars;
    parameters[prefix + "channels"] = channels;
    parameters[prefix + "points"] = expert.points;
    parameters[prefix + "weights"] = expert.weights;
    parameters[prefix + "coefficients"] = expert.coefficients;
    parameters[prefix + "center"] = expert.center;
    parameters[prefix + "reduction"] = expert.reduction;
  }
  return parameters;
}

} // namespace msi
