// Light scattered by a small angle.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/StrayLight.h"
#include "Kernels/Camera/Imaging/ScatterTail.h"

#include <vector>

namespace msi
{

namespace
{
// Weights of the single passes of the tail, of any shape; the form neighbours comes nearest to it where it is put back.
std::vector<ImageTerm> anyTail()
{
  std::vector<ImageTerm> terms;
  terms.reserve(FreePasses);
  for (int i = 0; i < FreePasses; ++i)
  {
    terms.push_back({ surroundWeight(i), false, -0.05, 0.6, 0.01 });
  }
  return terms;
}

ScatterTail makeTail(const BoundEffect& effect)
{
  return ScatterTail(effect.value("radius"));
}
}

Effect localStrayLight()
{
  using P = ImageParameter;
  const EffectParameter tail{ "fraction", "1", 0.0, -0.1, 0.6, 0.01,
    "share of the light in the tail" };
  const EffectParameter radius{ "radius", "pixels", 8.0, 1.0, 64.0, 4.0,
    "reach of the tail, images only", false, true };
  Effect effect;
  effect.definition = { "local_stray_light", "Local stray light",
    "Light scattered by a small angle: the broad tail of the point spread.",
    EffectStage::Irradiance, EffectNeed::Position,
    { { "neighbours",
        "u + fraction (T u - u); T is the mean of the neighbours on a table, the tail on an "
        "image",
        { tail, radius } },
      { "tail",
        "the same with T the mean of all around, weighted exp(-distance / reach), on a table",
        { tail,
          { "reach", "pitches", 1.0, 0.2, 4.0, 0.5,
            "reach of the tail, tables only; a pitch is the distance to the next sample", false,
            true },
          radius } } },
    "patch with black and with white surround", EffectTrait::ActsOnEdges,
    { { "neighbours", { imageTerm(P::TailFraction, tail), imageTerm(P::TailRadius, radius) } },
      { "neighbours", anyTail() } } };
  effect.makeSurround = makeSurroundOperator<StrayLight>;
  effect.surround = Surround::Near;
  effect.onImage.makeTail = makeTail;
  return effect;
}

} // namespace msi
