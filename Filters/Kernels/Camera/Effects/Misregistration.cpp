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

  static const ImageStep& step()
  {
    static const ImageStep made{ ImageStage::Scene,
      { { 0.0, ImageAxis::Edges }, { 0.0, ImageAxis::Edges }, {}, {} }, moved, {}, nullptr,
      displace };
    return made;
  }
};
}

Effect misregistration()
{
  const std::vector<EffectParameter> parameters = { { "right", "pixels", 0.0, -20.0, 20.0, 0.5,
                                                      "displacement in x", true },
    { "down", "pixels", 0.0, -20.0, 20.0, 0.5, "displacement in y", true },
    { "magnification", "1", 0.0, -0.1, 0.1, 0.001, "relative growth of the image", true },
    { "rotation", "degrees", 0.0, -5.0, 5.0, 0.1,
      "turn from the axis x towards the axis y of the image", true } };
  const ImageTerm right = imageTerm(MisregistrationOfImage::Right, parameters[0]);
  const ImageTerm down = imageTerm(MisregistrationOfImage::Down, parameters[1]);
  const ImageTerm magnification = imageTerm(MisregistrationOfImage::Magnification, parameters[2]);
  const ImageTerm rotation = imageTerm(MisregistrationOfImage::Rotation, parameters[3]);
  Effect effect;
  effect.definition = { "misregistration", "Misregistration",
    "The channels' images do not lie on one another: filters of different thickness and wedge, "
    "chromatic difference of magnification.",
    EffectStage::Image, EffectNeed::Nothing,
    { { "per_channel",
      "every channel is turned and magnified about the middle of the field, then displaced",
      parameters } },
    { "grid target for each filter" }, EffectTrait::ActsOnEdges,
    { { "per_channel", { right, down } }, { "per_channel", { right, down, magnification } },
      { "per_channel", { right, down, magnification, rotation } } } };
  effect.onImage.step = &MisregistrationOfImage::step();
  return effect;
}

} // namespace msi
