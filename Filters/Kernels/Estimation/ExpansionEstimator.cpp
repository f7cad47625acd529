#include "Kernels/Estimation/ExpansionEstimator.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <vector>

namespace msi
{

namespace
{
const std::string ExpansionOwner = "the expansion estimator";

Expansion kindOf(const NamedMatrices& parameters)
{
  const double kind = requireMatrix(parameters, "expansion.kind", 1, 1, ExpansionOwner)(0, 0);
  for (const Expansion expansion :
    { Expansion::Linear, Expansion::Squares, Expansion::Products, Expansion::Roots })
  {
    if (kind == static_cast<double>(expansion))
    {
      return expansion;
    }
  }
  throw std::invalid_argument(
    "matrix 'expansion.kind' of " + ExpansionOwner + " holds no known kind; expected 0, 1, 2 or 3");
}

// Keeps NaN, unlike std::max.
double nonNegative(double value) noexcept
{
  return value < 0.0 ? 0.0 : value;
}
}

Eigen::Index expansionTerms(Expansion expansion, Eigen::Index channels) noexcept
{
  switch (expansion)
  {
    case Expansion::Linear:
      return channels;
    case Expansion::Squares:
      return 2 * channels;
    case Expansion::Products:
      return channels + channels * (channels + 1) / 2;
    case Expansion::Roots:
      break;
  }
  return channels + channels * (channels - 1) / 2;
}

void expand(
  Expansion expansion, const double* response, Eigen::Index channels, double* terms) noexcept
{
  terms = std::copy_n(response, channels, terms);
  for (Eigen::Index i = 0; i < channels; ++i)
  {
    const double u = response[i];
    if (expansion == Expansion::Squares)
    {
      *terms++ = u * u;
    }
    else if (expansion == Expansion::Products)
    {
      for (Eigen::Index j = i; j < channels; ++j)
      {
        *terms++ = u * response[j];
      }
    }
    else if (expansion == Expansion::Roots)
    {
      for (Eigen::Index j = i + 1; j < channels; ++j)
      {
        *terms++ = std::sqrt(nonNegative(u) * nonNegative(response[j]));
      }
    }
  }
}

Eigen::MatrixXd expanded(Expansion expansion, const Eigen::MatrixXd& responses)
{
  Eigen::MatrixXd terms(expansionTerms(expansion, responses.rows()), responses.cols());
  for (Eigen::Index i = 0; i < responses.cols(); ++i)
  {
    expand(expansion, responses.col(i).data(), responses.rows(), terms.col(i).data());
  }
  return terms;
}

ExpansionEstimator::ExpansionEstimator(const NamedMatrices& parameters)
  : Kind(kindOf(parameters))
  , Scale(requireMatrix(parameters, "expansion.scale", AnySize, 1, ExpansionOwner))
  , Transform(requireMatrix(parameters, "expansion.coefficients", AnySize,
      expansionTerms(Kind, Scale.size()) + 1, ExpansionOwner))
{
  Parameters = { { "expansion.kind", Eigen::MatrixXd::Constant(1, 1, static_cast<double>(Kind)) },
    { "expansion.scale", Scale }, { "expansion.coefficients", Transform.coefficients() } };
}

void ExpansionEstimator::apply(const double* response, double* mean, double* /*standardDeviation*/,
  Eigen::Index pixels) const noexcept
{
  Eigen::VectorXd scaled(channels());
  std::vector<double> terms(static_cast<std::size_t>(Transform.inputs()));
  for (Eigen::Index pixel = 0; pixel < pixels; ++pixel)
  {
    scaled = Eigen::Map<const Eigen::VectorXd>(response + pixel * channels(), channels());
    scaled = scaled.cwiseProduct(Scale);
    expand(Kind, scaled.data(), channels(), terms.data());
    Transform.apply(terms.data(), mean + pixel * bands(), 1);
  }
}

} // namespace msi
