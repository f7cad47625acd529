// Moves the image of each channel.
#pragma once

#include "Kernels/Camera/Imaging/ImageDisplacement.h"
#include "Kernels/Camera/Imaging/ImageWindow.h"
#include "Kernels/Camera/Imaging/RowRing.h"

#include <Eigen/Core>

#include <cstddef>
#include <vector>

namespace msi
{

// Cubic convolution, R. G. Keys, IEEE Trans. ASSP 29 (1981) 1153, doi:10.1109/TASSP.1981.1163711 (a = -1/2): weights of the
// four pixels around a place that lies t behind the second of them.
template <typename Number>
Eigen::Array<Number, 4, 1> cubicConvolution(Number t)
{
  const Number t2 = t * t;
  const Number t3 = t2 * t;
  return Number(0.5) *
    Eigen::Array<Number, 4, 1>(2 * t2 - t - t3, 2 - 5 * t2 + 3 * t3, t + 4 * t2 - 3 * t3, t3 - t2);
}

// Their derivatives by t.
template <typename Number>
Eigen::Array<Number, 4, 1> cubicConvolutionSlope(Number t)
{
  const Number t2 = t * t;
  return Number(0.5) *
    Eigen::Array<Number, 4, 1>(
      4 * t - 1 - 3 * t2, 9 * t2 - 10 * t, 1 + 8 * t - 9 * t2, 3 * t2 - 2 * t);
}

// Weights of the six pixels around a place that lies t behind the third of them: the cubic through the middle four, and of the
// fourth differences on both sides the part farthestWeight(). It has a continuous derivative with a first factor of t (1 - t)^2 / 12
// (with that alone it is the kernel of fourth order in Keys's paper); the second makes it sharper: its weights are within .01 of
// those of a Lanczos window with three lobes that is made exact for cubics.
template <typename Number>
Number farthestWeight(Number t)
{
  return t * (1 - t) * (1 - t) * (1 + 3 * t) / 12;
}
template <typename Number>
using SixPoints = Eigen::Array<Number, 6, 1>;
template <typename Number>
SixPoints<Number> withFourthDifferences(const SixPoints<Number>& cubic, Number left, Number right)
{
  return cubic + left * SixPoints<Number>(1, -4, 6, -4, 1, 0) +
    right * SixPoints<Number>(0, 1, -4, 6, -4, 1);
}
template <typename Number>
SixPoints<Number> sixPointConvolution(Number t)
{
  const SixPoints<Number> cubic(0, -t * (t - 1) * (t - 2) / 6, (t + 1) * (t - 1) * (t - 2) / 2,
    -(t + 1) * t * (t - 2) / 2, (t + 1) * t * (t - 1) / 6, 0);
  return withFourthDifferences(cubic, farthestWeight(t), farthestWeight(1 - t));
}

// Their derivatives by t.
template <typename Number>
SixPoints<Number> sixPointConvolutionSlope(Number t)
{
  const auto slope = [](Number s) { return (1 - s) * (1 + 3 * s - 12 * s * s) / 12; };
  const Number square = 3 * t * t;
  const SixPoints<Number> cubic(0, -(square - 6 * t + 2) / 6, (square - 4 * t - 1) / 2,
    -(square - 2 * t - 2) / 2, (square - 1) / 6, 0);
  return withFourthDifferences(cubic, slope(t), -slope(1 - t));
}

// Each pixel of channel k gets the value of its ShownPlace.
//
// Interpolation: sixPointConvolution(): exact for cubics, the identity for whole pixels.
// NaN:    spreads over the pixels that all channels together read; where one is turned or distorted over those that its channel reads.
// Edges: the image's edge repeats; near a cut edge of a buffer the result is provisional (see reach()).
class ChannelRegistration
{
public:
  ChannelRegistration(std::vector<ImageDisplacement> displacements, const ImageExtent& extent);

  // Pixels around a window that its result depends on.
  int reach() const noexcept { return Reach; }

  // In place; scratch is resized to the buffer.
  void operator()(PixelBuffer& buffer, PixelBuffer& scratch) const;

private:
  friend class RegistrationRows;

  std::vector<ImageDisplacement> Displacements;
  ImageExtent Extent;
  int Reach = 0;
};

// The same of an image that comes row by row: the same bytes, and memory for the rows that are read alone.
class RegistrationRows
{
public:
  // For the rows of this window; forgets those of the window before, keeps their memory.
  void begin(const ChannelRegistration& registration, const ImageWindow& window);

  // As RowConvolution::push().
  template <typename Emit>
  void push(const float* row, const Emit& emit)
  {
    take(row);
    while (hasNext())
    {
      emit(next());
    }
  }

private:
  // Neighbouring positions that read the same number of pixels away: the first of them, and how far the first pixel
  // that they read lies from their own.
  struct Run
  {
    int first;
    int offset;
  };

  void beginAlongAxes();
  void take(const float* row);
  bool hasNext() const noexcept
  {
    return Given < Window.height && (Taken == Window.height || Given + Reach < Taken);
  }
  const float* next();
  // A row of turned channels: each pixel reads 6 x 6 of its channel.
  void turnRow(int y);

  ImageWindow Window;
  ImageExtent Extent;
  std::vector<ImageDisplacement> Displacements;
  bool Turned = false; // or distorted
  int Reach = 0;
  std::size_t Channels = 0;
  std::size_t Count = 0; // values of a row
  // Of every value of a row; tap by tap, zero where a channel does not read what another one does.
  std::vector<float> Weights;
  std::size_t Taps = 0;
  std::vector<Run> Runs;
  std::size_t Margin = 0;        // pixels that rows are padded with
  std::vector<float> RowWeights; // as Weights, for a tile of pixels in one row
  int Taken = 0;                 // rows
  int Given = 0;
  RowRing Ring; // rows moved along x; as they came where a channel is turned
  std::vector<float> Padded, Out;
  std::vector<const float*> Sources;
};

} // namespace msi
