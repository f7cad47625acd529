// One effect: its definition and how to make its operators. Every effect has a file of its own, named after it.
#pragma once

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Camera/Effects/BoundEffect.h"
#include "Kernels/Camera/Effects/EffectOperators.h"

#include <Eigen/Core>

#include <functional>
#include <memory>
#include <vector>

namespace msi
{

class ScatterTail;
struct SymmetricKernel;

// What is told of the surround of a pixel or sample, for stray light.
enum class Surround
{
  Scene, // the mean of the whole scene
  Near   // the neighbours: on an image the tail of the point spread
};

// Changes a run of pixels from (x, y) to the right, K x P, in place. A pixel's bytes depend on the pixel alone.
using PixelOperator = std::function<void(Eigen::Map<Eigen::MatrixXf> run, int x, int y)>;

// `steps` are what the diagnosis of image pairs does, and how the channels are moved. Of the others at most one is set: then they are
// blurred, scattered, get light from elsewhere in the image, and change pixel by pixel.
struct ImageFactories
{
  SymmetricKernel (*makeBlur)(const BoundEffect&) = nullptr;
  ScatterTail (*makeTail)(const BoundEffect&) = nullptr;
  LightFrom lightFrom = nullptr; // times the first parameter of the form
  PixelOperator (*makePixels)(const BoundEffect&) = nullptr;
  std::vector<const ImageStep*> steps = {}; // live as long as the program
};

// Of the first three factories exactly one is set, none for noise and effects of images alone.
struct Effect
{
  EffectDefinition definition;
  std::unique_ptr<ResponsivityOperator> (*makeResponsivity)(const BoundEffect&) = nullptr;
  std::unique_ptr<BlockOperator> (*makeBlock)(const BoundEffect&) = nullptr;
  StrayLight (*makeStrayLight)(const BoundEffect&) = nullptr;
  bool afterDark = false; // a detector effect that acts on u with the dark response in it
  Surround surround = Surround::Scene;
  ImageFactories onImage = {};
};

// The term of an image form for a parameter of the library's form: the same name, bounds and size. number: among those of the effect's steps.
ImageTerm imageTerm(std::size_t number, const EffectParameter& of);

// Of an effect with ImageFactories::lightFrom: its strength is the only number.
ImageStep stepOfLight();

template <typename Operator>
std::unique_ptr<ResponsivityOperator> makeResponsivityOperator(const BoundEffect& effect)
{
  return std::make_unique<Operator>(effect);
}
template <typename Operator>
std::unique_ptr<BlockOperator> makeBlockOperator(const BoundEffect& effect)
{
  return blockOperator(Operator(effect));
}

// All effects in the order in which they act; the definitions are those of effectLibrary(), at the same positions.
const std::vector<Effect>& effectRegistry();
const Effect& registered(const EffectDefinition& definition);

} // namespace msi
