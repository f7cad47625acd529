// The parameters of everything that an image pair can show.
#pragma once

#include "Kernels/Camera/ImageTerm.h"
#include "Kernels/Gap/Field/FieldPair.h"

#include <Eigen/Core>

#include <memory>
#include <string>
#include <vector>

namespace msi
{

// Stripes of any shape: a number for each line and channel, lines x K. One such array for each fold, without what that fold's
// blocks say, and last one from all of them.
struct FieldProfile
{
  std::vector<Eigen::ArrayXXd> gain, offset;

  // fold: -1 for blocks outside all folds.
  const Eigen::ArrayXXd& gainFor(int fold) const { return fold < 0 ? gain.back() : gain[at(fold)]; }
  const Eigen::ArrayXXd& offsetFor(int fold) const
  {
    return fold < 0 ? offset.back() : offset[at(fold)];
  }

private:
  static std::size_t at(int fold) noexcept { return static_cast<std::size_t>(fold); }
};

// How many there are.
inline std::size_t fieldParameterCount()
{
  return static_cast<std::size_t>(ImageParameter::Light) + imageLights().size();
}

// One number of each parameter for every channel; parameters common to the channels repeat.
//
// Order: gradient and vignetting; misregistration; defocus; local stray light; veiling glare; lag; banding;
//        gain; nonlinearity; dark offset; saturation: that of ImageSimulator.
struct FieldModel
{
  explicit FieldModel(Eigen::Index channels = 0);

  Eigen::ArrayXd& operator[](ImageParameter parameter)
  {
    return Values[static_cast<std::size_t>(parameter)];
  }
  const Eigen::ArrayXd& operator[](ImageParameter parameter) const
  {
    return Values[static_cast<std::size_t>(parameter)];
  }
  double at(ImageParameter parameter, Eigen::Index channel) const
  {
    return Values[static_cast<std::size_t>(parameter)][channel];
  }
  bool isNeutral(ImageParameter parameter) const;
  bool hasVignetting() const;
  // 1 + g n + bend n^2, n the place along the gradient (right, down), g its length
  double gradient(double x, double y) const noexcept;
  // 1 - falloff rho^2 - fourth rho^4 - sixth rho^6, not below zero
  double vignetting(double x, double y) const noexcept;
  double fieldFactor(double x, double y) const noexcept
  {
    return gradient(x, y) * vignetting(x, y);
  }

  double rowPeriod = 0.0; // 0: none
  double columnPeriod = 0.0;
  std::shared_ptr<const FieldProfile> rows, columns; // null: none

private:
  std::vector<Eigen::ArrayXd> Values;
};

// What stripes do in `count` rows, or columns, of one channel from `first` on; without stripes nothing.
struct FieldLines
{
  // fold: FieldProfile::gainFor.
  FieldLines(
    const FieldModel& model, bool ofRows, Eigen::Index channel, int fold, int first, int count);

  Eigen::ArrayXd factor, added; // of the light; the response has (1 + factor) light + added
  Eigen::ArrayXd sine, cosine, gain, offset; // what the parameters of these names multiply
};

double neutralValue(ImageParameter parameter) noexcept;

// A shape that another parameter turns on: without it, it changes nothing.
constexpr bool isShape(ImageParameter parameter) noexcept
{
  return parameter == ImageParameter::TailRadius || parameter == ImageParameter::ClipLevel;
}

// What the detector answers to a signal, and the derivatives of the answer.
struct DetectorAnswer
{
  double value;
  double bySignal;
  double bySquare; // of the quadratic, and minus that by the compression
  double byExponent;
  double byOffset;
  double byClip;
  double byClipLevel;
};

class FieldDetector
{
public:
  FieldDetector(const FieldModel& model, Eigen::Index channel);

  DetectorAnswer operator()(double signal) const noexcept;

private:
  double Square, Exponent, Compression, Dark, Clip, Level;
};

// A rounded min(u, level): that of the effect saturation, whose softness is held.
inline constexpr double ClipSoftness = 0.01;

} // namespace msi
