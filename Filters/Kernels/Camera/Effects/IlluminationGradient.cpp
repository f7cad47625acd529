// More light on some parts of the field than on others.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Numerics/Angle.h"

#include <array>
#include <cmath>
#include <cstddef>
#include <memory>
#include <numeric>
#include <string>
#include <vector>

namespace msi
{

namespace
{
// Light of any smooth shape: 1 + sum of order_i_j P_i(x) P_j(y), not below zero, P Legendre polynomials; 1 on average over a square
// field. Two spots, a soft shadow or a lamp that is near leave less than a twentieth of their deviation with sixth order.
struct AnyShape
{
  static constexpr std::size_t Highest = 6; // i + j
  static constexpr std::size_t Orders = (Highest + 1) * (Highest + 2) / 2 - 1;

  // Calls take(n, i, j) for each.
  template <typename Take>
  static void forOrders(Take take)
  {
    std::size_t n = 0;
    for (std::size_t degree = 1; degree <= Highest; ++degree)
    {
      for (std::size_t j = 0; j <= degree; ++j)
      {
        take(n++, degree - j, j);
      }
    }
  }

  static std::vector<EffectParameter> parameters()
  {
    std::vector<EffectParameter> all;
    forOrders(
      [&all](std::size_t, std::size_t i, std::size_t j)
      {
        const std::string x = std::to_string(i);
        const std::string y = std::to_string(j);
        all.push_back({ "order_" + x + "_" + y, "1", 0.0, -0.5, 0.5, 0.03,
          "weight of P_" + x + "(x) P_" + y + "(y)" });
      });
    return all;
  }

  // P_0 to P_6, by Bonnet's recursion.
  using Legendre = std::array<double, Highest + 1>;
  static Legendre legendre(double x)
  {
    Legendre values{ 1.0, x };
    for (std::size_t n = 1; n < Highest; ++n)
    {
      const auto order = static_cast<double>(n);
      values[n + 1] = ((2.0 * order + 1.0) * x * values[n] - order * values[n - 1]) / (order + 1.0);
    }
    return values;
  }

  using Values = std::array<double, Orders>;
  static Values valuesAt(double x, double y)
  {
    const Legendre ofX = legendre(x);
    const Legendre ofY = legendre(y);
    Values values{};
    forOrders([&](std::size_t n, std::size_t i, std::size_t j) { values[n] = ofX[i] * ofY[j]; });
    return values;
  }

  static double factor(const double* weights, const Values& values)
  {
    return std::fmax(std::inner_product(values.begin(), values.end(), weights, 1.0), 0.0);
  }

  // Its step on image pairs.
  static double shade(const double* numbers, const ImagePixel& pixel, double& signal, double* by)
  {
    const Values values = valuesAt(pixel.x, pixel.y);
    for (std::size_t n = 0; n < Orders && by != nullptr; ++n)
    {
      by[n] = values[n] * signal;
    }
    const double light = factor(numbers, values);
    signal *= light;
    return light;
  }
};

std::unique_ptr<BlockOperator> makeAnyShape(const BoundEffect& effect)
{
  std::vector<double> weights;
  for (const EffectParameter& order : effect.form().parameters)
  {
    weights.push_back(effect.value(order.name));
  }
  return onField(effect,
    [weights](Eigen::Index, double x, double y)
    { return AnyShape::factor(weights.data(), AnyShape::valuesAt(x, y)); });
}

std::unique_ptr<BlockOperator> makeGradient(const BoundEffect& effect)
{
  if (effect.form().name == "any_shape")
  {
    return makeAnyShape(effect);
  }
  const bool bent = effect.form().name == "bent";
  const double turn = bent ? Degree * effect.value("turn") : 0.0;
  return onField(effect,
    [alongX = effect.perChannel("along_x"), alongY = effect.perChannel("along_y"),
      square = bent ? effect.value("square") : 0.0, cosine = std::cos(turn),
      sine = std::sin(turn)](Eigen::Index k, double x, double y)
    {
      const double along = x * cosine + y * sine;
      return 1.0 + alongX[k] * x + alongY[k] * y + square * along * along;
    });
}

// Its step on image pairs.
struct GradientOfImage
{
  enum Number : std::size_t
  {
    AlongX,
    AlongY,
    Square,
    Turn,
    Numbers,
    SquareX = Numbers, // further derivatives
    SquareY,
    Product
  };

