// A scene whose straight lines are not straight in the image, or whose parallels converge.
#include "Kernels/Camera/Effects/Effect.h"

#include <string>
#include <vector>

namespace msi
{

namespace
{
// Its step on image pairs; the numbers are parts of ImageDisplacement.
struct DistortionOfImage
{
  enum Number : std::size_t
  {
    Radial,
    KeystoneRight,
    KeystoneDown,
    Aspect,
    Shear
  };

  static double moved(const double*, const ImagePixel& pixel, double&, double* by)
  {
    if (by != nullptr)
    {
      const double outwards = pixel.fromMiddleX * pixel.right + pixel.fromMiddleY * pixel.down;
      by[Radial] = (pixel.x * pixel.x + pixel.y * pixel.y) * outwards;
      by[KeystoneRight] = pixel.x * outwards;
      by[KeystoneDown] = pixel.y * outwards;
      by[Aspect] = pixel.fromMiddleX * pixel.right - pixel.fromMiddleY * pixel.down;
      by[Shear] = pixel.fromMiddleY * pixel.right + pixel.fromMiddleX * pixel.down;
    }
    return 1.0;
  }

  static void displace(const double* numbers, ImageDisplacement& displacement)
  {
    displacement.radial = numbers[Radial];
    displacement.keystoneRight = numbers[KeystoneRight];
    displacement.keystoneDown = numbers[KeystoneDown];
    displacement.aspect = numbers[Aspect];
    displacement.shear = numbers[Shear];
  }
};

EffectParameter growth(const std::string& name, double typical, const std::string& text)
{
  return { name, "1", 0.0, -0.1, 0.1, typical, text };
}
}

Effect distortion()
{
  const std::vector<EffectParameter> parameters = {
    growth(
      "radial", 0.005, "growth at the end of the longer side, with the square of the distance"),
    growth("keystone_x", 0.005, "growth at the right end of the longer side, linear"),
    growth("keystone_y", 0.005, "the same in y"),
    growth("aspect", 0.002, "growth in x, and as much less in y"),
    growth("shear", 0.002, "displacement in x by y, and in y by x")
  };
  const auto term = [&](std::size_t number) { return imageTerm(number, parameters[number]); };
  using Image = DistortionOfImage;
  const std::vector<ImageTerm> view = { term(Image::KeystoneRight), term(Image::KeystoneDown),
    term(Image::Aspect), term(Image::Shear) };
  std::vector<ImageTerm> all = view;
  all.insert(all.begin(), term(Image::Radial));
  Effect effect;
  effect.definition = { "distortion", "Distortion",
    "Straight lines of the scene are curved, or parallels converge: a lens that magnifies "
    "otherwise towards the edges, a camera that does not look straight at the scene.",
    EffectStage::Image, EffectNeed::Nothing,
    { { "common",
      "what lies at p from the middle (as a fraction of half of the longer side) comes to "
      "p (1 + radial p^2 + keystone_x x + keystone_y y), and by aspect (x, -y) + "
      "shear (y, x) farther",
      parameters } },
    { "grid target" }, EffectTrait::ActsOnEdges,
    { { "common", { term(Image::Radial) } }, { "common", view }, { "common", all } } };
  const ImageNumber edges{ 0.0, ImageAxis::Edges };
  static const ImageStep step{ ImageStage::Scene, { edges, edges, edges, edges, edges },
    DistortionOfImage::moved, {}, nullptr, DistortionOfImage::displace };
  effect.onImage.steps = { &step };
  return effect;
}

} // namespace msi
