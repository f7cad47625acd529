// Image pairs with known effects, rendered on a finer grid by plain loops that share no code with the library's simulator.
#pragma once

#include "Kernels/Gap/Field/FieldGap.h"
#include "Kernels/Numerics/CounterRandom.h"

#include <cmath>
#include <functional>
#include <string>
#include <utility>
#include <vector>

namespace msi::test
{

inline constexpr double Pi = 3.14159265358979323846;

struct ImagePlane
{
  int width = 0;
  int height = 0;
  std::vector<double> value;

  double& at(int x, int y)
  {
    return value[static_cast<std::size_t>(y) * static_cast<std::size_t>(width) +
      static_cast<std::size_t>(x)];
  }
  double read(int x, int y) const
  {
    const int u = std::min(std::max(x, 0), width - 1);
    const int v = std::min(std::max(y, 0), height - 1);
    return value[static_cast<std::size_t>(v) * static_cast<std::size_t>(width) +
      static_cast<std::size_t>(u)];
  }
};

// Random cosines, patches with soft edges, each channel with contrasts of its own.
class TestScene
{
public:
  static constexpr int Fine = 3; // samples a pixel along each axis

  TestScene(std::uint64_t seed, int channelCount = 3, int columns = 176, int rows = 144)
    : Width(columns)
    , Height(rows)
    , Channels(channelCount)
  {
    const CounterRandom random(seed, 5);
    for (std::uint64_t i = 0; i < 6; ++i)
    {
      const double angle = 2.0 * Pi * random.uniform(i, 1);
      Waves.push_back({ 5.0 + 40.0 * random.uniform(i, 0), std::cos(angle), std::sin(angle),
        ofChannels(random, 100 + i * 16) });
    }
    for (std::uint64_t i = 0; i < 14; ++i)
    {
      Patches.push_back(
        { Width * random.uniform(300 + i, 0) - 10.0, Height * random.uniform(300 + i, 1) - 10.0,
          12.0 + 35.0 * random.uniform(300 + i, 2), ofChannels(random, 500 + i * 16) });
    }
  }

  int width() const { return Width; }
  int height() const { return Height; }
  int channels() const { return Channels; }

  // The light at a place in pixels; pixel centers are whole numbers.
  double light(int channel, double x, double y) const
  {
    const auto k = static_cast<std::size_t>(channel);
    double sum = 0.35;
    for (const Wave& wave : Waves)
    {
      const double own = wave.own[k];
      sum += 0.02 * own *
        std::cos(2.0 * Pi * (x * wave.right + y * wave.down) / wave.period + 6.0 * own);
    }
    for (const Patch& patch : Patches)
    {
      const double across = edge(x - patch.left) - edge(x - patch.left - patch.side);
      if (across != 0.0)
      {
        sum += (0.6 * patch.own[k] - 0.25) * across *
          (edge(y - patch.top) - edge(y - patch.top - patch.side));
      }
    }
    return std::fmax(sum, 0.02);
  }

  // The channel on the finer grid, looked at through moved(x, y).
  ImagePlane fine(int channel,
    const std::function<std::pair<double, double>(double, double)>& moved = nullptr) const
  {
    ImagePlane plane{ Width * Fine, Height * Fine, {} };
    plane.value.resize(
      static_cast<std::size_t>(plane.width) * static_cast<std::size_t>(plane.height));
    for (int j = 0; j < plane.height; ++j)
    {
      for (int i = 0; i < plane.width; ++i)
      {
        std::pair<double, double> place{ (i + 0.5) / Fine - 0.5, (j + 0.5) / Fine - 0.5 };
        place = moved ? moved(place.first, place.second) : place;
        plane.at(i, j) = light(channel, place.first, place.second);
      }
    }
    return plane;
  }

  ImagePlane pixels(const ImagePlane& fine) const
  {
    ImagePlane plane{ Width, Height, {} };
    plane.value.resize(static_cast<std::size_t>(Width) * static_cast<std::size_t>(Height));
    for (int y = 0; y < Height; ++y)
    {
      for (int x = 0; x < Width; ++x)
      {
        double sum = 0.0;
        for (int j = 0; j < Fine; ++j)
        {
          for (int i = 0; i < Fine; ++i)
          {
            sum += fine.read(x * Fine + i, y * Fine + j);
          }
        }
        plane.at(x, y) = sum / (Fine * Fine);
      }
    }
    return plane;
  }

