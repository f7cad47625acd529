// The end of the detector's range.
#include "Kernels/Camera/Effects/DetectorKernel.h"
#include "Kernels/Camera/Effects/Effect.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <vector>

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
  // NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref that is written through
  void operator()(Block<float> response, const ColumnContext&) const noexcept
  {
    forRuns(response,
      [this](float* values, std::size_t count) {
        saturate(static_cast<float>(level), static_cast<float>(softness * softness), values, count);
      });
  }
};

// The p-norm of u and level, for any p = 1 / softness without an overflow.
struct Bend
{
  Bend(double u, double level, double softness) noexcept
    : over(std::fmin(std::log(std::fmax(u, 1e-300) / level) / softness, 700.0))
  {
    const double rest = std::log1p(std::exp(-std::fabs(over)));
    value = (level < u ? level : u) * std::exp(-softness * rest); // NaN stays
    free = std::exp(-rest - std::fmax(over, 0.0));
  }
  double over; // p log(u / level)
  double free; // 1 / (1 + (u / level)^p)
  double value;
};

// The same, as fast as it goes in double precision.
struct GradualSaturation
{
  double level;
  double sharpness;

  // NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref that is written through
  void operator()(Block<double> response, const ColumnContext&) const noexcept
  {
    forRuns(response,
      [this](double* values, std::size_t count)
      { saturateGradually(level, sharpness, values, count); });
  }
  void operator()(Block<float> response, const ColumnContext&) const noexcept
  {
    response = response.unaryExpr(
      [this](float u) { return static_cast<float>(Bend(u, level, 1.0 / sharpness).value); });
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
          response(k, j) = static_cast<Scalar>(Bend(u, levels[k], softness).value);
        }
      }
    });
}

// Its step on image pairs.
struct ClippingOfImage
{
  enum Number : std::size_t
  {
    Clip, // 1: Bend; parts of it only on the way there
    ClipLevel,
    Softness
  };

  static constexpr double NeutralLevel = 8.0;
  static constexpr double Sharp = 0.005;

  static double clip(const double* numbers, const ImagePixel&, double& signal, double* by)
  {
    const Bend bend(signal, numbers[ClipLevel], numbers[Softness]);
    const double part = numbers[Clip];
    const double slope = signal > 0.0 ? bend.value / signal * bend.free : 1.0;
    if (by != nullptr)
    {
      by[Clip] = bend.value - signal;
      by[ClipLevel] = part * bend.value / numbers[ClipLevel] * (1.0 - bend.free);
      by[Softness] = part * bend.value * (std::log(bend.free) + (1.0 - bend.free) * bend.over);
    }
    signal += part * (bend.value - signal);
    return 1.0 + part * (slope - 1.0);
  }
};
}

Effect saturation()
{
  const EffectParameter level{ "level", "white", ClippingOfImage::NeutralLevel, 0.1, 8.0, 0.1,
    "largest response" };
  const EffectParameter corner{ "softness", "white", 0.01, 0.001, 0.2, 0.02,
    "width of the rounded corner", false, true };
  using Image = ClippingOfImage;
  const EffectParameter softness{ "softness", "1", Image::Sharp, Image::Sharp, 0.5, 0.05,
    "the larger, the softer is the bend; 1 / sharpness", false, true };
  const std::vector<ImageTerm> sharp = { { Image::Clip, false, 0.0, 1.0, 0.3 },
    imageTerm(Image::ClipLevel, level.ofLight()) };
  std::vector<ImageTerm> soft = sharp;
  soft.push_back(imageTerm(Image::Softness, softness));
  soft.back().starts = { 0.03, 0.15 };
  Effect effect;
  effect.definition = { "saturation", "Saturation", "Full wells or the end of the converter.",
    EffectStage::Detector, EffectNeed::Nothing,
    { { "soft", "(u + level - sqrt((u - level)^2 + softness^2)) / 2, a rounded min(u, level)",
        { level, corner }, { { 0.95, 0.01 }, { 0.8, 0.01 }, { 0.65, 0.01 }, { 0.5, 0.01 } } },
      { "gradual", "u / (1 + (u / level)^sharpness)^(1 / sharpness)",
        { level,
          { "sharpness", "1", 10.0, 2.0, 60.0, 4.0, "the larger, the sharper is the bend", false,
            true } },
        { { 1.2, 10.0 }, { 0.9, 10.0 }, { 0.7, 10.0 } } },
      { "per_channel",
        "u / (1 + (u / level_k)^(1 / softness))^softness, a level of each channel: channels that "
        "are exposed differently",
        { level.ofLight(), softness }, { { 0.95, 0.05 }, { 0.8, 0.05 }, { 0.65, 0.05 } } } },
    { "shorter exposure", 2.0 }, EffectTrait::LimitsResponse,
    { { "per_channel", sharp }, { "per_channel", soft } } };
  effect.makeBlock = makeSaturation;
  static const ImageStep step{ ImageStage::Detector,
    { { 0.0, ImageAxis::Level }, { Image::NeutralLevel, ImageAxis::None, ImagePull::Found },
      { Image::Sharp, ImageAxis::None, ImagePull::Kept } },
    Image::clip };
  effect.onImage.steps = { &step };
  effect.afterDark = true;
  return effect;
}

} // namespace msi
