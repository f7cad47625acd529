// An offset that the dark frame did not take away.
#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

namespace
{
class DarkOffset : public BlockOperatorOf<DarkOffset>
{
public:
  explicit DarkOffset(const BoundEffect& effect)
    : Offset(effect.perChannel("offset"))
  {
  }
  template <typename Scalar>
  void run(Block<Scalar> response, const ColumnContext&) const noexcept
  {
    response.array().colwise() += Offset.as<Scalar>();
  }

private:
  ChannelValues Offset;
};

EffectParameter offset(bool perChannel)
{
  return { "offset", "white", 0.0, -0.2, 0.2, 0.005, "dark response beyond the model's",
    perChannel };
}

// Its step on image pairs.
struct DarkOfImage
{
  static double add(const double* numbers, const ImagePixel&, double& signal, double* by)
  {
    if (by != nullptr)
    {
      by[0] = 1.0;
    }
    signal += numbers[0];
    return 1.0;
  }

  static const ImageStep& step()
  {
    static const ImageStep made{ ImageStage::Detector, { { 0.0, ImageAxis::Channel } }, add };
    return made;
  }
};
}

Effect darkOffset()
{
  Effect effect;
  effect.definition = { "dark_offset", "Dark offset",
    "Dark current, bias or ambient light that the dark frame did not take away.",
    EffectStage::Detector, EffectNeed::Nothing,
    { { "common", "u + offset", { offset(false) } },
      { "per_channel", "u_k + offset_k", { offset(true) }, {} } },
    Captures::LensCap, EffectTrait::Exact,
    { { "common", { imageTerm(0, offset(false)) } },
      { "per_channel", { imageTerm(0, offset(true)) } } } };
  effect.makeBlock = makeBlockOperator<DarkOffset>;
  effect.onImage.step = &DarkOfImage::step();
  effect.afterDark = true;
  return effect;
}

} // namespace msi
