// A lens that passes less light off its axis.
#include "Kernels/Camera/Effects/Effect.h"

#include <cmath>
#include <memory>
#include <string>
#include <vector>

namespace msi
{

namespace
{
std::unique_ptr<BlockOperator> makeVignetting(const BoundEffect& effect)
{
  const std::string& form = effect.form().name;
  const auto radius2 = [centerX = effect.value("center_x"), centerY = effect.value("center_y")](
                         double x, double y)
  { return (x - centerX) * (x - centerX) + (y - centerY) * (y - centerY); };
  if (form == "cos4")
  {
    const Eigen::ArrayXd tangent2 = effect.perChannel("tangent").square();
    return onField(effect,
      [=](Eigen::Index k, double x, double y)
      {
        const double secant2 = 1.0 + tangent2[k] * radius2(x, y);
        return 1.0 / (secant2 * secant2);
      });
  }
  const Eigen::ArrayXd falloff = effect.perChannel("falloff");
  if (form == "polynomial")
  {
    return onField(effect,
      [=, fourth = effect.value("fourth"), sixth = effect.value("sixth")](
        Eigen::Index k, double x, double y)
      {
        const double square = radius2(x, y);
        return std::fmax(1.0 - square * (falloff[k] + square * (fourth + square * sixth)), 0.0);
      });
  }
  return onField(
    effect, [=](Eigen::Index k, double x, double y) { return 1.0 - falloff[k] * radius2(x, y); });
}

// Its step on image pairs.
struct VignettingOfImage
{
  enum Number : std::size_t
  {
    Falloff,
    Fourth,
    Sixth,
    CenterX,
    CenterY,
    AlongX, // further derivatives: the signal times x, times y, and the signal
    AlongY,
    Even
  };

  // u (1 - falloff rho^2 - fourth rho^4 - sixth rho^6), not below zero
  static double darken(const double* numbers, const ImagePixel& pixel, double& signal, double* by)
  {
    const double x = pixel.x - numbers[CenterX];
    const double y = pixel.y - numbers[CenterY];
    const double square = x * x + y * y;
    const double factor = std::fmax(
      1.0 - square * (numbers[Falloff] + square * (numbers[Fourth] + square * numbers[Sixth])),
      0.0);
    if (by != nullptr)
    {
      by[Falloff] = -square * signal;
      by[Fourth] = square * by[Falloff];
      by[Sixth] = square * by[Fourth];
      const double steep = 2.0 * signal *
        (numbers[Falloff] + square * (2.0 * numbers[Fourth] + 3.0 * square * numbers[Sixth]));
      by[CenterX] = x * steep;
      by[CenterY] = y * steep;
      by[AlongX] = pixel.x * signal;
      by[AlongY] = pixel.y * signal;
      by[Even] = signal;
    }
    signal *= factor;
    return factor;
  }

  // The square of the distance from another center is the same polynomial.
  static void recentered(int n, const double* numbers, const double* about, double* derivatives)
  {
    derivatives[n] = 1.0;
    if (n == Falloff)
    {
      const double right = about[CenterX] - numbers[CenterX];
      const double down = about[CenterY] - numbers[CenterY];
      derivatives[AlongX] = 2.0 * right;
      derivatives[AlongY] = 2.0 * down;
      derivatives[Even] =
        -(right * (about[CenterX] + numbers[CenterX]) + down * (about[CenterY] + numbers[CenterY]));
    }
  }
};
}

Effect vignetting()
{
  const EffectParameter falloff{ "falloff", "1", 0.0, -0.45, 0.45, 0.03, "loss at rho = 1" };
  const auto order = [](const char* name, const char* meaning) {
    return EffectParameter{ name, "1", 0.0, -1.5, 1.5, 0.03, meaning };
  };
  const std::vector<EffectParameter> orders = { order("falloff",
                                                  "loss at rho = 1 that grows with rho^2"),
    order("fourth", "loss at rho = 1 that grows with rho^4"),
    order("sixth", "loss at rho = 1 that grows with rho^6") };
  const auto axis = [](const char* name) {
    return EffectParameter{ name, "half field", 0.0, -1.0, 1.0, 0.1, "optical axis", false, true };
  };
  const std::vector<EffectParameter> center = { axis("center_x"), axis("center_y") };
  const ImageTerm quadratic = imageTerm(VignettingOfImage::Falloff, falloff);
  const ImageTerm steep = imageTerm(VignettingOfImage::Falloff, orders[0]);
  const ImageTerm fourth = imageTerm(VignettingOfImage::Fourth, orders[1]);
  const ImageTerm sixth = imageTerm(VignettingOfImage::Sixth, orders[2]);
  const ImageTerm centerX = imageTerm(VignettingOfImage::CenterX, center[0]);
  const ImageTerm centerY = imageTerm(VignettingOfImage::CenterY, center[1]);
  // Terms of a higher order are known about the model's center alone.
  ImageTerm anyX = centerX;
  ImageTerm anyY = centerY;
  anyX.starts = anyY.starts = { -0.3, 0.0, 0.3 };
  Effect effect;
  effect.definition = { "vignetting", "Vignetting", "The lens passes less light off its axis.",
    EffectStage::Irradiance, EffectNeed::Position,
    { { "quadratic", "u (1 - falloff rho^2), rho = 1 at half the longer side of the field",
        { falloff, center[0], center[1] } },
      { "cos4", "u / (1 + tangent^2 rho^2)^2, the cosine-fourth law",
        { { "tangent", "1", 0.0, 0.0, 1.0, 0.1, "tangent of the field angle at rho = 1" },
          center[0], center[1] },
        { { 0.2, 0.0, 0.0 } } },
      { "polynomial", "u (1 - falloff rho^2 - fourth rho^4 - sixth rho^6), not below zero",
        { orders[0], orders[1], orders[2], center[0], center[1] } },
      { "per_channel", "u_k (1 - falloff_k rho^2)", { falloff.ofLight(), center[0], center[1] } } },
    Captures::TurnedChart, EffectTrait::None,
    { { "quadratic", { quadratic } }, { "quadratic", { quadratic, anyX, anyY } },
      { "polynomial", { steep, fourth, sixth } },
      { "polynomial", { steep, fourth, sixth, centerX, centerY } },
      { "per_channel", { imageTerm(VignettingOfImage::Falloff, falloff.ofLight()) } } } };
  effect.makeBlock = makeVignetting;
  static const ImageStep step{ ImageStage::Lens,
    { { 0.0 }, { 0.0, ImageAxis::Position }, { 0.0 }, { 0.0, ImageAxis::None, ImagePull::Itself },
      { 0.0, ImageAxis::None, ImagePull::Itself } },
    VignettingOfImage::darken, { ImageAxis::None, ImageAxis::None, ImageAxis::None },
    VignettingOfImage::recentered };
  effect.onImage.steps = { &step };
  return effect;
}

} // namespace msi
