// The end of the detector's range.
#include "Kernels/Camera/Effects/DetectorKernel.h"
#include "Kernels/Camera/Effects/Effect.h"

#include <cmath>
#include <cstddef>
#include <memory>

namespace msi
{

namespace
{
// The lower branch of a hyperbola around the corner of min(u, level).
double rounded(double u, double level, double softness) noexcept
{
  const double beyond = u - level;
  return 0.5 * (u + level - std::sqrt(beyond * beyond + softness * softness));
}

struct SoftSaturation
{
  double level;
  double softness;

  void operator()(Block<double> response, const ColumnContext&) const noexcept
  {
    // One value at a time: Eigen's packets of sqrt() and their remainders round differently.
    response = response.unaryExpr([this](double u) { return rounded(u, level, softness); });
  }
  void operator()(Block<float> response, const ColumnContext&) const noexcept
  {
    forRuns(response,
      [this](float* values, std::size_t count) {
        saturate(static_cast<float>(level), static_cast<float>(softness * softness), values, count);
      });
  }
};

// The p-norm of both.
struct GradualSaturation
{
  double level;
  double sharpness;

  void operator()(Block<double> response, const ColumnContext&) const noexcept
  {
    forRuns(response,
      [this](double* values, std::size_t count)
      { saturateGradually(level, sharpness, values, count); });
  }
  void operator()(Block<float> response, const ColumnContext&) const noexcept
  {
    response = response.unaryExpr(
      [bend = static_cast<float>(level), p = static_cast<float>(sharpness)](float u)
      {
        const float over = u > 0.0F ? std::pow(u / bend, p) : 0.0F;
        return u / std::pow(1.0F + over, 1.0F / p);
      });
  }
};

std::unique_ptr<BlockOperator> makeSaturation(const BoundEffect& effect)
{
  if (effect.form().name == "gradual")
  {
    return blockOperator(GradualSaturation{ effect.value("level"), effect.value("sharpness") });
  }
  const double softness = effect.value("softness");
  if (effect.form().name == "soft")
  {
    return blockOperator(SoftSaturation{ effect.value("level"), softness });
  }
  return blockOperator(
    [softness, levels = effect.perChannel("level")](auto response, const ColumnContext&)
    {
      using Scalar = typename decltype(response)::Scalar;
      for (Eigen::Index j = 0; j < response.cols(); ++j)
      {
        for (Eigen::Index k = 0; k < response.rows(); ++k)
        {
          const auto u = static_cast<double>(response(k, j));
          response(k, j) = static_cast<Scalar>(rounded(u, levels[k], softness));
        }
      }
    });
}

// Its step on image pairs.
struct ClippingOfImage
{
  enum Number : std::size_t
  {
    Clip, // 1: a rounded min(u, level); parts of it only on the way there
    ClipLevel
  };

  static constexpr double NeutralLevel = 8.0;
  static constexpr double ClipSoftness = 0.01;

  static double clip(const double* numbers, const ImagePixel&, double& signal, double* by)
  {
    const double beyond = signal - numbers[ClipLevel];
    const double root = std::sqrt(beyond * beyond + ClipSoftness * ClipSoftness);
    const double lost = 0.5 * (beyond + root);
    const double byLevel = 0.5 * numbers[Clip] * (1.0 + beyond / root);
    if (by != nullptr)
    {
      by[Clip] = -lost;
      by[ClipLevel] = byLevel;
    }
    signal -= numbers[Clip] * lost;
    return 1.0 - byLevel;
  }
};
}

Effect saturation()
{
  const EffectParameter level{ "level", "white", ClippingOfImage::NeutralLevel, 0.1, 8.0, 0.1,
    "largest response" };
  const EffectParameter softness{ "softness", "white", ClippingOfImage::ClipSoftness, 0.001, 0.2,
    0.02, "width of the rounded corner", false, true };
  Effect effect;
  effect.definition = { "saturation", "Saturation", "Full wells or the end of the converter.",
    EffectStage::Detector, EffectNeed::Nothing,
    { { "soft", "(u + level - sqrt((u - level)^2 + softness^2)) / 2, a rounded min(u, level)",
        { level, softness }, { { 0.95, 0.01 }, { 0.8, 0.01 }, { 0.65, 0.01 }, { 0.5, 0.01 } } },
      { "gradual", "u / (1 + (u / level)^sharpness)^(1 / sharpness)",
        { level,
          { "sharpness", "1", 10.0, 2.0, 60.0, 4.0, "the larger, the sharper is the bend", false,
            true } },
        { { 1.2, 10.0 }, { 0.9, 10.0 }, { 0.7, 10.0 } } },
      { "per_channel",
        "as soft, with a level_k of each channel: channels that are exposed differently",
        { level.ofLight(), softness }, { { 0.95, 0.01 }, { 0.8, 0.01 }, { 0.65, 0.01 } } } },
    { "shorter exposure", 2.0 }, EffectTrait::LimitsResponse,
    { { "per_channel",
      { { ClippingOfImage::Clip, false, 0.0, 1.0, 0.3 },
        imageTerm(ClippingOfImage::ClipLevel, level.ofLight()) } } } };
  effect.makeBlock = makeSaturation;
  static const ImageStep step{ ImageStage::Detector,
    { { 0.0, ImageAxis::Level },
      { ClippingOfImage::NeutralLevel, ImageAxis::None, ImagePull::Found } },
    ClippingOfImage::clip };
  effect.onImage.step = &step;
  effect.afterDark = true;
  return effect;
}

} // namespace msi
