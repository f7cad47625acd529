#include "Kernels/Scenes/Measuring.h"

#include "Kernels/Numerics/CounterRandom.h"
#include "Kernels/Scenes/KubelkaMunk.h"

namespace msi::scenes
{

namespace
{
enum : std::uint32_t
{
  Mounting = 21,
  Yarn,
  Repeatability,
  Place
};

// Surface of coated paper and of a fibre.
constexpr double PaperOutside = 0.040;
constexpr double PaperInside = 0.45;
constexpr double PaperSpecularSeen =
  0.35; // semi-matte: part of the surface light leaves at 0 degrees
constexpr double RepeatabilityOfReading = 0.0008;
// Colorant on the spot that the camera averages, against the spot in the spectrophotometer's port.
constexpr double PaperUnevenness = 0.025;
constexpr double FabricUnevenness = 0.015;
constexpr int MeasuredPixels = 40;

Eigen::MatrixXd reading(const Eigen::MatrixXd& spectra, std::uint64_t seed)
{
  const WavelengthGrid fine = sceneGrid();
  const WavelengthGrid report = reportGrid();
  const CounterRandom noise(seed, Repeatability);
  Eigen::MatrixXd result(report.size(), spectra.cols());
  const auto first = static_cast<Eigen::Index>((report.front() - fine.front()) / *fine.step());
  for (Eigen::Index s = 0; s < spectra.cols(); ++s)
  {
    for (Eigen::Index j = 0; j < report.size(); ++j)
    {
      const Eigen::Index center = first + 2 * j;
      const auto index = static_cast<std::uint64_t>(s * report.size() + j);
      result(j, s) = 0.25 * spectra(center - 1, s) + 0.5 * spectra(center, s) +
        0.25 * spectra(center + 1, s) + RepeatabilityOfReading * noise.normal(index);
    }
  }
  return result;
}

// The same samples at another place: a little more or less colorant.
Eigen::MatrixXd elsewhere(const Eigen::MatrixXd& body, double unevenness, std::uint64_t seed)
{
  const CounterRandom place(seed, Place);
  Eigen::MatrixXd result(body.rows(), body.cols());
  for (Eigen::Index s = 0; s < body.cols(); ++s)
  {
    const double amount = 1.0 + unevenness * place.normal(static_cast<std::uint64_t>(s));
    result.col(s) = opaqueReflectance(amount * absorptionOf(body.col(s).array()));
  }
  return result;
}
}

WavelengthGrid sceneGrid()
{
  return WavelengthGrid::uniform(380.0, 740.0, 5.0);
}

WavelengthGrid reportGrid()
{
  return WavelengthGrid::uniform(400.0, 700.0, 10.0);
}

Eigen::MatrixXd measuredPaper(const Eigen::MatrixXd& body, std::uint64_t seed)
{
  Eigen::MatrixXd spectra(body.rows(), body.cols());
  for (Eigen::Index s = 0; s < body.cols(); ++s)
  {
    spectra.col(s) = throughSurface(body.col(s).array(), PaperOutside, PaperInside, 1.0);
  }
  return reading(spectra, seed);
}

Eigen::MatrixXd measuredFabric(const Eigen::MatrixXd& body, std::uint64_t seed)
{
  // Diffuse light reaches every part of the weave; the fibre surface adds its own reflection.
  return reading((FibreSurface + (1.0 - FibreSurface) * body.array()).matrix(), seed);
}

Eigen::MatrixXd seenPaper(const Eigen::MatrixXd& measuredBody, std::uint64_t seed)
{
  const Eigen::MatrixXd body = elsewhere(measuredBody, PaperUnevenness, seed);
  Eigen::MatrixXd seen(body.rows(), body.cols());
  for (Eigen::Index s = 0; s < body.cols(); ++s)
  {
    seen.col(s) = paperTowardsCamera(body.col(s).array());
  }
  return seen;
}

Eigen::ArrayXd paperTowardsCamera(const Eigen::ArrayXd& body)
{
  return throughSurface(body, PaperOutside, PaperInside, PaperSpecularSeen);
}

Eigen::MatrixXd seenFabric(const Eigen::MatrixXd& measuredBody, std::uint64_t seed)
{
  const Eigen::MatrixXd body = elsewhere(measuredBody, FabricUnevenness, seed);
  Eigen::MatrixXd seen(body.rows(), body.cols());
  for (Eigen::Index s = 0; s < body.cols(); ++s)
  {
    const auto swatch = static_cast<int>(s);
    const Weave weave = weaveOf(swatch, seed);
    const std::uint64_t texture = seed + 1000U * static_cast<std::uint64_t>(s + 1);
    Eigen::ArrayXd sum = Eigen::ArrayXd::Zero(body.rows());
    for (int y = 0; y < MeasuredPixels; ++y)
    {
      for (int x = 0; x < MeasuredPixels; ++x)
      {
        sum += seenThrough(weavePoint(weave, x, y, texture), body.col(s).array());
      }
    }
    seen.col(s) = FibreSurface + sum / (MeasuredPixels * MeasuredPixels);
  }
  return seen;
}

Weave weaveOf(int swatch, std::uint64_t seed)
{
  const CounterRandom mounting(seed, Mounting);
  const CounterRandom yarn(seed, Yarn);
  const auto index = static_cast<std::uint64_t>(swatch);
  const auto [light, cavity] = mounting.normalPair(index);
  Weave weave;
  weave.twill = yarn.uniform(index, 0) < 0.6 ? 1 : 2;
  weave.yarnWidth = 3.6 + 1.6 * yarn.uniform(index, 1);
  weave.meanShade *= 1.0 + 0.005 * light;
  weave.meanCavity *= 1.0 + 0.03 * cavity;
  return weave;
}

} // namespace msi::scenes
