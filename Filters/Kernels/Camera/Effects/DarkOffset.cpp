// An offset that the dark frame did not take away.
#include "Kernels/Camera/Effects/Effect.h"

#include <memory>

namespace msi
{

namespace
{
std::unique_ptr<BlockOperator> makeOffset(const BoundEffect& effect)
{
  const ChannelValues offsets(effect.perChannel("offset"));
  if (!effect.form().has(FormTrait::OfField))
  {
    return onAll([](auto u, const auto& offset) { u.colwise() += offset; }, offsets);
  }
  return blockOperator(
    [offsets, alongX = ChannelValues(effect.perChannel("along_x")),
      alongY = ChannelValues(effect.perChannel("along_y"))](
      auto response, const ColumnContext& columns)
    {
      using Scalar = typename decltype(response)::Scalar;
      response.array().colwise() += offsets.as<Scalar>();
      for (Eigen::Index j = 0; j < response.cols(); ++j)
      {
        response.col(j).array() += static_cast<Scalar>(columns.fieldX[j]) * alongX.as<Scalar>() +
          static_cast<Scalar>(columns.fieldY[j]) * alongY.as<Scalar>();
      }
    });
}

// Its step on image pairs.
double darkStep(const double* numbers, const ImagePixel& pixel, double& signal, double* by)
{
  if (by != nullptr)
  {
    by[0] = 1.0;
    by[1] = pixel.x;
    by[2] = pixel.y;
  }
  signal += numbers[0] + numbers[1] * pixel.x + numbers[2] * pixel.y;
  return 1.0;
}
}

Effect darkOffset()
{
  const auto along = [](const char* name, const char* meaning) {
    return EffectParameter{ name, "white", 0.0, -0.2, 0.2, 0.005, meaning }.ofLight();
  };
  const EffectParameter offset{ "offset", "white", 0.0, -0.2, 0.2, 0.005,
    "dark response beyond the model's" };
  const EffectParameter everywhere = offset.ofLight();
  const EffectParameter alongX = along("along_x", "more of it from the middle to the edge in x");
  const EffectParameter alongY = along("along_y", "more of it from the middle to the edge in y");
  Effect effect;
  effect.definition = { "dark_offset", "Dark offset",
    "Dark current, bias or ambient light that the dark frame did not take away.",
    EffectStage::Detector, EffectNeed::Nothing,
    { { "common", "u + offset", { offset } },
      { "per_channel", "u_k + offset_k", { offset.ofChannels() }, {}, FormTrait::Adds },
      { "plane",
        "u_k + offset_k + along_x_k x + along_y_k y: light that does not come from the scene, more "
        "of it on one side",
        { everywhere, alongX, alongY }, {}, FormTrait::OfField } },
    Captures::LensCap, EffectTrait::Exact,
    { { "common", { imageTerm(0, offset) } },
      { "per_channel", { imageTerm(0, offset.ofChannels()) } },
      { "plane", { imageTerm(0, everywhere), imageTerm(1, alongX), imageTerm(2, alongY) } } } };
  effect.makeBlock = makeOffset;
  static const ImageStep step{ ImageStage::Detector,
    { { 0.0, ImageAxis::Channel }, { 0.0, ImageAxis::Position }, { 0.0, ImageAxis::Position } },
    darkStep };
  effect.onImage.steps = { &step };
  effect.afterDark = true;
  return effect;
}

} // namespace msi
