// Light scattered in the lens over the whole field.
#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

namespace
{
// Its step on image pairs.
struct GlareOfImage
{
  enum Number : std::size_t
  {
    Added,
    Conserving
  };

  static double cover(const double* numbers, const ImagePixel& pixel, double& signal, double* by)
  {
    if (by != nullptr)
    {
      by[Added] = pixel.mean;
      by[Conserving] = pixel.mean - signal;
    }
    signal =
      (1.0 - numbers[Conserving]) * signal + (numbers[Added] + numbers[Conserving]) * pixel.mean;
    return 1.0 - numbers[Conserving];
  }
};
}

Effect veilingGlare()
{
  const EffectParameter fraction{ "fraction", "1", 0.0, 0.0, 0.5, 0.01,
    "share of the scene's mean signal" };
  Effect effect;
  effect.definition = { "veiling_glare", "Veiling glare",
    "Light scattered in the lens covers the whole field in proportion to the scene's mean.",
    EffectStage::Irradiance, EffectNeed::Nothing,
    { { "common", "u + fraction (mean of the scene)", { fraction } },
      { "conserving", "u + fraction (mean of the scene - u)", { fraction } },
      { "per_channel", "u + fraction (mean of the scene), a fraction for each channel",
        { fraction.ofChannels() } } },
    Captures::BlackTrap, EffectTrait::None,
    { { "common", { imageTerm(GlareOfImage::Added, fraction) } },
      { "conserving", { imageTerm(GlareOfImage::Conserving, fraction) } },
      { "per_channel", { imageTerm(GlareOfImage::Added, fraction.ofChannels()) } } } };
  effect.makeStrayLight = [](const BoundEffect& bound)
  { return StrayLight(bound.perChannel("fraction"), bound.form().name != "conserving"); };
  static const ImageStep step{ ImageStage::Light, { {}, {} }, GlareOfImage::cover };
  effect.onImage.steps = { &step };
  return effect;
}

} // namespace msi
