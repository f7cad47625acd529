// The broad tail of a point spread.
#pragma once

#include "Kernels/Camera/Imaging/ImageWindow.h"
#include "Kernels/Camera/Imaging/RowConvolution.h"

#include <vector>

namespace msi
{

// The B3 spline (1, 4, 6, 4, 1) / 16 with its taps `stride` pixels apart, the same in every channel.
SymmetricKernel splineKernel(int channels, int stride);

// Pixels around a window that the result depends on after so many of them, with strides of 1, 2, 4, ...
constexpr int splineReach(int passes)
{
  return 2 * ((1 << passes) - 1);
}

// Standard deviation along an axis after so many of them, in pixels.
double splineDeviation(int passes);

// A point spread T of sum one that falls from a few pixels to several radii.
//
// A sum of ever wider kernels: splineKernel() applied with strides of 1, 2, 4, ... pixels
// ("a trous": M. Holschneider et al., in Wavelets, Springer 1989, doi:10.1007/978-3-642-97177-8_28). After n
// passes the variance along an axis is (4^n - 1) / 3. The kernel of pass n has the weight
// 2^-n exp(-deviation_n / (2 radius)), scaled to sum one.
// Range:  radius from 1 to 64 pixels (std::invalid_argument).
// Cost:   about 10 multiplications a value and pass, whatever its width.
class ScatterTail
{
public:
  explicit ScatterTail(double radius);
  // Of any weights of the passes, the first with a stride of one.
  explicit ScatterTail(const std::vector<double>& weights);

  // Pixels around a window that its result depends on.
  int reach() const noexcept;
  const std::vector<float>& weights() const noexcept { return Weights; }

  // tail = T buffer. Edges as in convolve().
  void operator()(const PixelBuffer& buffer, PixelBuffer& tail) const;

private:
  std::vector<float> Weights; // of pass 1, 2, ...
};

// The weights of a tail in so many passes, whose last has those of all beyond; the radius cut to the range.
std::vector<double> passWeights(double radius, std::size_t passes);

// The same of an image that comes row by row: the same bytes, and memory for the rows that the tail spans alone.
class ScatterRows
{
public:
  // For an image of this many pixels; forgets the rows of the image before, keeps their memory.
  void begin(const ScatterTail& tail, int channels, int width, int height);

  // As RowConvolution::push().
  template <typename Emit>
  void push(const float* row, const Emit& emit)
  {
    pass(0, row, emit);
  }

private:
  template <typename Emit>
  void pass(std::size_t number, const float* row, const Emit& emit)
  {
    Passes[number].push(row,
      [&](const float* out)
      {
        float* sum = add(number, out);
        if (number + 1 < Weights.size())
        {
          pass(number + 1, out, emit);
          return;
        }
        emit(static_cast<const float*>(sum));
      });
  }
  // Adds a row that a pass gave to its sum.
  float* add(std::size_t number, const float* out);

  std::vector<float> Weights;
  std::vector<RowConvolution> Passes;
  std::vector<int> Given; // rows, of each pass
  std::size_t Count = 0;  // values of a row
  RowRing Sums;           // between the first pass and the last
};

} // namespace msi
