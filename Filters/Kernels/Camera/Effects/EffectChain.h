// A camera model and its effects, ready to run on blocks. What the simulators of tables and of images
// share; internal to them.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraNoise.h"
#include "Kernels/Camera/Effects/BoundEffect.h"
#include "Kernels/Camera/Effects/EffectOperators.h"
#include "Kernels/Estimation/AffineTransform.h"

#include <cstdint>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <vector>

namespace msi
{

class EffectChain
{
public:
  // Errors: as BoundEffect; and std::invalid_argument where the white balance after the effects finds a
  // channel without light.
  EffectChain(CameraModel camera, std::vector<CameraEffect> effects, bool whiteAfterEffects);

  const CameraModel& camera() const noexcept { return Camera; }
  const std::vector<CameraEffect>& effects() const noexcept { return Effects; }
  const Eigen::MatrixXd& responsivity() const noexcept { return Responsivity; }

  // The media that effects act on: ColumnContext::medium counts in this list.
  const std::vector<std::string>& media() const noexcept { return Media; }
  int mediumNumber(const std::string& medium) const noexcept; // -1: no effect acts on it

  bool needsMedium() const noexcept { return !OnReflectance.empty(); }
  bool needsPosition() const noexcept { return NeedsPosition; }
  bool needsOrder() const noexcept { return NeedsOrder; }

  // The effect of this name where it is given and not neutral.
  std::optional<BoundEffect> active(std::string_view name) const;

  // `noise` with the effect excess_noise in it.
  NoiseGenerator noiseGenerator(CameraNoise noise, std::uint64_t seed) const;

  // In this order. A step without effects does nothing.
  template <typename Scalar>
  void reflect(Block<Scalar> reflectance, const ColumnContext& columns) const noexcept
  {
    runAll(OnReflectance, reflectance, columns);
  }
  // The light on the detector without stray light: contiguous N x P in, K x P out.
  template <typename Scalar>
  void integrate(const Scalar* reflectance, Scalar* signal, Eigen::Index count) const noexcept
  {
    Integral.apply(reflectance, signal, count);
  }
  template <typename Scalar>
  void illuminate(Block<Scalar> signal, const ColumnContext& columns) const noexcept
  {
    runAll(OnIrradiance, signal, columns);
  }
  const SurroundOperator* veilingGlare() const noexcept { return VeilingGlare.get(); }
  const SurroundOperator* localStrayLight() const noexcept { return LocalStrayLight.get(); }
  template <typename Scalar>
  void detect(Block<Scalar> signal, const ColumnContext& columns) const noexcept
  {
    runAll(BeforeDark, signal, columns);
    if (!DarkInIntegral)
    {
      signal.array().colwise() += Dark.as<Scalar>();
    }
    runAll(AfterDark, signal, columns);
  }

private:
  using BlockOperators = std::vector<std::unique_ptr<BlockOperator>>;

  template <typename Scalar>
  static void runAll(
    const BlockOperators& operators, Block<Scalar> block, const ColumnContext& columns) noexcept
  {
    for (const auto& step : operators)
    {
      step->apply(block, columns);
    }
  }

  void add(const CameraEffect& effect);
  void balanceWhite();

  CameraModel Camera;
  std::vector<CameraEffect> Effects;
  std::vector<const CameraEffect*> Active;
  std::vector<std::string> Media;
  Eigen::MatrixXd Responsivity;
  BlockOperators OnReflectance;
  BlockOperators OnIrradiance;
  BlockOperators BeforeDark;
  BlockOperators AfterDark;
  std::unique_ptr<SurroundOperator> VeilingGlare;
  std::unique_ptr<SurroundOperator> LocalStrayLight;
  bool NeedsPosition = false;
  bool NeedsOrder = false;
  // Nothing acts between integral and dark response: one sum, as the ideal camera does it.
  bool DarkInIntegral = true;
  AffineTransform Integral =
    AffineTransform::identity(1); // until all effects are in the responsivity
  ChannelValues Dark;
};

} // namespace msi
