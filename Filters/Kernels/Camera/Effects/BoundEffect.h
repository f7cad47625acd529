// An effect whose names are resolved and whose parameters are checked. Internal to the simulator.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Camera/CameraModel.h"

#include <Eigen/Core>

#include <string_view>
#include <vector>

namespace msi
{

class BoundEffect
{
public:
  // medium: the number that ColumnContext::medium uses for the effect's medium.
  // Errors: std::invalid_argument for an unknown name or form, a missing or idle medium name, a wrong
  //         number of parameters, or a parameter that is not finite or out of bounds by more than 1 % of
  //         its range (numeric differentiation at a bound steps that far).
  BoundEffect(const CameraEffect& effect, const CameraModel& camera, int medium);

  const EffectDefinition& definition() const noexcept { return *Definition; }
  const EffectForm& form() const noexcept { return *Form; }
  const CameraModel& camera() const noexcept { return *Camera; }
  int medium() const noexcept { return Medium; }
  bool isNeutral() const noexcept { return Neutral; }

  // A parameter by name; a common one repeats for every channel in perChannel(). The name must exist in
  // this form, or the first value of a per-channel parameter is what value() gives.
  double value(std::string_view parameter) const;
  Eigen::ArrayXd perChannel(std::string_view parameter) const;

private:
  std::size_t countOf(const EffectParameter& parameter) const noexcept; // of its values
  Eigen::Map<const Eigen::ArrayXd> valuesOf(std::string_view parameter) const;

  const EffectDefinition* Definition;
  const EffectForm* Form;
  const CameraModel* Camera;
  std::vector<double> Values;
  int Medium;
  bool Neutral;
};

} // namespace msi
