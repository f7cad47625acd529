// The methods of estimation: one record each, in one registry.
#pragma once

#include "Kernels/Estimation/MetamerismCorrection.h"
#include "Kernels/Estimation/ReflectanceEstimator.h"
#include "Kernels/Estimation/SampleSet.h"
#include "Kernels/Numerics/FitSummary.h"

#include <memory>
#include <optional>
#include <string_view>
#include <vector>

namespace msi
{

// What a caller may set beside the samples; the defaults suit every method.
struct EstimationOptions
{
  // Structure, rounds, color stop and channel wavelengths: for banded. tuningWeight also for pooled,
  // where 0 stands for 1.
  MetamerismOptions metamerism;
  // For transfer. Off: its standard deviation is optimistic, and the fit takes a fifth of the time. The estimate is the same.
  bool uncertainty = true;
};

// Reflectance = reflectance(metamerism(response)) of the linear methods.
struct LinearFactors
{
  AffineTransform reflectance; // W
  AffineTransform metamerism;  // D, the identity where the method has none
};

struct EstimationFit
{
  std::shared_ptr<const ReflectanceEstimator> estimator; // never null
  FitSummary summary;
  std::optional<LinearFactors> factors; // of a linear method
  std::vector<MetamerismRound> history; // of banded
};

// An immutable record. Adding a method: a file in Methods/, declared in Methods.h and listed in
// EstimationMethod.cpp; tests and the structure check name what else has to know it.
struct EstimationMethod
{
  std::string_view name;        // "kernel-ridge": command line, columns, pages
  std::string_view label;       // "Kernel ridge": menus
  std::string_view description; // one sentence
  // Throws std::invalid_argument where the samples are invalid, their shapes differ, or there are
  // fewer than the method needs.
  EstimationFit (*fit)(
    const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& options);
};

// All methods. The order is part of the interface of saved states: new ones are added at the end.
const std::vector<EstimationMethod>& estimationMethods();

// Throws std::invalid_argument, listing the known names, for any other name.
const EstimationMethod& estimationMethodNamed(std::string_view name);

// The fit of a linear method without metamerism transform.
EstimationFit linearFit(AffineTransform transform, FitSummary summary);

} // namespace msi
