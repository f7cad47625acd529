// The measures between spectra that users quote: one record each, in one registry.
#pragma once

#include <Eigen/Core>

#include <string_view>
#include <vector>

namespace msi
{

// An immutable record. The name stands in lists of metrics and heads columns.
struct SpectralMetric
{
  std::string_view name;
  std::string_view label;
  // Per sample; see SpectralRms.h for shapes and errors.
  void (*apply)(const Eigen::Ref<const Eigen::MatrixXd>& measured,
    const Eigen::Ref<const Eigen::MatrixXd>& estimated, Eigen::Ref<Eigen::VectorXd> value) noexcept;
};

// mae (reflectance factor), gfc, sam (radians). New ones are added at the end.
const std::vector<SpectralMetric>& spectralMetrics();

// Null for a name that is not among them.
const SpectralMetric* findSpectralMetric(std::string_view name) noexcept;

} // namespace msi
