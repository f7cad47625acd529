// The numbers of a model of image pairs, and which of them a form of an effect sets.
#pragma once

#include "Kernels/Camera/Imaging/ImageWindow.h"

#include <string>
#include <vector>

namespace msi
{

inline constexpr int TailPasses = 6;
inline constexpr int FreePasses = TailPasses - 1; // the first is too narrow to be told from a blur

enum class ImageParameter
{
  Gain,
  Dark,
  Glare,
  ConservingGlare,
  GradientRight,
  GradientDown,
  GradientBend, // times the square of the place along the gradient's direction
  Falloff,      // loss at rho = 1 that grows with rho^2, rho from the center
  Fourth,
  Sixth,
  CenterX,
  CenterY,
  Square,
  Exponent,
  Compression,
  Clip, // 1: the rounded clipping at ClipLevel; parts of it only on the way there
  ClipLevel,
  Retained,
  FromPrevious, // times the difference of the channel before to this one
  FromNext,
  Right,
  Down,
  Magnification,
  Rotation,     // degrees, right towards down
  BlurVariance, // pixels^2
  TailFraction,
  TailRadius,
  SurroundFirst, // weights of single passes of the tail: any shape
  SurroundLast = SurroundFirst + FreePasses - 1,
  RowSine, // u (1 + sine sin(2 pi row / period) + cosine cos(2 pi row / period))
  RowCosine,
  ColumnSine,
  ColumnCosine,
  RowGain, // times FieldProfile::gain of the row
  RowOffset,
  ColumnGain,
  ColumnOffset,
  Light // strength of the first of imageLights(); those of the others follow
};

struct ImagePlace
{
  int x, y;
};

// The pixel whose light falls on a pixel, too. Within the image for every pixel of it.
using LightFrom = ImagePlace (*)(const ImagePlace& pixel, const ImageExtent& extent);

// Of the effects that bring light from elsewhere in the image, in the order of the library: their parameters are
// imageLight(0), imageLight(1), ...
const std::vector<LightFrom>& imageLights();
constexpr ImageParameter imageLight(std::size_t number) noexcept
{
  return static_cast<ImageParameter>(static_cast<std::size_t>(ImageParameter::Light) + number);
}

// The weight of single pass i + 1 of the tail, counted from 0.
constexpr ImageParameter surroundWeight(int i) noexcept
{
  return static_cast<ImageParameter>(static_cast<int>(ImageParameter::SurroundFirst) + i);
}

// How the number of the image model follows from the library's.
enum class ImageScale
{
  Same,
  Squared,   // it is the square
  AlongSlope // it is the library's times the squared length of (right, down)
};

// One number of an image form, or one for every channel.
struct ImageTerm
{
  ImageParameter parameter;
  bool perChannel;
  double lower, upper, typical;
  std::string name = {}; // of the form's parameter; empty: the library has no such number
  std::string unit = {};
  ImageScale scale = ImageScale::Same;
};

// What a pair of images shows of one form of an effect.
struct ImageForm
{
  std::string form;
  std::vector<ImageTerm> terms;
};

} // namespace msi
