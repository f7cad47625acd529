// A part of the exposure before, added to the next or taken from one to the next.
#include "Kernels/Camera/Effects/Effect.h"

namespace msi
{

namespace
{
PixelOperator makeLag(const BoundEffect& effect)
{
  const auto retained = static_cast<float>(effect.value("retained"));
  const bool conserving = effect.form().name == "conserving";
  return [retained, conserving](Eigen::Map<Eigen::MatrixXf> run, int, int)
  {
    for (Eigen::Index j = 0; j < run.cols(); ++j)
    {
      for (Eigen::Index k = run.rows() - 1; k > 0; --k)
      {
        run(k, j) += retained * (run(k - 1, j) - (conserving ? run(k, j) : 0.0F));
      }
    }
  };
}

// Its step on image pairs: a number for each form.
double lagStep(const double* numbers, const ImagePixel& pixel, double& signal, double* by)
{
  if (pixel.previous == nullptr)
  {
    return 1.0;
  }
  const double more = *pixel.previous - pixel.self;
  if (by != nullptr)
  {
    by[0] = *pixel.previous;
    by[1] = more;
  }
  signal += numbers[0] * *pixel.previous + numbers[1] * more;
  return 1.0;
}
}

Effect lag()
{
  const EffectParameter retained{ "retained", "1", 0.0, 0.0, 0.3, 0.01,
    "share of the exposure before" };
  Effect effect;
  effect.definition = { "lag", "Lag",
    "A detector keeps a part of the exposure before: that of the channel before.",
    EffectStage::Image, EffectNeed::Nothing,
    { { "common", "u_k + retained u_k-1", { retained } },
      { "conserving", "u_k + retained (u_k-1 - u_k), the first channel as it is", { retained } } },
    { "channels captured in another order" }, EffectTrait::None,
    { { "common", { imageTerm(0, retained) } }, { "conserving", { imageTerm(1, retained) } } } };
  effect.onImage.makePixels = makeLag;
  static const ImageStep step{ ImageStage::Exposure, { {}, {} }, lagStep };
  effect.onImage.steps = { &step };
  return effect;
}

} // namespace msi
