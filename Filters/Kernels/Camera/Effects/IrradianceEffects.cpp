// Geometry and stray light: what falls on the detector.
#include "Kernels/Camera/Effects/EffectEntry.h"

#include <cmath>

namespace msi
{

namespace
{
// Multiplies every column by Derived::factor(x, y).
template <typename Derived>
class FieldOperator : public BlockOperatorOf<Derived>
{
public:
  template <typename Scalar>
  void run(Block<Scalar> signal, const ColumnContext& columns) const noexcept
  {
    for (Eigen::Index j = 0; j < signal.cols(); ++j)
    {
      signal.col(j) *= static_cast<Scalar>(
        static_cast<const Derived*>(this)->factor(columns.fieldX[j], columns.fieldY[j]));
    }
  }
};

class IlluminationGradient : public FieldOperator<IlluminationGradient>
{
public:
  explicit IlluminationGradient(const BoundEffect& effect)
    : Right(effect.value("right"))
    , Down(effect.value("down"))
    , Bend(effect.form().name == "bent" ? effect.value("bend") : 0.0)
  {
  }
  double factor(double x, double y) const noexcept
  {
    const double plane = Right * x + Down * y;
    return 1.0 + plane + Bend * plane * plane;
  }

private:
  double Right;
  double Down;
  double Bend;
};

class Vignetting : public FieldOperator<Vignetting>
{
public:
  explicit Vignetting(const BoundEffect& effect)
    : CosineFourth(effect.form().name == "cos4")
    , Polynomial(effect.form().name == "polynomial")
    , Strength(CosineFourth ? std::pow(effect.value("tangent"), 2) : effect.value("falloff"))
    , Fourth(Polynomial ? effect.value("fourth") : 0.0)
    , Sixth(Polynomial ? effect.value("sixth") : 0.0)
    , CenterX(effect.value("center_x"))
    , CenterY(effect.value("center_y"))
  {
  }
  double factor(double x, double y) const noexcept
  {
    const double radius2 = (x - CenterX) * (x - CenterX) + (y - CenterY) * (y - CenterY);
    if (CosineFourth)
    {
      const double secant2 = 1.0 + Strength * radius2;
      return 1.0 / (secant2 * secant2);
    }
    if (Polynomial)
    {
      const double factor = 1.0 - radius2 * (Strength + radius2 * (Fourth + radius2 * Sixth));
      return std::fmax(factor, 0.0);
    }
    return 1.0 - Strength * radius2;
  }

private:
  bool CosineFourth;
  bool Polynomial;
  double Strength;
  double Fourth;
  double Sixth;
  double CenterX;
  double CenterY;
};

// u + fraction surround, or + fraction (surround - u) where light only changes its place.
class StrayLight : public SurroundOperatorOf<StrayLight>
{
public:
  explicit StrayLight(const BoundEffect& effect)
    : Fraction(effect.perChannel("fraction"))
    , Added(effect.form().name == "common" || effect.form().name == "per_channel")
  {
  }
  template <typename Scalar>
  void run(Block<Scalar> signal, ConstBlock<Scalar> surround) const noexcept
  {
    for (Eigen::Index j = 0; j < signal.cols(); ++j)
    {
      auto u = signal.col(j).array();
      if (Added)
      {
        u += Fraction.as<Scalar>() * surround.col(j).array();
      }
      else
      {
        u += Fraction.as<Scalar>() * (surround.col(j).array() - u);
      }
    }
  }

private:
  ChannelValues Fraction;
  bool Added;
};

EffectParameter glare(bool perChannel)
{
  return { "fraction", "1", 0.0, 0.0, 0.5, 0.01, "share of the scene's mean signal", perChannel };
}
}

std::vector<EffectEntry> irradianceEffects()
{
  const std::vector<EffectParameter> center = { { "center_x", "half field", 0.0, -1.0, 1.0, 0.2,
                                                  "optical axis", false, true },
    { "center_y", "half field", 0.0, -1.0, 1.0, 0.2, "optical axis", false, true } };
  const EffectParameter right{ "right", "1", 0.0, -0.5, 0.5, 0.03,
    "gain from the middle to the edge in x" };
  const EffectParameter down{ "down", "1", 0.0, -0.5, 0.5, 0.03,
    "gain from the middle to the edge in y" };
  const EffectParameter tail{ "fraction", "1", 0.0, -0.1, 0.6, 0.01,
    "share of the light in the tail" };
  const EffectParameter radius{ "radius", "pixels", 8.0, 1.0, 64.0, 4.0,
    "reach of the tail, images only", false, true };
  return {
    { { "illumination_gradient", "Illumination gradient",
        "More light on one side of the field than on the other.", EffectStage::Irradiance,
        EffectNeed::Position,
        { { "plane", "u (1 + right x + down y), x and y from -1 to 1 over the field",
            { right, down } },
          { "bent", "u (1 + s + bend s^2), s = right x + down y: a lamp that is near",
            { right, down,
              { "bend", "1", 0.0, -10.0, 10.0, 1.0,
                "1 / 2 for an exponential, 3 / 4 for the inverse square of a distance", false,
                true } } } } },
      nullptr, makeBlockOperator<IlluminationGradient> },
    { { "vignetting", "Vignetting", "The lens passes less light off its axis.",
        EffectStage::Irradiance, EffectNeed::Position,
        { { "quadratic", "u (1 - falloff rho^2), rho = 1 at half the longer side of the field",
            { { "falloff", "1", 0.0, -0.45, 0.45, 0.03, "loss at rho = 1" }, center[0],
              center[1] } },
          { "cos4", "u / (1 + tangent^2 rho^2)^2, the cosine-fourth law",
            { { "tangent", "1", 0.0, 0.0, 1.0, 0.1, "tangent of the field angle at rho = 1" },
              center[0], center[1] },
            { { 0.2, 0.0, 0.0 } } },
          { "polynomial", "u (1 - falloff rho^2 - fourth rho^4 - sixth rho^6), not below zero",
            { { "falloff", "1", 0.0, -1.5, 1.5, 0.03, "loss at rho = 1 that grows with rho^2" },
              { "fourth", "1", 0.0, -1.5, 1.5, 0.03, "loss at rho = 1 that grows with rho^4" },
              { "sixth", "1", 0.0, -1.5, 1.5, 0.03, "loss at rho = 1 that grows with rho^6" },
              center[0], center[1] } } } },
      nullptr, makeBlockOperator<Vignetting> },
    { { "veiling_glare", "Veiling glare",
        "Light scattered in the lens covers the whole field in proportion to the scene's mean.",
        EffectStage::Irradiance, EffectNeed::Nothing,
        { { "common", "u + fraction (mean of the scene)", { glare(false) } },
          { "conserving", "u + fraction (mean of the scene - u)", { glare(false) } },
          { "per_channel", "u + fraction (mean of the scene), a fraction for each channel",
            { glare(true) } } } },
      nullptr, nullptr, makeSurroundOperator<StrayLight> },
    { { "local_stray_light", "Local stray light",
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
              radius } } } },
      nullptr, nullptr, makeSurroundOperator<StrayLight> },
  };
}

} // namespace msi
