#include "Kernels/Difference/SpectralMetric.h"

#include "Kernels/Difference/SpectralRms.h"

#include <algorithm>

namespace msi
{

const std::vector<SpectralMetric>& spectralMetrics()
{
  static const std::vector<SpectralMetric> metrics{
    { "mae", "mean absolute error", spectralMeanAbsoluteError },
    { "gfc", "goodness-of-fit coefficient", goodnessOfFit },
    { "sam", "spectral angle", spectralAngle },
  };
  return metrics;
}

const SpectralMetric* findSpectralMetric(std::string_view name) noexcept
{
  const auto& metrics = spectralMetrics();
  const auto found = std::find_if(
    metrics.begin(), metrics.end(), [name](const auto& metric) { return metric.name == name; });
  return found == metrics.end() ? nullptr : &*found;
}

} // namespace msi