  // From -1 to 1 over the longer side.
  double fieldX(int x) const
  {
    return (x - 0.5 * (Width - 1)) / (0.5 * (std::max(Width, Height) - 1));
  }
  double fieldY(int y) const
  {
    return (y - 0.5 * (Height - 1)) / (0.5 * (std::max(Width, Height) - 1));
  }

private:
  struct Wave
  {
    double period, right, down;
    std::vector<double> own; // of each channel
  };
  struct Patch
  {
    double left, top, side;
    std::vector<double> own; // of each channel
  };

  std::vector<double> ofChannels(const CounterRandom& random, std::uint64_t counter) const
  {
    std::vector<double> own;
    for (int k = 0; k < Channels; ++k)
    {
      own.push_back(random.uniform(counter + static_cast<std::uint64_t>(k), 0));
    }
    return own;
  }

  // A soft step of 0.7 pixels.
  static double edge(double distance)
  {
    if (std::fabs(distance) > 5.0)
    {
      return distance < 0.0 ? 0.0 : 1.0;
    }
    return 0.5 * (1.0 + std::erf(distance / (0.7 * std::sqrt(2.0))));
  }

  int Width;
  int Height;
  int Channels;
  std::vector<Wave> Waves;
  std::vector<Patch> Patches;
};

inline ImagePlane gaussianBlurred(const ImagePlane& plane, double deviation)
{
  const int reach = static_cast<int>(std::ceil(4.0 * deviation));
  std::vector<double> kernel;
  double sum = 0.0;
  for (int i = -reach; i <= reach; ++i)
  {
    kernel.push_back(std::exp(-0.5 * i * i / (deviation * deviation)));
    sum += kernel.back();
  }
  ImagePlane across = plane;
  for (int y = 0; y < plane.height; ++y)
  {
    for (int x = 0; x < plane.width; ++x)
    {
      double value = 0.0;
      for (int i = -reach; i <= reach; ++i)
      {
        const int tap = i + reach;
        value += kernel[static_cast<std::size_t>(tap)] * plane.read(x + i, y);
      }
      across.at(x, y) = value / sum;
    }
  }
  ImagePlane both = plane;
  for (int y = 0; y < plane.height; ++y)
  {
    for (int x = 0; x < plane.width; ++x)
    {
      double value = 0.0;
      for (int i = -reach; i <= reach; ++i)
      {
        const int tap = i + reach;
        value += kernel[static_cast<std::size_t>(tap)] * across.read(x, y + i);
      }
      both.at(x, y) = value / sum;
    }
  }
  return both;
}

inline double meanOf(const ImagePlane& plane)
{
  double sum = 0.0;
  for (const double value : plane.value)
  {
    sum += value;
  }
  return sum / static_cast<double>(plane.value.size());
}

struct TestPair
{
  ImageExtent extent;
  std::vector<std::string> channels;
  std::vector<float> real, simulated;
  std::vector<int> labels;

  FieldPair pair() const
  {
    return { extent, channels, real.data(), simulated.data(),
      labels.empty() ? nullptr : labels.data() };
  }
};

// The real image is real(channel), a pixel plane; noise: standard deviation at u = 0 and of shot noise at u = 1.
inline TestPair makePair(const TestScene& scene, const std::function<ImagePlane(int)>& real,
  std::uint64_t seed, double read = 0.003, double shot = 0.003)
{
  TestPair pair;
  pair.extent = { scene.width(), scene.height() };
  const auto K = static_cast<std::size_t>(scene.channels());
  const std::size_t pixels = wholeImage(pair.extent).pixels();
  pair.real.resize(pixels * K);
  pair.simulated.resize(pixels * K);
  for (std::size_t k = 0; k < K; ++k)
  {
    pair.channels.push_back("C" + std::to_string(k + 1));
    const ImagePlane nominal = scene.pixels(scene.fine(static_cast<int>(k)));
    const ImagePlane answered = real(static_cast<int>(k));
    const CounterRandom random(seed, 40 + static_cast<std::uint32_t>(k));
    for (std::size_t i = 0; i < pixels; ++i)
    {
      const double u = answered.value[i];
      const double deviation = std::sqrt(read * read + shot * shot * std::fmax(u, 0.0));
      pair.simulated[i * K + k] = static_cast<float>(nominal.value[i]);
      pair.real[i * K + k] = static_cast<float>(u + deviation * random.normal(i));
    }
  }
  return pair;
}

inline const GapParameter* findParameter(
  const GapReport& report, const std::string& effect, const std::string& parameter)
{
  for (const GapCause& cause : report.causes)
  {
    for (const GapParameter& candidate : cause.parameters)
    {
      if (cause.effect == effect && candidate.name == parameter)
      {
        return &candidate;
      }
    }
  }
  return nullptr;
}

} // namespace msi::test
