// What an effect does to a model of image pairs: its numbers, its step, and which of the numbers a form of it sets.
#pragma once

#include "Kernels/Camera/Imaging/ImageDisplacement.h"
#include "Kernels/Camera/Imaging/ImageWindow.h"

#include <cstddef>
#include <string>
#include <string_view>
#include <vector>

namespace msi
{

inline constexpr int TailPasses = 6; // of the surround, each twice as wide as the one before

struct ImagePlace
{
  int x, y;
};

// The pixel whose light falls on a pixel, too. Within the image for every pixel of it.
using LightFrom = ImagePlace (*)(const ImagePlace& pixel, const ImageExtent& extent);

// What a fit does with a number that the data say little of.
enum class ImagePull
{
  Neutral, // pulls it to its neutral value
  Itself,  // leaves it where it is; without its effect it is neutral
  Kept,    // leaves it where it is, also without its effect: alone it changes nothing
  Found // as Kept; it has no useful derivative at its neutral value, a search in the residual finds it
};

// Axes of the gap that a derivative belongs to. Bits.
namespace ImageAxis
{
enum Bit : unsigned
{
  None = 0,
  Channel = 1U << 0,
  Level = 1U << 1,
  Position = 1U << 2,
  Edges = 1U << 3,
  Rows = 1U << 4,
  Columns = 1U << 5
};
}

struct ImageNumber
{
  double neutral = 0.0;
  unsigned axes = ImageAxis::None;
  ImagePull pull = ImagePull::Neutral;
};

// From -1 for the first channel to 1 for the last; 0 where there is one.
inline double channelPlace(std::ptrdiff_t channel, std::ptrdiff_t channels) noexcept
{
  const double parts = static_cast<double>(channels) - 1.0;
  return parts > 0.0 ? 2.0 * static_cast<double>(channel) / parts - 1.0 : 0.0;
}

// Of a row or a column of the image, in one channel.
struct ImageLine
{
  double sine = 0.0, cosine = 0.0; // of the model's period at this line
  double gain = 0.0, offset = 0.0; // of the model's profile
};

// What a step is told of a pixel in one channel.
struct ImagePixel
{
  double x = 0.0, y = 0.0;                     // from -1 to 1 over the longer side
  double fromMiddleX = 0.0, fromMiddleY = 0.0; // pixels
  // Change of the scene by a displacement of one pixel to the right, one down, and by a variance of blur.
  double right = 0.0, down = 0.0, blur = 0.0;
  const double* surround = nullptr;    // the passes of the tail, TailPasses
  const double* tailWeights = nullptr; // ImageStep::tail
  double mean = 0.0;                   // of the scene
  double channel = 0.0;                // channelPlace()
  double elsewhere = 0.0;              // light at ImageFactories::lightFrom
  double self = 0.0;                   // the light on the detector here
  const double* previous = nullptr;    // and in the channels before and behind; null: there is none
  const double* next = nullptr;
  double ofAll = 0.0; // mean of the light over the channels
  ImageLine row, column;
};

// Steps act in this order, those of one stage in the order of the library.
enum class ImageStage
{
  Scene,    // moved and blurred before they act
  Surround, // mixed with its surround
  Lens,     // factors over the field
  Light,    // light that is added
  Exposure, // light of the channels before and behind
  Lines,    // rows and columns
  Detector
};

// One step of the model: the numbers of an effect, or of effects that share them. `numbers` are those of one channel.
struct ImageStep
{
  ImageStage stage;
  std::vector<ImageNumber> numbers;
  // Changes the signal and returns the derivative by it. by: derivatives by the numbers, then the further ones; null: not asked.
  double (*apply)(
    const double* numbers, const ImagePixel& pixel, double& signal, double* by) = nullptr;
  // More functions of the pixel in which change() can write derivatives, by their axes.
  std::vector<unsigned> further = {};
  // Derivative by number n in terms of those that apply() gave at `numbers`, where the numbers are `about`. null: its own.
  void (*change)(int n, const double* numbers, const double* about, double* derivatives) = nullptr;
  // Of the stages Scene and Surround: how the scene is moved (the numbers are then the parameters of the library's form, in its order),
  // its variance of blur (pixels^2), weights of the passes of its surround.
  void (*displace)(const double* numbers, ImageDisplacement& displacement) = nullptr;
  double (*blurVariance)(const double* numbers) = nullptr;
  void (*tail)(const double* numbers, double* weights) = nullptr;
  // The numbers that move the scene so.
  void (*place)(const ImageDisplacement& displacement, double* numbers) = nullptr;

  std::size_t width() const { return numbers.size() + further.size(); }
};

// A step with its place among all.
struct PlacedStep
{
  const ImageStep* step;
  LightFrom from;     // null: none
  std::size_t number; // of its first number
  std::size_t column; // of its first derivative
};

// Of the effects of the library, in the order in which they act.
const std::vector<PlacedStep>& imageSteps();

// Place of a number among those of all steps.
using ImageParameter = std::size_t;
// By the library's names. Errors: std::invalid_argument for one that images do not show.
ImageParameter imageParameter(std::string_view effect, std::string_view name);
const PlacedStep& stepOf(ImageParameter parameter);

// One number of an image form, or one for every channel.
struct ImageTerm
{
  ImageParameter parameter; // in an effect's own file: place among the numbers of its steps
  bool perChannel;
  double lower, upper, typical;
  std::string name = {}; // of the form's parameter; empty: the library has no such number
  std::string unit = {};
  bool squared = false;            // it is the square of the library's number
  bool followsLight = false;       // EffectParameter::followsLight
  bool mayEnd = false;             // it makes up a shape: the end of its range tells nothing
  std::vector<double> starts = {}; // values to start from while the step is neutral; empty: its own
};

// What a pair of images shows of one form of an effect.
struct ImageForm
{
  std::string form;
  std::vector<ImageTerm> terms;
  bool brightens = false; // contains a gain common to all channels
};

} // namespace msi
