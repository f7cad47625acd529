#include "Kernels/Gap/Field/FieldData.h"

#include <algorithm>
#include <cmath>
#include <vector>

namespace msi
{

namespace
{
constexpr double OtherUnit = 5.0;   // times
constexpr double Correlated = 0.25; // squared
constexpr std::size_t MostPixels = std::size_t(1) << 20;
}

Eigen::ArrayXd fieldUnits(const FieldPair& pair)
{
  const std::size_t K = pair.channels.size();
  struct Sums
  {
    double n = 0.0, r = 0.0, s = 0.0, rs = 0.0, rr = 0.0, ss = 0.0;
  };
  std::vector<Sums> sums(K);
  const std::size_t step = 1 + pair.pixels() / MostPixels;
  for (std::size_t i = 0; i < pair.pixels(); i += step)
  {
    for (std::size_t k = 0; k < K; ++k)
    {
      const auto real = static_cast<double>(pair.real[i * K + k]);
      const auto simulated = static_cast<double>(pair.simulated[i * K + k]);
      if (std::isfinite(real) && std::isfinite(simulated))
      {
        Sums& sum = sums[k];
        sum.n += 1.0;
        sum.r += real;
        sum.s += simulated;
        sum.rs += real * simulated;
        sum.rr += real * real;
        sum.ss += simulated * simulated;
      }
    }
  }
  Eigen::ArrayXd ratio(static_cast<Eigen::Index>(K));
  for (std::size_t k = 0; k < K; ++k)
  {
    const Sums& sum = sums[k];
    const double n = std::fmax(sum.n, 1.0);
    const double both = sum.rs - sum.r * sum.s / n;
    const double simulated = sum.ss - sum.s * sum.s / n;
    const double real = sum.rr - sum.r * sum.r / n;
    // A straight line where the images go together, else through the origin.
    const bool line = both > 0.0 && both * both > Correlated * real * simulated;
    ratio[static_cast<Eigen::Index>(k)] =
      line ? both / std::fmax(simulated, 1e-30) : sum.rs / std::fmax(sum.ss, 1e-30);
  }
  const auto alike = [](const Eigen::ArrayXd& values)
  { return (values >= 1.0 / OtherUnit).all() && (values <= OtherUnit).all(); };
  if (alike(ratio) || !(ratio > 0.0).all())
  {
    return Eigen::ArrayXd::Ones(ratio.size());
  }
  std::vector<double> sorted(ratio.begin(), ratio.end());
  std::sort(sorted.begin(), sorted.end());
  const double common = sorted[sorted.size() / 2];
  return alike(ratio / common) ? Eigen::ArrayXd(Eigen::ArrayXd::Constant(ratio.size(), common))
                               : ratio;
}

} // namespace msi
