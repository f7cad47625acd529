// A chart of square patches whose pixels have a closed form, so that it can be displaced without interpolation.
#pragma once

#include "Kernels/Camera/Imaging/ChannelDisplacement.h"
#include "Kernels/Numerics/Angle.h"

#include <cmath>
#include <cstdint>
#include <random>
#include <vector>

namespace msi::test
{

// Patches of 26 pixels with random values for every channel, and edges that are error functions of 1.2 pixels.
struct DisplacedChart
{
  ImageExtent extent;
  std::vector<ChannelDisplacement> displacements; // one per channel
  double noise = 0.0;
  unsigned seed = 1;

  PixelBuffer pixels(const ImageWindow& window) const
  {
    std::mt19937 generator(seed);
    std::normal_distribution<double> normal;
    PixelBuffer buffer;
    buffer.resize(window, static_cast<int>(displacements.size()));
    const double middleX = 0.5 * (extent.width - 1);
    const double middleY = 0.5 * (extent.height - 1);
    for (int y = window.y; y < window.y + window.height; ++y)
    {
      for (int x = window.x; x < window.x + window.width; ++x)
      {
        for (std::size_t k = 0; k < displacements.size(); ++k)
        {
          const ChannelDisplacement& d = displacements[k];
          const double cosine = std::cos(d.rotation * Degree) / (1.0 + d.magnification);
          const double sine = std::sin(d.rotation * Degree) / (1.0 + d.magnification);
          const double offX = x - middleX - d.right;
          const double offY = y - middleY - d.down;
          const double value = sceneAt(
            middleX + cosine * offX + sine * offY, middleY + cosine * offY - sine * offX, k);
          buffer.pixel(x, y)[k] = static_cast<float>(value + noise * normal(generator));
        }
      }
    }
    return buffer;
  }

private:
  static double patch(int column, int row, std::size_t channel)
  {
    // A multiplicative hash: patches are asked for at every pixel.
    std::uint32_t hash = 7919U * static_cast<std::uint32_t>(channel + 1) +
      131U * static_cast<std::uint32_t>(column + 500) +
      52711U * static_cast<std::uint32_t>(row + 500);
    for (int i = 0; i < 3; ++i)
    {
      hash = (hash ^ (hash >> 15U)) * 0x2c1b3c6dU;
    }
    return 0.05 + 0.85 * static_cast<double>(hash >> 8U) / static_cast<double>(1U << 24U);
  }

  static double sceneAt(double x, double y, std::size_t channel)
  {
    constexpr double Pitch = 26.0;
    constexpr double Blur = 1.2;
    const auto column = static_cast<int>(std::floor(x / Pitch - 0.5));
    const auto row = static_cast<int>(std::floor(y / Pitch - 0.5));
    const auto edge = [](double distance)
    { return 0.5 * (1.0 + std::erf(distance / (Blur * std::sqrt(2.0)))); };
    const double a = edge(x - Pitch * (column + 1));
    const double b = edge(y - Pitch * (row + 1));
    return (1.0 - a) * (1.0 - b) * patch(column, row, channel) +
      a * (1.0 - b) * patch(column + 1, row, channel) +
      (1.0 - a) * b * patch(column, row + 1, channel) + a * b * patch(column + 1, row + 1, channel);
  }
};

} // namespace msi::test
