#include "Kernels/Estimation/Transfer/TransferEstimator.h"

#include "Kernels/Estimation/Transfer/ReducedTransfer.h"
#include "Kernels/Estimation/Transfer/TransferBlocks.h"
#include "Kernels/Spectra/Reject.h"

#include <array>
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

const Eigen::MatrixXd& require(
  const NamedMatrices& parameters, const std::string& name, Eigen::Index rows, Eigen::Index columns)
{
  return requireMatrix(parameters, name, rows, columns, "the transfer estimator");
}

// Adds an expert of the mixture with its shares.
void readExpert(const NamedMatrices& parameters, TransferSpace space, Eigen::Index bands,
  TransferMixture& mixture)
{
  const std::string prefix = prefixOf(space);
  const Eigen::MatrixXd& points = require(parameters, prefix + "points", AnySize, AnySize);
  const Eigen::Index channels = points.rows();
  const Eigen::Index count = points.cols();
  const Eigen::MatrixXd& scalars = require(parameters, prefix + "scalars", 7, 1);
  const Eigen::MatrixXd& perChannel = require(parameters, prefix + "channels", channels, 3);
  for (const Eigen::Index scale : { 2, 3, 4 })
  {
    if (!(scalars(scale) > 0.0))
    {
      reject("element ", scale + 1, " of matrix '", prefix,
        "scalars' of the transfer estimator is ", scalars(scale), "; expected a positive number");
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
  mixture.experts.push_back(std::move(expert));
  mixture.meanShares.push_back(scalars(0));
  mixture.varianceShares.push_back(scalars(1));
}

TransferMixture readMixture(const NamedMatrices& parameters)
{
  const Eigen::MatrixXd& variance = require(parameters, "bandVariance", AnySize, 1);
  if (variance.minCoeff() < 0.0)
  {
    throw std::invalid_argument(
      "matrix 'bandVariance' of the transfer estimator holds a negative variance");
  }
  TransferMixture mixture;
  for (const TransferSpace space : Spaces)
  {
    readExpert(parameters, space, variance.size(), mixture);
    if (mixture.experts.back().points.rows() != mixture.experts.front().points.rows())
    {
      reject("the experts of the transfer estimator take ", mixture.experts.front().points.rows(),
        " and ", mixture.experts.back().points.rows(), " channels; expected the same number");
    }
  }
  mixture.affine = require(
    parameters, "affine.coefficients", variance.size(), mixture.experts.front().points.rows() + 1);
  mixture.affineShare = require(parameters, "affine.share", 1, 1)(0, 0);
  mixture.bandVariance = variance;
  return mixture;
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
  explicit Implementation(const NamedMatrices& parameters)
    : Mixture(readMixture(parameters))
    , Packed(Mixture)
    , Parameters(knownParameters(parameters))
  {
  }

  // Made when the first float block comes: tables never need it. Where several blocks come at once,
  // each may make it; all make the same.
  std::shared_ptr<const ReducedTransfer> reduced() const
  {
    auto known = std::atomic_load(&Reduced);
    if (!known)
    {
      known =
        std::make_shared<const ReducedTransfer>(reduceTransfer(Mixture, TransferFloatTolerance));
      std::atomic_store(&Reduced, known);
    }
    return known;
  }

  TransferMixture Mixture;
  PackedTransfer Packed;
  NamedMatrices Parameters;

private:
  mutable std::shared_ptr<const ReducedTransfer> Reduced;
};

TransferEstimator::TransferEstimator(const NamedMatrices& parameters)
  : Impl(std::make_shared<const Implementation>(parameters))
{
}

NamedMatrices TransferEstimator::parameters() const
{
  return Impl->Parameters;
}

Eigen::Index TransferEstimator::bands() const noexcept
{
  return Impl->Packed.experts.front().bands;
}

Eigen::Index TransferEstimator::channels() const noexcept
{
  return Impl->Packed.experts.front().channels;
}

void TransferEstimator::apply(const double* response, double* mean, double* standardDeviation,
  Eigen::Index pixels) const noexcept
{
  runTransfer(Impl->Packed, response, mean, standardDeviation, pixels);
}

void TransferEstimator::apply(
  const float* response, float* mean, float* standardDeviation, Eigen::Index pixels) const noexcept
{
  if (standardDeviation != nullptr)
  {
    ReflectanceEstimator::apply(response, mean, standardDeviation, pixels);
  }
  runReducedTransfer(*Impl->reduced(), response, mean, pixels);
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
