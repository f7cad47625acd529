#include "Kernels/Camera/SampleScene.h"

#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <stdexcept>
#include <unordered_map>

namespace msi
{

namespace
{
constexpr double NeighbourReach = 1.5;
constexpr double DistanceStep = 1e-7; // pitches

void requireCount(const char* what, Eigen::Index given, Eigen::Index samples)
{
  if (given != 0 && given != samples)
  {
    reject("the scene has ", samples, " samples but ", given, " values of ", what);
  }
}

void requireFinite(const char* what, const Eigen::VectorXd& values)
{
  for (Eigen::Index i = 0; i < values.size(); ++i)
  {
    if (!std::isfinite(values[i]))
    {
      reject("the ", what, " of sample ", i + 1, " is ", values[i], "; expected a finite number");
    }
  }
}

std::vector<int> numbered(
  const std::vector<std::string>& names, std::size_t count, std::vector<std::string>& distinct)
{
  std::vector<int> numbers(count, 0);
  for (std::size_t i = 0; i < names.size(); ++i)
  {
    const auto found = std::find(distinct.begin(), distinct.end(), names[i]);
    numbers[i] = static_cast<int>(found - distinct.begin());
    if (found == distinct.end())
    {
      distinct.push_back(names[i]);
    }
  }
  if (distinct.empty())
  {
    distinct.emplace_back();
  }
  return numbers;
}
}

SampleScene::SampleScene(WavelengthGrid wavelengths, SceneSamples samples)
  : Grid(std::move(wavelengths))
  , Samples(std::move(samples))
{
  const Eigen::Index count = Samples.reflectance.cols();
  if (Samples.reflectance.rows() != Grid.size())
  {
    reject("the scene's reflectances have ", Samples.reflectance.rows(),
      " wavelengths, their grid ", Grid.size());
  }
  requireCount("medium", static_cast<Eigen::Index>(Samples.medium.size()), count);
  requireCount("scene", static_cast<Eigen::Index>(Samples.scene.size()), count);
  requireCount("x", Samples.x.size(), count);
  requireCount("y", Samples.y.size(), count);
  requireCount("order", Samples.order.size(), count);
  if ((Samples.x.size() > 0) != (Samples.y.size() > 0))
  {
    throw std::invalid_argument("the scene has only one of x and y; a position needs both");
  }
  requireFinite("x", Samples.x);
  requireFinite("y", Samples.y);
  requireFinite("order", Samples.order);
  MediumOf = numbered(Samples.medium, static_cast<std::size_t>(count), Media);
  SceneOf = numbered(Samples.scene, static_cast<std::size_t>(count), Scenes);
  if (count > 0 && hasPositions())
  {
    placeInField();
    findNeighbours();
  }
  if (count > 0 && hasOrder())
  {
    const double first = Samples.order.minCoeff();
    const double range = Samples.order.maxCoeff() - first;
    Time = range > 0.0 ? Eigen::VectorXd((Samples.order.array() - first) / range)
                       : Eigen::VectorXd(Eigen::VectorXd::Zero(count));
  }
}

void SampleScene::placeInField()
{
  const auto middle = [](const Eigen::VectorXd& v) { return 0.5 * (v.minCoeff() + v.maxCoeff()); };
  const double half = 0.5 *
    std::max(
      Samples.x.maxCoeff() - Samples.x.minCoeff(), Samples.y.maxCoeff() - Samples.y.minCoeff());
  const double scale = half > 0.0 ? 1.0 / half : 0.0;
  FieldX = (Samples.x.array() - middle(Samples.x)) * scale;
  FieldY = (Samples.y.array() - middle(Samples.y)) * scale;
}

void SampleScene::findNeighbours()
{
  const auto count = static_cast<std::size_t>(size());
  Neighbours.resize(count);
  std::vector<double> distance(count);
  std::vector<double> nearestOf(count);
  for (std::size_t i = 0; i < count; ++i)
  {
    double nearest = std::numeric_limits<double>::infinity();
    for (std::size_t j = 0; j < count; ++j)
    {
      const auto a = static_cast<Eigen::Index>(i);
      const auto b = static_cast<Eigen::Index>(j);
      const bool counts = i != j && SceneOf[i] == SceneOf[j];
      distance[j] = counts ? std::hypot(FieldX[a] - FieldX[b], FieldY[a] - FieldY[b])
                           : std::numeric_limits<double>::infinity();
      nearest = std::min(nearest, distance[j]);
    }
    for (std::size_t j = 0; j < count; ++j)
    {
      if (distance[j] <= NeighbourReach * nearest && std::isfinite(distance[j]))
      {
        Neighbours[i].push_back(static_cast<int>(j));
      }
    }
    nearestOf[i] = nearest;
  }
  findSurround(nearestOf);
}

void SampleScene::findSurround(const std::vector<double>& nearest)
{
  const auto count = static_cast<std::size_t>(size());
  std::vector<double> pitch(Scenes.size(), 0.0);
  for (std::size_t scene = 0; scene < Scenes.size(); ++scene)
  {
    std::vector<double> distances;
    for (std::size_t i = 0; i < count; ++i)
    {
      if (SceneOf[i] == static_cast<int>(scene) && std::isfinite(nearest[i]) && nearest[i] > 0.0)
      {
        distances.push_back(nearest[i]);
      }
    }
    if (!distances.empty())
    {
      const auto middle = distances.begin() + static_cast<std::ptrdiff_t>(distances.size() / 2);
      std::nth_element(distances.begin(), middle, distances.end());
      pitch[scene] = *middle;
    }
  }
  Surround.resize(count);
  std::unordered_map<int, int> known; // steps of a distance, its number
  for (std::size_t i = 0; i < count; ++i)
  {
    const double own = pitch[static_cast<std::size_t>(SceneOf[i])];
    for (std::size_t j = 0; j < count && own > 0.0; ++j)
    {
      const auto a = static_cast<Eigen::Index>(i);
      const auto b = static_cast<Eigen::Index>(j);
      const double pitches = std::hypot(FieldX[a] - FieldX[b], FieldY[a] - FieldY[b]) / own;
      if (i != j && SceneOf[i] == SceneOf[j] && pitches <= SurroundReach)
      {
        const auto steps = static_cast<int>(std::lround(pitches / DistanceStep));
        const auto [place, fresh] = known.try_emplace(steps, static_cast<int>(Distances.size()));
        if (fresh)
        {
          Distances.push_back(steps * DistanceStep);
        }
        Surround[i].push_back({ static_cast<int>(j), place->second });
      }
    }
  }
}

} // namespace msi
