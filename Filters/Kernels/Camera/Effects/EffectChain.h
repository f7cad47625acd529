// A camera model and its effects, ready to run on blocks. What the simulators of tables and of images
// share; internal to them.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/CameraNoise.h"
#include "Kernels/Camera/Effects/BoundEffect.h"
#include "Kernels/Camera/Effects/EffectOperators.h"
#include "Kernels/Numerics/AffineTransform.h"

#include <cstdint>
#include <memory>
#include <string>
#include <vector>

namespace msi
{

class EffectChain
{
public:
  // Errors: as BoundEffect; and std::invalid_argument where the white balance after the effects finds a
  // channel without light.
  EffectChain(CameraModel camera, std::vector<CameraEffect> effects, bool whiteAfterEffects);
  // The same camera with other effects: shares with `related` the operators of the effects that both have, and what
  // follows from those alone.
  EffectChain(
    const EffectChain& related, std::vector<CameraEffect> effects, bool whiteAfterEffects);

  const CameraModel& camera() const noexcept { return *Camera; }
  const Eigen::MatrixXd& responsivity() const noexcept { return *Responsivity; }

  // The media that effects act on: ColumnContext::medium counts in this list.
  const std::vector<std::string>& media() const noexcept { return Media; }
  int mediumNumber(const std::string& medium) const noexcept; // -1: no effect acts on it

  bool needsMedium() const noexcept { return !OnReflectance.empty(); }
  bool needsPosition() const noexcept { return NeedsPosition; }
  bool needsOrder() const noexcept { return NeedsOrder; }

  // The effects that are not neutral, in the order in which they act.
  std::vector<BoundEffect> active() const;

  // `noise` with the effects on it.
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
    Integral->apply(reflectance, signal, count);
  }
  template <typename Scalar>
  void illuminate(Block<Scalar> signal, const ColumnContext& columns) const noexcept
  {
    runAll(OnIrradiance, signal, columns);
  }
  const StrayLight* veilingGlare() const noexcept { return VeilingGlare.get(); }
  const StrayLight* localStrayLight() const noexcept { return LocalStrayLight.get(); }
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

  bool illuminates() const noexcept // does anything between integral and detector
  {
    return !OnIrradiance.empty() || VeilingGlare || LocalStrayLight;
  }
  bool detects() const noexcept
  {
    return !BeforeDark.empty() || !DarkInIntegral || !AfterDark.empty();
  }

  // Of a chain and one related to it; true: it shares the operators, so its steps give the same bits.
  std::vector<int> mediaReflectedOtherwise(const EffectChain& related) const;
  bool integratesLike(const EffectChain& related) const noexcept;
  bool illuminatesLike(const EffectChain& related) const noexcept; // stray light and glare, too
  bool detectsLike(const EffectChain& related) const noexcept;

private:
  template <typename Operator>
  using Shared = std::shared_ptr<const Operator>;
  using BlockOperators = std::vector<Shared<BlockOperator>>;

  // One of the effects; without any operator where it is neutral, or where the simulators treat it themselves.
  struct Step
  {
    std::size_t effect; // in Effects
    BoundEffect bound;
    Shared<ResponsivityOperator> onResponsivity;
    Shared<BlockOperator> onBlock;
    Shared<StrayLight> strayLight;
  };

  template <typename Scalar>
  static void runAll(
    const BlockOperators& operators, Block<Scalar> block, const ColumnContext& columns) noexcept
  {
    for (const auto& step : operators)
    {
      step->apply(block, columns);
    }
  }

  void build(const EffectChain* related);
  Step bind(std::size_t effect);
  const Step* stepLike(const CameraEffect& effect) const noexcept; // nullptr: there is none
  void requireOnce() const;
  void place(const Step& step);
  void balanceWhite(Eigen::MatrixXd& responsivity) const;

  Shared<CameraModel> Camera;
  std::vector<CameraEffect> Effects;
  bool WhiteAfterEffects;
  std::vector<std::string> Media;
  std::vector<Step> Steps; // in the order of the library
  BlockOperators OnReflectance;
  std::vector<Shared<ResponsivityOperator>> OnResponsivity;
  BlockOperators OnIrradiance;
  BlockOperators BeforeDark;
  BlockOperators AfterDark;
  Shared<StrayLight> VeilingGlare;
  Shared<StrayLight> LocalStrayLight;
  bool NeedsPosition = false;
  bool NeedsOrder = false;
  // Nothing acts between integral and dark response: one sum, as the ideal camera does it.
  bool DarkInIntegral = true;
  Shared<Eigen::MatrixXd> Responsivity;
  Shared<AffineTransform> Integral;
  ChannelValues Dark;
};

} // namespace msi
