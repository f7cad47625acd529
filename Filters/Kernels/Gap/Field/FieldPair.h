// A real and a simulated image of the same scene.
#pragma once

#include "Kernels/Camera/Imaging/ImageWindow.h"

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <string>
#include <vector>

namespace msi
{

// Responses relative to white, pixel after pixel, all channels of a pixel together. NaN: no value. The simulated image is
// without noise. labels: one number a pixel, 0 for none; may be null.
struct FieldPair
{
  ImageExtent extent;
  std::vector<std::string> channels; // K names
  const float* real = nullptr;
  const float* simulated = nullptr;
  const int* labels = nullptr;

  std::size_t pixels() const noexcept { return wholeImage(extent).pixels(); }
  std::size_t index(int x, int y) const noexcept
  {
    return static_cast<std::size_t>(y) * static_cast<std::size_t>(extent.width) +
      static_cast<std::size_t>(x);
  }
  // (x, y) from -1 to 1 over the longer side, from pixel center to pixel center: as ImageSimulator.
  double fieldX(double x) const noexcept { return offX(x) / half(); }
  double fieldY(double y) const noexcept { return offY(y) / half(); }
  // From the middle, in pixels.
  double offX(double x) const noexcept { return x - 0.5 * (extent.width - 1); }
  double offY(double y) const noexcept { return y - 0.5 * (extent.height - 1); }

private:
  double half() const noexcept
  {
    return 0.5 * std::max(1, std::max(extent.width, extent.height) - 1);
  }
};

// Sums over pixels that have a value in both images.
struct PairSums
{
  double n = 0.0, real = 0.0, simulated = 0.0;
  double realSquares = 0.0, simulatedSquares = 0.0, products = 0.0;

  void add(float realValue, float simulatedValue) noexcept
  {
    const auto r = static_cast<double>(realValue);
    const auto s = static_cast<double>(simulatedValue);
    if (std::isfinite(r) && std::isfinite(s))
    {
      n += 1.0;
      real += r;
      simulated += s;
      realSquares += r * r;
      simulatedSquares += s * s;
      products += r * s;
    }
  }
  // About the means.
  double ofReal() const noexcept { return realSquares - real * real / count(); }
  double ofSimulated() const noexcept { return simulatedSquares - simulated * simulated / count(); }
  double ofBoth() const noexcept { return products - real * simulated / count(); }

private:
  double count() const noexcept { return std::fmax(n, 1.0); }
};

} // namespace msi
