#include "Kernels/Camera/Effects/SceneRun.h"

#include <cmath>
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

std::vector<char> finiteIn(const Eigen::MatrixXd& signal)
{
  std::vector<char> finite(static_cast<std::size_t>(signal.cols()));
  for (Eigen::Index j = 0; j < signal.cols(); ++j)
  {
    finite[static_cast<std::size_t>(j)] = signal.col(j).allFinite() ? 1 : 0;
  }
  return finite;
}
}

SceneRun::SceneRun(const EffectChain& chain, const SampleScene& scene)
  : Chain(chain)
  , Scene(scene)
{
  require();
  if (chain.needsMedium())
  {
    std::vector<int> known; // the chain's number of each medium of the scene
    for (const std::string& medium : scene.media())
    {
      known.push_back(chain.mediumNumber(medium));
    }
    for (const int medium : scene.medium())
    {
      Medium.push_back(known[static_cast<std::size_t>(medium)]);
    }
  }
}

void SceneRun::require() const
{
  std::ostringstream message;
  if (Scene.wavelengths() != Chain.camera().wavelengths())
  {
    const WavelengthGrid& ours = Chain.camera().wavelengths();
    message << "the scene has " << Scene.wavelengths().size() << " wavelengths from "
            << Scene.wavelengths().front() << " to " << Scene.wavelengths().back()
            << " nm, the camera " << ours.size() << " from " << ours.front() << " to "
            << ours.back() << "; resample one of them";
  }
  else if (Chain.needsPosition() && !Scene.hasPositions())
  {
    message << "an effect of the camera depends on the position, but the scene has no x and y";
  }
  else if (Chain.needsOrder() && !Scene.hasOrder())
  {
    message << "session_drift depends on the capture order, but the scene has no order";
  }
  else
  {
    return;
  }
  throw std::invalid_argument(message.str());
}

ColumnContext SceneRun::columns() const noexcept
{
  return { Medium.data(), Scene.fieldX().data(), Scene.fieldY().data(), Scene.time().data() };
}

Eigen::MatrixXd SceneRun::reflected() const
{
  Eigen::MatrixXd reflectance = Scene.reflectance();
  if (Chain.needsMedium())
  {
    Chain.reflect<double>(reflectance, columns());
  }
  return reflectance;
}

Eigen::MatrixXd SceneRun::reflected(const std::vector<Eigen::Index>& samples) const
{
  Eigen::MatrixXd reflectance = Scene.reflectance()(Eigen::all, samples);
  if (Chain.needsMedium())
  {
    std::vector<int> medium;
    medium.reserve(samples.size());
    for (const Eigen::Index sample : samples)
    {
      medium.push_back(Medium[static_cast<std::size_t>(sample)]);
    }
    Chain.reflect<double>(reflectance, { medium.data() }); // all that it asks for
  }
  return reflectance;
}

Eigen::MatrixXd SceneRun::integral() const
{
  return Chain.needsMedium() ? integral(reflected()) : integral(Scene.reflectance());
}

Eigen::MatrixXd SceneRun::integral(const Eigen::MatrixXd& reflected) const
{
  Eigen::MatrixXd signal(Chain.camera().channelCount(), reflected.cols());
  Chain.integrate(reflected.data(), signal.data(), reflected.cols());
  return signal;
}

void SceneRun::illuminate(Eigen::MatrixXd& signal, std::shared_ptr<const TailWeights>& tail) const
{
  Chain.illuminate<double>(signal, columns());
  if (const StrayLight* glare = Chain.veilingGlare())
  {
    glare->mix<double>(signal, ownSceneMean(signal, Scene));
  }
  if (const StrayLight* stray = Chain.localStrayLight())
  {
    const double reach = stray->reach();
    if (reach > 0.0)
    {
      std::vector<char> usable = finiteIn(signal);
      if (!tail || !tail->areFor(reach, usable))
      {
        tail = std::make_shared<const TailWeights>(Scene, reach, std::move(usable));
      }
      stray->mix<double>(signal, tail->mean(signal));
    }
    else
    {
      stray->mix<double>(signal, neighbourMean(signal, Scene));
    }
  }
}

void SceneRun::detect(Eigen::MatrixXd& signal) const
{
  Chain.detect<double>(signal, columns());
}

} // namespace msi
