#include "Kernels/Scenes/Samples.h"

#include "Kernels/Numerics/CounterRandom.h"
#include "Kernels/Scenes/Colorants.h"
#include "Kernels/Scenes/KubelkaMunk.h"

#include <array>
#include <cmath>
#include <stdexcept>

namespace msi::scenes
{

namespace
{
enum : std::uint32_t
{
  Recipe = 1,
  Amount,
  Batch
};

std::string numbered(const std::string& stem, int number, int count)
{
  std::string digits = std::to_string(number);
  return stem + std::string(std::to_string(count).size() - digits.size(), '0') + digits;
}

// Absorption of a set of colorants, one column each.
Eigen::ArrayXXd absorptions(
  const std::vector<Colorant>& colorants, const WavelengthGrid& wavelengths)
{
  Eigen::ArrayXXd all(wavelengths.size(), static_cast<Eigen::Index>(colorants.size()));
  for (std::size_t i = 0; i < colorants.size(); ++i)
  {
    all.col(static_cast<Eigen::Index>(i)) = absorption(colorants[i], wavelengths);
  }
  return all;
}

constexpr Eigen::Index Black = 3; // in paperInks()
}

Swatches printedChart(const WavelengthGrid& wavelengths, int patchCount, std::uint64_t seed)
{
  if (patchCount != 24 && patchCount != 140)
  {
    throw std::invalid_argument(
      "a printed chart has 24 or 140 patches, not " + std::to_string(patchCount));
  }
  const CounterRandom recipe(seed, Recipe);
  const CounterRandom amount(seed, Amount);
  const Eigen::ArrayXXd ink = absorptions(paperInks(), wavelengths);
  const Eigen::ArrayXd stock = paperStock(wavelengths);
  const int greys = patchCount == 24 ? 6 : 14;
  const int singles = patchCount == 24 ? 9 : 45;
  const auto inkCount = static_cast<int>(ink.cols());
  const int chromatic = inkCount - 1;
  const auto chromaticInk = [](int i) { return Eigen::Index{ i < Black ? i : i + 1 }; };

  Swatches chart;
  chart.body.resize(wavelengths.size(), patchCount);
  for (int i = 0; i < patchCount; ++i)
  {
    const auto index = static_cast<std::uint64_t>(i);
    Eigen::ArrayXd q = stock;
    if (i < greys)
    {
      // Even steps of lightness come from K/S that grows about geometrically.
      if (i > 0)
      {
        q += 0.006 * std::pow(18.0 / 0.006, (i - 1) / (greys - 2.0)) * ink.col(Black);
      }
    }
    else if (i < greys + singles)
    {
      const int step = (i - greys) / chromatic;
      const int steps = singles / chromatic;
      const double strength = steps == 1 ? 2.5 : 0.12 * std::pow(6.0 / 0.12, step / (steps - 1.0));
      q += strength * ink.col(chromaticInk((i - greys) % chromatic));
    }
    else
    {
      const int first = static_cast<int>(recipe.uniform(index, 0) * chromatic);
      const int offset = 1 + static_cast<int>(recipe.uniform(index, 1) * (chromatic - 1));
      const int second = (first + offset) % chromatic;
      q += 0.10 * std::pow(60.0, amount.uniform(index, 0)) * ink.col(chromaticInk(first));
      q += 0.10 * std::pow(60.0, amount.uniform(index, 1)) * ink.col(chromaticInk(second));
      if (recipe.uniform(index, 2) < 0.25)
      {
        q += 0.4 * amount.uniform(index, 2) * ink.col(Black);
      }
    }
    chart.body.col(i) = opaqueReflectance(q);
    chart.name.push_back(numbered("paper-", i + 1, patchCount));
  }
  return chart;
}

Swatches dyedFabric(const WavelengthGrid& wavelengths, int sampleCount, std::uint64_t seed)
{
  const CounterRandom recipe(seed, Recipe);
  const CounterRandom amount(seed, Amount);
  const CounterRandom batch(seed, Batch);
  const Eigen::ArrayXXd dye = absorptions(fabricDyes(), wavelengths);
  const Eigen::ArrayXd cotton = bleachedCotton(wavelengths);
  const auto dyeCount = static_cast<double>(dye.cols());

  Swatches fabric;
  fabric.body.resize(wavelengths.size(), sampleCount);
  for (int i = 0; i < sampleCount; ++i)
  {
    const auto index = static_cast<std::uint64_t>(i);
    // One depth of shade for the bath, shared out over one to three dyes.
    const double depth = 0.7 * std::pow(90.0, amount.uniform(index, 3));
    const int dyes = 1 + static_cast<int>(recipe.uniform(index, 3) * 3.0);
    std::array<double, 3> share{};
    double total = 0.0;
    for (int d = 0; d < dyes; ++d)
    {
      const auto lane = static_cast<unsigned>(d);
      share[lane] = 0.1 + amount.uniform(index, lane);
      total += share[lane];
    }
    Eigen::ArrayXd q = cotton * (1.0 + 0.2 * batch.normal(index));
    for (int d = 0; d < dyes; ++d)
    {
      const auto lane = static_cast<unsigned>(d);
      const auto which = static_cast<Eigen::Index>(recipe.uniform(index, lane) * dyeCount);
      q += depth * share[lane] / total * dye.col(which);
    }
    fabric.body.col(i) = opaqueReflectance(q.max(0.001));
    fabric.name.push_back(numbered("fabric-", i + 1, sampleCount));
  }
  return fabric;
}

Eigen::VectorXd dyedCotton(
  const WavelengthGrid& wavelengths, const std::string& dye, double concentration)
{
  for (const Colorant& candidate : fabricDyes())
  {
    if (candidate.name == dye)
    {
      return opaqueReflectance(
        bleachedCotton(wavelengths) + concentration * absorption(candidate, wavelengths));
    }
  }
  throw std::invalid_argument("there is no fabric dye named '" + dye + "'");
}

Eigen::MatrixXd tartanYarns(const WavelengthGrid& wavelengths)
{
  Eigen::MatrixXd yarns(wavelengths.size(), 4);
  yarns << dyedCotton(wavelengths, "olive", 4.0), dyedCotton(wavelengths, "scarlet", 6.0),
    dyedCotton(wavelengths, "navy", 12.0), dyedCotton(wavelengths, "lemon", 0.03);
  return yarns;
}

} // namespace msi::scenes
