// A blur of each channel.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Imaging/SeparableFilter.h"

#include <cmath>

namespace msi
{

namespace
{
ImageTerm varianceOf(const EffectParameter& deviation)
{
  ImageTerm term = imageTerm(0, deviation);
  for (double* number : { &term.lower, &term.upper, &term.typical })
  {
    *number *= *number;
  }
  term.squared = true;
  return term;
}

// Its step on image pairs: the scene comes blurred.
double blurStep(const double*, const ImagePixel& pixel, double&, double* by)
{
  if (by != nullptr)
  {
    by[0] = pixel.blur;
  }
  return 1.0;
}

double blurVariance(const double* numbers)
{
  return std::fmax(numbers[0], 0.0);
}
}

Effect defocus()
{
  const EffectParameter blur{ "blur", "pixels", 0.0, 0.0, 8.0, 0.5, "standard deviation" };
  Effect effect;
  effect.definition = { "defocus", "Defocus",
    "Each filter moves the focus: the channel's image is convolved with a Gaussian.",
    EffectStage::Image, EffectNeed::Nothing,
    { { "common", "one blur for all channels", { blur } },
      { "per_channel", "a blur for each channel", { blur.ofChannels() } } },
    { "grid target for each filter" }, EffectTrait::ActsOnEdges,
    { { "common", { varianceOf(blur) } }, { "per_channel", { varianceOf(blur.ofChannels()) } } } };
  effect.onImage.makeBlur = [](const BoundEffect& bound)
  { return gaussianKernel(bound.perChannel("blur")); };
  static const ImageStep step{ ImageStage::Scene, { { 0.0, ImageAxis::Edges } }, blurStep, {},
    nullptr, nullptr, blurVariance };
  effect.onImage.steps = { &step };
  return effect;
}

} // namespace msi
