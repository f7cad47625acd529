// What no other effect explains.
#include "Kernels/Camera/Effects/Effect.h"

#include <array>
#include <vector>

namespace msi
{

namespace
{
// In the order of the form's parameters.
enum Number : std::size_t
{
  Constant,
  Slope,
  Square,
  Right,
  Down,
  Previous,
  Next,
  Drift,
  Numbers
};

class UnmodelledResponse
{
public:
  explicit UnmodelledResponse(const BoundEffect& effect)
  {
    for (std::size_t n = 0; n < Numbers; ++n)
    {
      Of[n] = ChannelValues(effect.perChannel(effect.form().parameters[n].name));
    }
  }
  template <typename Scalar>
  void operator()(Block<Scalar> signal, const ColumnContext& columns) const noexcept
  {
    const auto at = [](const double* values, Eigen::Index j, double none)
    { return static_cast<Scalar>(values == nullptr ? none : values[j]); };
    const auto of = [this](Number n, Eigen::Index k) { return Of[n].template as<Scalar>()[k]; };
    const Eigen::Index last = signal.rows() - 1;
    for (Eigen::Index j = 0; j < signal.cols(); ++j)
    {
      const Scalar x = at(columns.fieldX, j, 0.0);
      const Scalar y = at(columns.fieldY, j, 0.0);
      const Scalar t = at(columns.time, j, 0.5) - Scalar(0.5);
      Scalar previous = signal(0, j);
      for (Eigen::Index k = 0; k <= last; ++k)
      {
        const Scalar u = signal(k, j);
        const Scalar next = k < last ? signal(k + 1, j) : u;
        const Scalar factor =
          of(Slope, k) + of(Square, k) * u + of(Right, k) * x + of(Down, k) * y + of(Drift, k) * t;
        signal(k, j) = u + of(Constant, k) + factor * u + of(Previous, k) * (previous - u) +
          of(Next, k) * (next - u);
        previous = u;
      }
    }
  }

private:
  std::array<ChannelValues, Numbers> Of;
};

// Its step on image pairs: without neighbouring channels and time.
double restStep(const double* numbers, const ImagePixel& pixel, double& signal, double* by)
{
  const double u = signal;
  if (by != nullptr)
  {
    by[Constant] = 1.0;
    by[Slope] = u;
    by[Square] = u * u;
    by[Right] = u * pixel.x;
    by[Down] = u * pixel.y;
  }
  const double factor = 1.0 + numbers[Slope] + numbers[Right] * pixel.x + numbers[Down] * pixel.y;
  signal = numbers[Constant] + u * (factor + numbers[Square] * u);
  return factor + 2.0 * numbers[Square] * u;
}
}

Effect unmodelledResponse()
{
  const auto number = [](const char* name, const char* unit, const char* meaning) {
    return EffectParameter{ name, unit, 0.0, -2.0, 2.0, 0.02, meaning, true };
  };
  const std::vector<EffectParameter> parameters = { number("constant", "white", "offset"),
    number("slope", "1", "relative gain"), number("square", "1", "weight of u^2"),
    number("along_x", "1", "relative gain from the middle to the edge in x"),
    number("along_y", "1", "relative gain from the middle to the edge in y"),
    number("from_previous", "1", "share of the difference from the channel before"),
    number("from_next", "1", "share of the difference from the channel behind"),
    number("drift", "1", "relative gain from the first to the last reading") };
  ImageForm ofImage{ "smooth", {} };
  for (std::size_t n = 0; n <= Down; ++n)
  {
    ofImage.terms.push_back(imageTerm(n, parameters[n]));
  }
  Effect effect;
  effect.definition = { "unmodelled_response", "Unmodelled response",
    "A smooth function of response, neighbouring channels, place and time that models what no "
    "other effect explains. It is not a cause: a diagnosis adds it to the corrected simulator on "
    "request, for an image pair without neighbouring channels and time.",
    EffectStage::Detector, EffectNeed::Nothing,
    { { "smooth",
      "u_k + constant_k + u_k (slope_k + square_k u_k + along_x_k x + along_y_k y + "
      "drift_k (t - 1/2)) "
      "+ from_previous_k (u_k-1 - u_k) + from_next_k (u_k+1 - u_k)",
      parameters } },
    { "chart with other samples" }, EffectTrait::Remainder, { ofImage } };
  effect.makeBlock = makeBlockOperator<UnmodelledResponse>;
  static const ImageStep step{ ImageStage::Detector, std::vector<ImageNumber>(Down + 1), restStep };
  effect.onImage.steps = { &step };
  effect.afterDark = true;
  return effect;
}

} // namespace msi
