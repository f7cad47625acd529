// Light scattered in the lens over the whole field.
#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

namespace
{
EffectParameter glare(bool perChannel)
{
  return { "fraction", "1", 0.0, 0.0, 0.5, 0.01, "share of the scene's mean signal", perChannel };
}

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
  Effect effect;
  effect.definition = { "veiling_glare", "Veiling glare",
    "Light scattered in the lens covers the whole field in proportion to the scene's mean.",
    EffectStage::Irradiance, EffectNeed::Nothing,
    { { "common", "u + fraction (mean of the scene)", { glare(false) } },
      { "conserving", "u + fraction (mean of the scene - u)", { glare(false) } },
      { "per_channel", "u + fraction (mean of the scene), a fraction for each channel",
        { glare(true) } } },
    Captures::BlackTrap, EffectTrait::None,
    { { "common", { imageTerm(GlareOfImage::Added, glare(false)) } },
      { "conserving", { imageTerm(GlareOfImage::Conserving, glare(false)) } },
      { "per_channel", { imageTerm(GlareOfImage::Added, glare(true)) } } } };
  effect.makeStrayLight = [](const BoundEffect& bound)
  { return StrayLight(bound.perChannel("fraction"), bound.form().name != "conserving"); };
  static const ImageStep step{ ImageStage::Light, { {}, {} }, GlareOfImage::cover };
  effect.onImage.step = &step;
  return effect;
}

} // namespace msi
