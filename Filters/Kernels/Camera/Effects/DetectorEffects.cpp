// The detector's curve, offset and end.
#include "Kernels/Camera/Effects/DetectorKernel.h"
#include "Kernels/Camera/Effects/EffectEntry.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <type_traits>

namespace msi
{

namespace
{
// Calls body(values, count) for all values, together where they lie one after the other, else column by column.
template <typename Scalar, typename Body>
void forRuns(Block<Scalar> block, Body body) noexcept
{
  const bool together = block.outerStride() == block.rows();
  const Eigen::Index runs = together ? std::min<Eigen::Index>(block.cols(), 1) : block.cols();
  const Eigen::Index columns = together ? block.cols() : 1;
  for (Eigen::Index j = 0; j < runs; ++j)
  {
    body(block.col(j).data(), static_cast<std::size_t>(block.rows() * columns));
  }
}

class DetectorNonlinearity : public BlockOperatorOf<DetectorNonlinearity>
{
public:
  explicit DetectorNonlinearity(const BoundEffect& effect)
  {
    const std::string& form = effect.form().name;
    if (form == "gamma")
    {
      Kind = Gamma;
      Linear = effect.value("exponent");
    }
    else if (form == "compressive")
    {
      Kind = Compressive;
      Linear = effect.value("compression");
    }
    else
    {
      // linear u + square u^2 + cube u^3
      Square = effect.value("square");
      Linear = form == "anchored" ? 1.0 - Square : 1.0;
      Cube = form == "cubic" ? effect.value("cube") : 0.0;
    }
  }
  template <typename Scalar>
  void run(Block<Scalar> signal, const ColumnContext&) const noexcept
  {
    auto u = signal.array();
    const auto linear = static_cast<Scalar>(Linear);
    switch (Kind)
    {
      case Polynomial:
        u *= linear + u * (static_cast<Scalar>(Square) + static_cast<Scalar>(Cube) * u);
        break;
      case Compressive:
        u /= Scalar(1) + linear * u;
        break;
      case Gamma:
        if constexpr (std::is_same_v<Scalar, double>)
        {
          forRuns(
            signal, [this](double* values, std::size_t count) { raise(Linear, values, count); });
        }
        else
        {
          // One value at a time: packets of pow() and their remainders round differently.
          signal = signal.unaryExpr(
            [linear](Scalar value) { return value > Scalar(0) ? std::pow(value, linear) : value; });
        }
        break;
    }
  }

private:
  enum
  {
    Polynomial,
    Gamma,
    Compressive
  } Kind = Polynomial;
  double Linear = 1.0;
  double Square = 0.0;
  double Cube = 0.0;
};

class DarkOffset : public BlockOperatorOf<DarkOffset>
{
public:
  explicit DarkOffset(const BoundEffect& effect)
    : Offset(effect.perChannel("offset"))
  {
  }
  template <typename Scalar>
  void run(Block<Scalar> response, const ColumnContext&) const noexcept
  {
    response.array().colwise() += Offset.as<Scalar>();
  }

private:
  ChannelValues Offset;
};

// The lower branch of a hyperbola around the corner of min(u, level), or the p-norm of both.
class Saturation : public BlockOperatorOf<Saturation>
{
public:
  explicit Saturation(const BoundEffect& effect)
    : Level(effect.value("level"))
    , Gradual(effect.form().name == "gradual")
    , Softness(Gradual ? 0.0 : effect.value("softness"))
    , Sharpness(Gradual ? effect.value("sharpness") : 0.0)
  {
  }
  template <typename Scalar>
  void run(Block<Scalar> response, const ColumnContext&) const noexcept
  {
    if (Gradual)
    {
      if constexpr (std::is_same_v<Scalar, double>)
      {
        forRuns(response,
          [this](double* values, std::size_t count)
          { saturateGradually(Level, Sharpness, values, count); });
        return;
      }
      response = response.unaryExpr(
        [level = static_cast<Scalar>(Level), p = static_cast<Scalar>(Sharpness)](Scalar u)
        {
          const Scalar over = u > Scalar(0) ? std::pow(u / level, p) : Scalar(0);
          return u / std::pow(Scalar(1) + over, Scalar(1) / p);
        });
      return;
    }
    if constexpr (std::is_same_v<Scalar, float>)
    {
      forRuns(response,
        [this](float* values, std::size_t count) {
          saturate(
            static_cast<float>(Level), static_cast<float>(Softness * Softness), values, count);
        });
    }
    else
    {
      // One value at a time: Eigen's packets of sqrt() and their remainders round differently.
      response = response.unaryExpr(
        [level = Level, width2 = Softness * Softness](double u)
        {
          const double beyond = u - level;
          return 0.5 * (u + level - std::sqrt(beyond * beyond + width2));
        });
    }
  }

private:
  double Level;
  bool Gradual;
  double Softness;
  double Sharpness;
};

EffectParameter offset(bool perChannel)
{
  return { "offset", "white", 0.0, -0.2, 0.2, 0.005, "dark response beyond the model's",
    perChannel };
}
}

std::vector<EffectEntry> detectorEffects()
{
  const EffectParameter square{ "square", "1", 0.0, -0.45, 0.9, 0.05, "weight of u^2" };
  const EffectParameter cube{ "cube", "1", 0.0, -0.45, 0.9, 0.05, "weight of u^3" };
  return {
    { { "detector_nonlinearity", "Detector nonlinearity",
        "One curve for all channels between light and response.", EffectStage::Detector,
        EffectNeed::Nothing,
        { { "quadratic", "u + square u^2", { square } },
          { "anchored", "(1 - square) u + square u^2: white keeps its response", { square } },
          { "gamma", "u^exponent: white keeps its response",
            { { "exponent", "1", 1.0, 0.4, 2.5, 0.05, "exponent" } } },
          { "compressive", "u / (1 + compression u)",
            { { "compression", "1", 0.0, -0.4, 2.0, 0.05, "loss at white" } } },
          { "cubic", "u + square u^2 + cube u^3", { square, cube } } } },
      nullptr, makeBlockOperator<DetectorNonlinearity> },
    { { "dark_offset", "Dark offset",
        "Dark current, bias or ambient light that the dark frame did not take away.",
        EffectStage::Detector, EffectNeed::Nothing,
        { { "common", "u + offset", { offset(false) } },
          { "per_channel", "u_k + offset_k", { offset(true) } } } },
      nullptr, makeBlockOperator<DarkOffset>, nullptr, true },
    { { "saturation", "Saturation", "Full wells or the end of the converter.",
        EffectStage::Detector, EffectNeed::Nothing,
        { { "soft", "(u + level - sqrt((u - level)^2 + softness^2)) / 2, a rounded min(u, level)",
            { { "level", "white", 8.0, 0.1, 8.0, 0.1, "largest response" },
              { "softness", "white", 0.01, 0.001, 0.2, 0.02, "width of the rounded corner", false,
                true } },
            { { 0.95, 0.01 }, { 0.8, 0.01 }, { 0.65, 0.01 }, { 0.5, 0.01 } } },
          { "gradual", "u / (1 + (u / level)^sharpness)^(1 / sharpness)",
            { { "level", "white", 8.0, 0.1, 8.0, 0.1, "largest response" },
              { "sharpness", "1", 10.0, 2.0, 60.0, 4.0, "the larger, the sharper is the bend",
                false, true } },
            { { 1.2, 10.0 }, { 0.9, 10.0 }, { 0.7, 10.0 } } } } },
      nullptr, makeBlockOperator<Saturation>, nullptr, true },
  };
}

std::vector<EffectEntry> noiseEffects()
{
  return { { { "excess_noise", "Excess noise",
    "More scatter between repeats than the noise model says; the mean does not change.",
    EffectStage::Noise, EffectNeed::Nothing,
    { { "factor", "standard deviation x factor",
        { { "factor", "1", 1.0, 0.1, 20.0, 0.3, "factor on the standard deviation" } } },
      { "per_channel", "standard deviation x factor of the channel",
        { { "factor", "1", 1.0, 0.1, 20.0, 0.3, "factor on the standard deviation", true } } },
      { "added", "variance + added^2",
        { { "added", "white", 0.0, 0.0, 0.2, 0.002, "further standard deviation" } } } } } } };
}

} // namespace msi
