#include "Kernels/Camera/CameraSimulator.h"

#include "Kernels/Camera/Effects/EffectChain.h"

#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
// Per scene the mean signal of its samples; a sample with a NaN takes no part.
Eigen::MatrixXd sceneMeans(const Eigen::MatrixXd& signal, const SampleScene& scene)
{
  const auto scenes = static_cast<Eigen::Index>(scene.scenes().size());
  Eigen::MatrixXd mean = Eigen::MatrixXd::Zero(signal.rows(), scenes);
  Eigen::VectorXd count = Eigen::VectorXd::Zero(scenes);
  for (Eigen::Index j = 0; j < signal.cols(); ++j)
  {
    if (signal.col(j).allFinite())
    {
      const int number = scene.scene()[static_cast<std::size_t>(j)];
      mean.col(number) += signal.col(j);
      count[number] += 1.0;
    }
  }
  return mean * count.cwiseMax(1.0).cwiseInverse().asDiagonal();
}

Eigen::MatrixXd ownSceneMean(const Eigen::MatrixXd& signal, const SampleScene& scene)
{
  const Eigen::MatrixXd means = sceneMeans(signal, scene);
  Eigen::MatrixXd surround(signal.rows(), signal.cols());
  for (Eigen::Index j = 0; j < signal.cols(); ++j)
  {
    surround.col(j) = means.col(scene.scene()[static_cast<std::size_t>(j)]);
  }
  return surround;
}

// The mean of a sample's neighbours; itself where it has none.
Eigen::MatrixXd neighbourMean(const Eigen::MatrixXd& signal, const SampleScene& scene)
{
  Eigen::MatrixXd surround(signal.rows(), signal.cols());
  for (Eigen::Index j = 0; j < signal.cols(); ++j)
  {
    Eigen::VectorXd sum = Eigen::VectorXd::Zero(signal.rows());
    double count = 0.0;
    for (const int neighbour : scene.neighbours()[static_cast<std::size_t>(j)])
    {
      if (signal.col(neighbour).allFinite())
      {
        sum += signal.col(neighbour);
        count += 1.0;
      }
    }
    surround.col(j) = count > 0.0 ? Eigen::VectorXd(sum / count) : Eigen::VectorXd(signal.col(j));
  }
  return surround;
}

// The mean of a sample's surround, weighted exp(-distance / reach); itself where it has none. reach: pitches.
Eigen::MatrixXd tailMean(const Eigen::MatrixXd& signal, const SampleScene& scene, double reach)
{
  std::vector<double> weight;
  weight.reserve(scene.distances().size());
  for (const double pitches : scene.distances())
  {
    weight.push_back(std::exp(-pitches / reach));
  }
  const auto finite = signal.array().isFinite().colwise().all().eval();
  Eigen::MatrixXd surround(signal.rows(), signal.cols());
  for (Eigen::Index j = 0; j < signal.cols(); ++j)
  {
    auto sum = surround.col(j);
    sum.setZero();
    double weights = 0.0;
    for (const SampleScene::Other& other : scene.surround()[static_cast<std::size_t>(j)])
    {
      if (finite[other.sample])
      {
        const double own = weight[static_cast<std::size_t>(other.distance)];
        sum += own * signal.col(other.sample);
        weights += own;
      }
    }
    if (weights > 0.0)
    {
      sum /= weights;
    }
    else
    {
      sum = signal.col(j);
    }
  }
  return surround;
}
}

struct CameraSimulator::Implementation
{
  EffectChain Chain;

  void requireKnown(const SampleScene& scene) const
  {
    std::ostringstream message;
    if (scene.wavelengths() != Chain.camera().wavelengths())
    {
      const WavelengthGrid& ours = Chain.camera().wavelengths();
      message << "the scene has " << scene.wavelengths().size() << " wavelengths from "
              << scene.wavelengths().front() << " to " << scene.wavelengths().back()
              << " nm, the camera " << ours.size() << " from " << ours.front() << " to "
              << ours.back() << "; resample one of them";
    }
    else if (Chain.needsPosition() && !scene.hasPositions())
    {
      message << "an effect of the camera depends on the position, but the scene has no x and y";
    }
    else if (Chain.needsOrder() && !scene.hasOrder())
    {
      message << "session_drift depends on the capture order, but the scene has no order";
    }
    else
    {
      return;
    }
    throw std::invalid_argument(message.str());
  }

