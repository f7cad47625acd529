// A blur of each channel.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Imaging/SeparableFilter.h"

#include <cmath>

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
  ImageTerm term = imageTerm(0, blur(perChannel));
  for (double* number : { &term.lower, &term.upper, &term.typical })
  {
    *number *= *number;
  }
  term.squared = true;
  return term;
}

// Its step on image pairs.
struct DefocusOfImage
{
  // The scene comes blurred.
  static double blurred(const double*, const ImagePixel& pixel, double&, double* by)
  {
    if (by != nullptr)
    {
      by[0] = pixel.blur;
    }
    return 1.0;
  }

  static double varianceOf(const double* numbers) { return std::fmax(numbers[0], 0.0); }
};

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
    { "grid target for each filter" }, EffectTrait::ActsOnEdges,
    { { "common", { blurVariance(false) } }, { "per_channel", { blurVariance(true) } } } };
  effect.onImage.makeBlur = makeBlur;
  static const ImageStep step{ ImageStage::Scene, { { 0.0, ImageAxis::Edges } },
    DefocusOfImage::blurred, {}, nullptr, nullptr, DefocusOfImage::varianceOf };
  effect.onImage.step = &step;
  return effect;
}

} // namespace msi
