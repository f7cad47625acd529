// Light scattered by a small angle.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Imaging/ScatterTail.h"

#include <Eigen/Core>

#include <algorithm>
#include <cmath>
#include <iomanip>
#include <sstream>
#include <string>
#include <vector>

namespace msi
{

namespace
{
// Its step on image pairs.
struct TailOfImage
{
  static constexpr int FreePasses =
    TailPasses - 1; // the first is too narrow to be told from a blur
  static constexpr double NeutralRadius = 8.0;

  enum Number : std::size_t
  {
    Fraction,
    Radius,
    FirstWeight,                         // of single passes, from the second on: any shape
    FirstPass = FirstWeight + FreePasses // further derivative
  };

  // The derivative by the weight of a pass, counted from 0.
  static constexpr std::size_t pass(int number)
  {
    return number == 0 ? FirstPass : FirstWeight + static_cast<std::size_t>(number) - 1;
  }

  static Eigen::ArrayXd weightsOf(double radius)
  {
    const std::vector<double> weights = passWeights(radius, TailPasses);
    return Eigen::Map<const Eigen::ArrayXd>(weights.data(), TailPasses);
  }

  static Eigen::ArrayXd slopeOf(double radius)
  {
    const double step = 0.02 * radius;
    const double above = std::min(radius + step, 64.0);
    const double below = std::max(radius - step, 1.0);
    return (weightsOf(above) - weightsOf(below)) / (above - below);
  }

  static void tailOf(const double* numbers, double* weights)
  {
    const Eigen::ArrayXd tail = numbers[Fraction] * weightsOf(numbers[Radius]);
    for (int number = 0; number < TailPasses; ++number)
    {
      weights[number] = tail[number] + (number > 0 ? numbers[pass(number)] : 0.0);
    }
  }

  static double scatter(const double*, const ImagePixel& pixel, double& signal, double* by)
  {
    double sum = 0.0;
    double fraction = 0.0;
    for (int number = 0; number < TailPasses; ++number)
    {
      const double more = pixel.surround[number] - signal;
      sum += pixel.tailWeights[number] * more;
      fraction += pixel.tailWeights[number];
      if (by != nullptr)
      {
        by[pass(number)] = more;
      }
    }
    signal += sum;
    return 1.0 - fraction;
  }

  static void overPasses(int n, const double* numbers, const double* about, double* derivatives)
  {
    if (n >= static_cast<int>(FirstWeight))
    {
      derivatives[n] = 1.0;
      return;
    }
    const Eigen::ArrayXd weights = n == static_cast<int>(Fraction)
      ? weightsOf(about[Radius])
      : Eigen::ArrayXd(numbers[Fraction] * slopeOf(about[Radius]));
    for (int number = 0; number < TailPasses; ++number)
    {
      derivatives[pass(number)] = weights[number];
    }
  }

  static ImageStep stepOfTail()
  {
    ImageStep step{ ImageStage::Surround,
      { {}, { NeutralRadius, ImageAxis::None, ImagePull::Kept } }, scatter, { ImageAxis::Edges },
      overPasses, nullptr, nullptr, tailOf };
    step.numbers.resize(FirstPass, { 0.0, ImageAxis::Edges });
    return step;
  }
};

// A number for each pass but the first.
std::vector<EffectParameter> shares()
{
  std::vector<EffectParameter> parameters;
  for (int number = 1; number <= TailOfImage::FreePasses; ++number)
  {
    std::ostringstream meaning;
    meaning << "share of the light that is spread by " << std::setprecision(2)
            << splineDeviation(number + 1) << " pixels (standard deviation)";
    parameters.push_back(
      { "share_" + std::to_string(number), "1", 0.0, -0.05, 0.6, 0.01, meaning.str() });
  }
  return parameters;
}

// All parameters of the form any_shape.
Eigen::ArrayXd sharesOf(const BoundEffect& effect)
{
  Eigen::ArrayXd values(TailOfImage::FreePasses);
  std::transform(effect.form().parameters.begin(), effect.form().parameters.end(), values.begin(),
    [&effect](const EffectParameter& share) { return effect.value(share.name); });
  return values;
}

// Their sum; where they cancel, as little as leaves shares of it finite.
double totalOf(const Eigen::ArrayXd& shares)
{
  const double sum = shares.sum();
  return std::copysign(std::fmax(std::fabs(sum), 1e-6), sum);
}

StrayLight makeStrayLight(const BoundEffect& effect)
{
  const std::string& form = effect.form().name;
  const double fraction =
    form == "any_shape" ? totalOf(sharesOf(effect)) : effect.value("fraction");
  return { Eigen::ArrayXd::Constant(effect.camera().channelCount(), fraction), false,
    form == "tail" ? effect.value("reach") : 0.0 };
}

ScatterTail makeTail(const BoundEffect& effect)
{
  if (effect.form().name != "any_shape")
  {
    return ScatterTail(effect.value("radius"));
  }
  // StrayLight takes it times the sum of the shares.
  const Eigen::ArrayXd parts = sharesOf(effect) / totalOf(sharesOf(effect));
  std::vector<double> weights{ 0.0 };
  weights.insert(weights.end(), parts.begin(), parts.end());
  return ScatterTail(weights);
}
}

Effect localStrayLight()
{
  const EffectParameter tail{ "fraction", "1", 0.0, -0.1, 0.6, 0.01,
    "share of the light in the tail" };
  const EffectParameter radius{ "radius", "pixels", TailOfImage::NeutralRadius, 1.0, 64.0, 4.0,
    "reach of the tail, images only", false, true };
  ImageTerm reach = imageTerm(TailOfImage::Radius, radius);
  reach.starts = { 2.0, 4.0, 8.0, 16.0, 32.0 };
  const std::vector<EffectParameter> ofPasses = shares();
  std::vector<ImageTerm> anyShape;
  for (const EffectParameter& share : ofPasses)
  {
    anyShape.push_back(imageTerm(TailOfImage::FirstWeight + anyShape.size(), share));
    anyShape.back().mayEnd = true;
  }
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
          radius } },
      { "any_shape",
        "u + sum of share_i (T_i u - u), T_i a B3 spline, each twice as wide as the one before; "
        "on a table the mean of the neighbours",
        ofPasses, {}, FormTrait::OfImages } },
    Captures::BlackAndWhite, EffectTrait::ActsOnEdges,
    { { "neighbours", { imageTerm(TailOfImage::Fraction, tail), reach } },
      { "any_shape", anyShape } } };
  effect.makeStrayLight = makeStrayLight;
  effect.surround = Surround::Near;
  effect.onImage.makeTail = makeTail;
  static const ImageStep step = TailOfImage::stepOfTail();
  effect.onImage.steps = { &step };
  return effect;
}

} // namespace msi
