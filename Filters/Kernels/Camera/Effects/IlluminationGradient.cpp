// More light on one side of the field than on the other.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Camera/Effects/FieldOperator.h"

#include <cmath>
#include <vector>

namespace msi
{

namespace
{
class IlluminationGradient : public FieldOperator<IlluminationGradient>
{
public:
  explicit IlluminationGradient(const BoundEffect& effect)
    : AlongX(effect.value("along_x"))
    , AlongY(effect.value("along_y"))
    , Bend(effect.form().name == "bent" ? effect.value("bend") : 0.0)
  {
  }
  double factor(double x, double y) const noexcept
  {
    const double plane = AlongX * x + AlongY * y;
    return 1.0 + plane + Bend * plane * plane;
  }

private:
  double AlongX;
  double AlongY;
  double Bend;
};
}

namespace
{
// Its step on image pairs.
struct GradientOfImage
{
  enum Number : std::size_t
  {
    Along,
    Across,
    Bent,    // times the square of the place along the slope
    SquareX, // further derivatives
    SquareY,
    Product
  };

  static double square(const double* numbers)
  {
    return numbers[Along] * numbers[Along] + numbers[Across] * numbers[Across];
  }

  static double shade(const double* numbers, const ImagePixel& pixel, double& signal, double* by)
  {
    const double plane = numbers[Along] * pixel.x + numbers[Across] * pixel.y;
    const double size2 = square(numbers);
    const double bend = size2 > 0.0 ? numbers[Bent] / size2 : 0.0;
    if (by != nullptr)
    {
      // The place along the slope, and how it turns.
      const double place2 = size2 > 0.0 ? plane * plane / size2 : 0.0;
      by[Along] = (pixel.x + 2.0 * bend * (plane * pixel.x - place2 * numbers[Along])) * signal;
      by[Across] = (pixel.y + 2.0 * bend * (plane * pixel.y - place2 * numbers[Across])) * signal;
      by[Bent] = place2 * signal;
      by[SquareX] = pixel.x * pixel.x * signal;
      by[SquareY] = pixel.y * pixel.y * signal;
      by[Product] = pixel.x * pixel.y * signal;
    }
    const double factor = 1.0 + plane + bend * plane * plane;
    signal *= factor;
    return factor;
  }

  // Without a slope the bend goes along that which is to be.
  static void alongSlope(int n, const double* numbers, const double* about, double* derivatives)
  {
    const double size2 = square(about);
    if (n == Bent && !(square(numbers) > 0.0) && size2 > 0.0)
    {
      derivatives[SquareX] = about[Along] * about[Along] / size2;
      derivatives[SquareY] = about[Across] * about[Across] / size2;
      derivatives[Product] = 2.0 * about[Along] * about[Across] / size2;
      return;
    }
    derivatives[n] = 1.0;
  }

  static constexpr double LeastSquare = 1e-8;

  static double bySlope(const double* numbers)
  {
    return 1.0 / std::fmax(square(numbers), LeastSquare);
  }

  static const ImageStep& step()
  {
    static const ImageStep made{ ImageStage::Lens,
      { { 0.0, ImageAxis::Position }, { 0.0, ImageAxis::Position }, { 0.0 } }, shade,
      { ImageAxis::Position, ImageAxis::Position, ImageAxis::Position }, alongSlope };
    return made;
  }
};
}

Effect illuminationGradient()
{
  const EffectParameter alongX{ "along_x", "1", 0.0, -0.5, 0.5, 0.03,
    "gain from the middle to the edge in x" };
  const EffectParameter alongY{ "along_y", "1", 0.0, -0.5, 0.5, 0.03,
    "gain from the middle to the edge in y" };
  const EffectParameter bend{ "bend", "1", 0.0, -10.0, 10.0, 1.0,
    "1 / 2 for an exponential, 3 / 4 for the inverse square of a distance", false, true };
  const std::vector<ImageTerm> plane = { imageTerm(GradientOfImage::Along, alongX),
    imageTerm(GradientOfImage::Across, alongY) };
  std::vector<ImageTerm> bent = plane;
  // Of the square of the place along the slope, whatever the slope is.
  bent.push_back({ GradientOfImage::Bent, false, -0.3, 0.3, 0.03, bend.name, bend.unit, false,
    GradientOfImage::bySlope });
  Effect effect;
  effect.definition = { "illumination_gradient", "Illumination gradient",
    "More light on one side of the field than on the other.", EffectStage::Irradiance,
    EffectNeed::Position,
    { { "plane", "u (1 + along_x x + along_y y), x and y from -1 to 1 over the field",
        { alongX, alongY } },
      { "bent", "u (1 + s + bend s^2), s = along_x x + along_y y: a lamp that is near",
        { alongX, alongY, bend } } },
    Captures::FlatField, EffectTrait::None, { { "plane", plane }, { "bent", bent, true } } };
  effect.makeBlock = makeBlockOperator<IlluminationGradient>;
  effect.onImage.step = &GradientOfImage::step();
  return effect;
}

} // namespace msi
