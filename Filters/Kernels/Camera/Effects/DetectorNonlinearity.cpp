// A curve between light and response.
#include "Kernels/Camera/Effects/DetectorKernel.h"
#include "Kernels/Camera/Effects/Effect.h"

#include <cmath>
#include <cstddef>
#include <memory>
#include <string>

namespace msi
{

namespace
{
struct Power
{
  double exponent;

  // NOLINTNEXTLINE(performance-unnecessary-value-param): a Ref that is written through
  void operator()(Block<double> signal, const ColumnContext&) const noexcept
  {
    forRuns(signal, [this](double* values, std::size_t count) { raise(exponent, values, count); });
  }
  void operator()(Block<float> signal, const ColumnContext&) const noexcept
  {
    // One value at a time: packets of pow() and their remainders round differently.
    signal = signal.unaryExpr([power = static_cast<float>(exponent)](float u)
      { return u > 0.0F ? std::pow(u, power) : u; });
  }
};

std::unique_ptr<BlockOperator> makeCurve(const BoundEffect& effect)
{
  const std::string& form = effect.form().name;
  if (form == "gamma")
  {
    return blockOperator(Power{ effect.value("exponent") });
  }
  if (form == "compressive")
  {
    return onAll(
      [](auto u, auto compression) { u /= 1 + compression * u; }, effect.value("compression"));
  }
  if (form == "per_channel")
  {
    return onAll([](auto u, const auto& square) { u += (u.square() - u).colwise() * square; },
      ChannelValues(effect.perChannel("square")));
  }
  const double square = effect.value("square");
  if (form == "fitted")
  {
    return onAll([](auto u, const auto& linear, auto factor, const auto& constant)
      { u = (u.colwise() * linear + factor * u.square()).colwise() + constant; },
      ChannelValues(1.0 - square * effect.perChannel("slope")), square,
      ChannelValues(-square * effect.perChannel("constant")));
  }
  return onAll([](auto u, auto linear, auto factor, auto cube)
    { u *= linear + u * (factor + cube * u); },
    form == "anchored" ? 1.0 - square : 1.0, square, form == "cubic" ? effect.value("cube") : 0.0);
}

// Its step on image pairs.
struct CurveOfImage
{
  enum Number : std::size_t
  {
    Square,
    Cube,
    Anchored,
    Exponent,
    Compression
  };

  static constexpr double LeastSignal = 1e-3; // below, a power has no useful slope

  static double bend(const double* numbers, const ImagePixel&, double& signal, double* by)
  {
    double power = signal;
    double slope = 1.0;
    double byExponent = 0.0;
    const double exponent = numbers[Exponent];
    if (signal > 0.0)
    {
      const double logarithm = std::log(signal);
      power = exponent == 1.0 ? signal : std::exp(exponent * logarithm);
      slope = exponent == 1.0 ? 1.0 : exponent * power / std::fmax(signal, LeastSignal);
      byExponent = power * logarithm;
    }
    const double divisor = 1.0 + numbers[Compression] * power;
    const double bent = power / divisor;
    const double square = numbers[Square] + numbers[Anchored];
    const double linear = 1.0 - numbers[Anchored];
    const double cube = numbers[Cube];
    const double inner = linear + bent * (2.0 * square + 3.0 * cube * bent);
    const double outer = inner / (divisor * divisor);
    if (by != nullptr)
    {
      by[Square] = bent * bent;
      by[Cube] = bent * bent * bent;
      by[Anchored] = bent * bent - bent;
      by[Exponent] = outer * byExponent;
      by[Compression] = -bent * bent * inner;
    }
    signal = bent * (linear + bent * (square + cube * bent));
    return outer * slope;
  }
};
}

Effect detectorNonlinearity()
{
  const EffectParameter square{ "square", "1", 0.0, -0.45, 0.9, 0.05, "weight of u^2" };
  const EffectParameter cube{ "cube", "1", 0.0, -0.45, 0.9, 0.05, "weight of u^3" };
  const EffectParameter exponent{ "exponent", "1", 1.0, 0.4, 2.5, 0.05, "exponent" };
  const EffectParameter compression{ "compression", "1", 0.0, -0.4, 2.0, 0.05, "loss at white" };
  const auto line = [](const char* name, const char* meaning) {
    return EffectParameter{ name, "1", 0.0, -10.0, 10.0, 1.0, meaning, true, true, false, true };
  };
  Effect effect;
  effect.definition = { "detector_nonlinearity", "Detector nonlinearity",
    "A curve between light and response.", EffectStage::Detector, EffectNeed::Nothing,
    { { "quadratic", "u + square u^2", { square } },
      { "anchored", "(1 - square) u + square u^2: white keeps its response", { square } },
      { "gamma", "u^exponent: white keeps its response", { exponent } },
      { "compressive", "u / (1 + compression u)", { compression } },
      { "cubic", "u + square u^2 + cube u^3", { square, cube } },
      { "per_channel",
        "(1 - square_k) u_k + square_k u_k^2: channels that are exposed differently reach "
        "different parts of the curve",
        { square.ofLight() } },
      { "fitted",
        "u + square (u^2 - slope_k u - constant_k): what a linear camera that was fitted to the "
        "curve leaves of it",
        { square, line("slope", "of the line through u^2 over the samples"),
          line("constant", "of that line") },
        {}, FormTrait::BesideLine } },
    Captures::ExposureSeries, EffectTrait::None,
    { { "quadratic", { imageTerm(CurveOfImage::Square, square) } },
      { "anchored", { imageTerm(CurveOfImage::Anchored, square) } },
      { "gamma", { imageTerm(CurveOfImage::Exponent, exponent) } },
      { "compressive", { imageTerm(CurveOfImage::Compression, compression) } },
      { "cubic", { imageTerm(CurveOfImage::Square, square), imageTerm(CurveOfImage::Cube, cube) } },
      { "per_channel", { imageTerm(CurveOfImage::Anchored, square.ofLight()) } } } };
  effect.makeBlock = makeCurve;
  static const ImageStep step{ ImageStage::Detector,
    { { 0.0, ImageAxis::Level }, {}, {}, { 1.0 }, {} }, CurveOfImage::bend };
  effect.onImage.steps = { &step };
  return effect;
}

} // namespace msi
