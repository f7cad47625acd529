// More light on one side of the field than on the other.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Numerics/Angle.h"

#include <cmath>
#include <memory>
#include <vector>

namespace msi
{

namespace
{
std::unique_ptr<BlockOperator> makeGradient(const BoundEffect& effect)
{
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
    SquareX, // further derivatives
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
  Effect effect;
  effect.definition = { "illumination_gradient", "Illumination gradient",
    "More light on one side of the field than on the other.", EffectStage::Irradiance,
    EffectNeed::Position,
    { { "plane", "u (1 + along_x x + along_y y), x and y from -1 to 1 over the field",
        { alongX, alongY } },
      { "bent",
        "u (1 + along_x x + along_y y + square d^2), d = x cos turn + y sin turn: a lamp that is "
        "near, or two on opposite sides",
        { alongX, alongY, square, turn }, bentStarts },
      { "per_channel",
        "u_k (1 + along_x_k x + along_y_k y): lamps of different colours on the two sides",
        { alongX.ofLight(), alongY.ofLight() } } },
    Captures::FlatField, EffectTrait::None,
    { { "plane", plane }, { "bent", bent },
      { "per_channel",
        { imageTerm(GradientOfImage::AlongX, alongX.ofLight()),
          imageTerm(GradientOfImage::AlongY, alongY.ofLight()) } } } };
  effect.makeBlock = makeGradient;
  static const ImageStep step{ ImageStage::Lens,
    { { 0.0, ImageAxis::Position }, { 0.0, ImageAxis::Position }, {},
      { 0.0, ImageAxis::None, ImagePull::Kept } },
    GradientOfImage::shade, { ImageAxis::Position, ImageAxis::Position, ImageAxis::Position },
    GradientOfImage::turned };
  effect.onImage.step = &step;
  return effect;
}

} // namespace msi