  std::vector<int> mediumOf(const SampleScene& scene) const
  {
    std::vector<int> known;
    for (const std::string& medium : scene.media())
    {
      known.push_back(Chain.mediumNumber(medium));
    }
    std::vector<int> numbers;
    numbers.reserve(scene.medium().size());
    for (const int medium : scene.medium())
    {
      numbers.push_back(known[static_cast<std::size_t>(medium)]);
    }
    return numbers;
  }
};

CameraSimulator::CameraSimulator(
  CameraModel camera, std::vector<CameraEffect> effects, CameraSimulatorOptions options)
  : Self(new Implementation{
      EffectChain(std::move(camera), std::move(effects), options.whiteAfterEffects) })
{
}

CameraSimulator::~CameraSimulator() = default;
CameraSimulator::CameraSimulator(CameraSimulator&&) noexcept = default;
CameraSimulator& CameraSimulator::operator=(CameraSimulator&&) noexcept = default;

const CameraModel& CameraSimulator::camera() const noexcept
{
  return Self->Chain.camera();
}

const std::vector<CameraEffect>& CameraSimulator::effects() const noexcept
{
  return Self->Chain.effects();
}

const Eigen::MatrixXd& CameraSimulator::effectiveResponsivity() const noexcept
{
  return Self->Chain.responsivity();
}

Eigen::MatrixXd CameraSimulator::respond(const SampleScene& scene) const
{
  Self->requireKnown(scene);
  const EffectChain& chain = Self->Chain;
  const std::vector<int> medium = Self->mediumOf(scene);
  ColumnContext columns;
  columns.medium = medium.data();
  columns.fieldX = scene.fieldX().data();
  columns.fieldY = scene.fieldY().data();
  columns.time = scene.time().data();

  Eigen::MatrixXd response(chain.camera().channelCount(), scene.size());
  if (chain.needsMedium())
  {
    Eigen::MatrixXd reflectance = scene.reflectance();
    chain.reflect<double>(reflectance, columns);
    chain.integrate(reflectance.data(), response.data(), scene.size());
  }
  else
  {
    chain.integrate(scene.reflectance().data(), response.data(), scene.size());
  }
  chain.illuminate<double>(response, columns);
  if (const SurroundOperator* glare = chain.veilingGlare())
  {
    glare->apply(response, ConstBlock<double>(ownSceneMean(response, scene)));
  }
  if (const SurroundOperator* stray = chain.localStrayLight())
  {
    const std::optional<BoundEffect> effect = chain.active("local_stray_light");
    const Eigen::MatrixXd mean = effect->form().name == "tail"
      ? tailMean(response, scene, effect->value("reach"))
      : neighbourMean(response, scene);
    stray->apply(response, ConstBlock<double>(mean));
  }
  chain.detect<double>(response, columns);
  return response;
}

NoiseGenerator CameraSimulator::noiseGenerator(const CameraNoise& noise, std::uint64_t seed) const
{
  return Self->Chain.noiseGenerator(noise, seed);
}

Eigen::MatrixXd CameraSimulator::variance(
  const CameraNoise& noise, const Eigen::MatrixXd& response) const
{
  const NoiseGenerator generator = noiseGenerator(noise, 0);
  Eigen::MatrixXd variance(response.rows(), response.cols());
  for (Eigen::Index j = 0; j < response.cols(); ++j)
  {
    for (Eigen::Index k = 0; k < response.rows(); ++k)
    {
      variance(k, j) = generator.variance(k, response(k, j));
    }
  }
  return variance;
}

} // namespace msi
