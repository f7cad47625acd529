// Channels whose images do not lie on one another.
#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Numerics/Angle.h"

#include <vector>

namespace msi
{

namespace
{
// Its step on image pairs.
struct MisregistrationOfImage
{
  enum Number : std::size_t
  {
    Right,
    Down,
    Magnification,
    Rotation
  };

  // The scene comes moved.
  static double moved(const double*, const ImagePixel& pixel, double&, double* by)
  {
    if (by != nullptr)
    {
      by[Right] = pixel.right;
      by[Down] = pixel.down;
      by[Magnification] = pixel.fromMiddleX * pixel.right + pixel.fromMiddleY * pixel.down;
      by[Rotation] = Degree * (pixel.fromMiddleX * pixel.down - pixel.fromMiddleY * pixel.right);
    }
    return 1.0;
  }

  static void displace(const double* numbers, ImageDisplacement& displacement)
  {
    displacement.right = numbers[Right];
    displacement.down = numbers[Down];
    displacement.magnification = numbers[Magnification];
    displacement.rotation = numbers[Rotation];
  }

  static void place(const ImageDisplacement& displacement, double* numbers)
  {
    numbers[Right] = displacement.right;
    numbers[Down] = displacement.down;
    numbers[Magnification] = displacement.magnification;
    numbers[Rotation] = displacement.rotation;
  }
};
}

Effect misregistration()
{
  const std::vector<EffectParameter> common = { { "along_x", "pixels", 0.0, -20.0, 20.0, 0.5,
                                                  "displacement in x" },
    { "along_y", "pixels", 0.0, -20.0, 20.0, 0.5, "displacement in y" },
    { "magnification", "1", 0.0, -0.1, 0.1, 0.001, "relative growth of the image" },
    { "rotation", "degrees", 0.0, -5.0, 5.0, 0.1,
      "turn from the axis x towards the axis y of the image" } };
  std::vector<EffectParameter> ofChannels;
  ofChannels.reserve(common.size());
  for (const EffectParameter& parameter : common)
  {
    ofChannels.push_back(parameter.ofChannels());
  }
  // The first so many numbers.
  const auto form = [&](bool perChannel, std::size_t count)
  {
    ImageForm made{ perChannel ? "per_channel" : "common", {} };
    for (std::size_t number = 0; number < count; ++number)
    {
      made.terms.push_back(imageTerm(number, (perChannel ? ofChannels : common)[number]));
    }
    return made;
  };
  Effect effect;
  effect.definition = { "misregistration", "Misregistration",
    "The channels' images do not lie on one another, or all of them not on the scene: filters of "
    "different thickness and wedge, chromatic difference of magnification, a camera that was "
    "moved.",
    EffectStage::Image, EffectNeed::Nothing,
    { { "per_channel",
        "every channel is turned and magnified about the middle of the field, then displaced",
        ofChannels },
      { "common", "all channels alike", common } },
    { "grid target for each filter" }, EffectTrait::ActsOnEdges,
    { form(false, 2), form(false, 4), form(true, 2), form(true, 3), form(true, 4) } };
  static const ImageStep step{ ImageStage::Scene,
    { { 0.0, ImageAxis::Edges }, { 0.0, ImageAxis::Edges }, {}, {} }, MisregistrationOfImage::moved,
    {}, nullptr, MisregistrationOfImage::displace, nullptr, nullptr,
    MisregistrationOfImage::place };
  effect.onImage.steps = { &step };
  return effect;
}

} // namespace msi
