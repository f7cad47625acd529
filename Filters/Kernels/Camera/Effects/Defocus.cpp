// A blur of each channel.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Imaging/SeparableFilter.h"

namespace msi
{

namespace
{
EffectParameter blur(bool perChannel)
{
  return { "blur", "pixels", 0.0, 0.0, 8.0, 0.5, "standard deviation", perChannel };
}

ImageTerm blurVariance(bool perChannel)
{
  ImageTerm term = imageTerm(ImageParameter::BlurVariance, blur(perChannel));
  for (double* number : { &term.lower, &term.upper, &term.typical })
  {
    *number *= *number;
  }
  term.scale = ImageScale::Squared;
  return term;
}

SymmetricKernel makeBlur(const BoundEffect& effect)
{
  return gaussianKernel(effect.perChannel("blur"));
}
}

Effect defocus()
{
  Effect effect;
  effect.definition = { "defocus", "Defocus",
    "Each filter moves the focus: the channel's image is convolved with a Gaussian.",
    EffectStage::Image, EffectNeed::Nothing,
    { { "common", "one blur for all channels", { blur(false) } },
      { "per_channel", "a blur for each channel", { blur(true) } } },
    "grid target for each filter", EffectTrait::ActsOnEdges,
    { { "common", { blurVariance(false) } }, { "per_channel", { blurVariance(true) } } } };
  effect.onImage.makeBlur = makeBlur;
  return effect;
}

} // namespace msi