  static double shade(const double* numbers, const ImagePixel& pixel, double& signal, double* by)
  {
    const bool bends = numbers[Square] != 0.0;
    const double cosine = bends ? std::cos(Degree * numbers[Turn]) : 1.0;
    const double sine = bends ? std::sin(Degree * numbers[Turn]) : 0.0;
    const double along = pixel.x * cosine + pixel.y * sine;
    if (by != nullptr)
    {
      by[AlongX] = pixel.x * signal;
      by[AlongY] = pixel.y * signal;
      by[Square] = 0.0; // turned() has it
      by[Turn] =
        Degree * 2.0 * numbers[Square] * along * (pixel.y * cosine - pixel.x * sine) * signal;
      by[SquareX] = pixel.x * pixel.x * signal;
      by[SquareY] = pixel.y * pixel.y * signal;
      by[Product] = pixel.x * pixel.y * signal;
    }
    const double factor =
      1.0 + numbers[AlongX] * pixel.x + numbers[AlongY] * pixel.y + numbers[Square] * along * along;
    signal *= factor;
    return factor;
  }

  // The square goes along the direction that is to be.
  static void turned(int n, const double*, const double* about, double* derivatives)
  {
    if (n != Square)
    {
      derivatives[n] = 1.0;
      return;
    }
    const double cosine = std::cos(Degree * about[Turn]);
    const double sine = std::sin(Degree * about[Turn]);
    derivatives[SquareX] = cosine * cosine;
    derivatives[SquareY] = sine * sine;
    derivatives[Product] = 2.0 * cosine * sine;
  }
};
}

Effect illuminationGradient()
{
  const EffectParameter alongX{ "along_x", "1", 0.0, -0.5, 0.5, 0.03,
    "gain from the middle to the edge in x" };
  const EffectParameter alongY{ "along_y", "1", 0.0, -0.5, 0.5, 0.03,
    "gain from the middle to the edge in y" };
  const EffectParameter square{ "square", "1", 0.0, -0.5, 0.5, 0.03,
    "gain at the edge, on both sides" };
  const EffectParameter turn{ "turn", "degrees", 0.0, -180.0, 180.0, 90.0,
    "of the line along which it grows, from the axis x towards the axis y" };
  const std::vector<ImageTerm> plane = { imageTerm(GradientOfImage::AlongX, alongX),
    imageTerm(GradientOfImage::AlongY, alongY) };
  const std::vector<double> turns = { 0.0, 45.0, 90.0, -45.0 };
  std::vector<ImageTerm> bent = plane;
  bent.push_back(imageTerm(GradientOfImage::Square, square));
  bent.push_back(imageTerm(GradientOfImage::Turn, turn));
  bent.back().starts = turns;
  std::vector<std::vector<double>> bentStarts;
  bentStarts.reserve(turns.size());
  for (const double degrees : turns)
  {
    bentStarts.push_back({ 0.0, 0.0, 0.0, degrees });
  }
  const std::vector<EffectParameter> anyShape = AnyShape::parameters();
  std::vector<ImageTerm> anyShapeOfImage;
  for (const EffectParameter& order : anyShape)
  {
    anyShapeOfImage.push_back(imageTerm(GradientOfImage::Numbers + anyShapeOfImage.size(), order));
    anyShapeOfImage.back().mayEnd = true;
  }
  Effect effect;
  effect.definition = { "illumination_gradient", "Illumination gradient",
    "More light on some parts of the field than on others.", EffectStage::Irradiance,
    EffectNeed::Position,
    { { "plane", "u (1 + along_x x + along_y y), x and y from -1 to 1 over the field",
        { alongX, alongY } },
      { "bent",
        "u (1 + along_x x + along_y y + square d^2), d = x cos turn + y sin turn: a lamp that is "
        "near, or two on opposite sides",
        { alongX, alongY, square, turn }, bentStarts },
      { "per_channel",
        "u_k (1 + along_x_k x + along_y_k y): lamps of different colours on the two sides",
        { alongX.ofLight(), alongY.ofLight() } },
      { "any_shape",
        "u (1 + sum of order_i_j P_i(x) P_j(y)), not below zero, P Legendre polynomials, i + j "
        "from 1 to 6: several lamps, reflectors, soft shadows",
        anyShape, {}, FormTrait::OfImages } },
    Captures::FlatField, EffectTrait::None,
    { { "plane", plane }, { "bent", bent },
      { "per_channel",
        { imageTerm(GradientOfImage::AlongX, alongX.ofLight()),
          imageTerm(GradientOfImage::AlongY, alongY.ofLight()) } },
      { "any_shape", anyShapeOfImage } } };
  effect.makeBlock = makeGradient;
  static const ImageStep step{ ImageStage::Lens,
    { { 0.0, ImageAxis::Position }, { 0.0, ImageAxis::Position }, {},
      { 0.0, ImageAxis::None, ImagePull::Kept } },
    GradientOfImage::shade, { ImageAxis::Position, ImageAxis::Position, ImageAxis::Position },
    GradientOfImage::turned };
  static const ImageStep ofAnyShape{ ImageStage::Lens, std::vector<ImageNumber>(AnyShape::Orders),
    AnyShape::shade };
  effect.onImage.steps = { &step, &ofAnyShape };
  return effect;
}

} // namespace msi
