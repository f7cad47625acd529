#include "Kernels/Gap/Samples/SampleRest.h"

#include "Kernels/Camera/Effects/Effect.h"
#include "Kernels/Gap/UnmodelledPart.h"

#include <algorithm>

namespace msi
{

namespace
{
constexpr int Folds = 5;
}

Eigen::MatrixXd withRest(
  const GapData& data, const CameraEffect& rest, const Eigen::MatrixXd& predicted)
{
  const BoundEffect bound(rest, data.camera, -1);
  const SampleScene& scene = data.scene;
  Eigen::MatrixXd response = predicted;
  registered(bound.definition())
    .makeBlock(bound)
    ->apply(Block<double>(response),
      { nullptr, scene.fieldX().data(), scene.fieldY().data(), scene.time().data() });
  return response;
}

CameraEffect restOf(const GapData& data, const Eigen::MatrixXd& predicted,
  const SampleList& training, std::uint64_t seed)
{
  const EffectDefinition& definition = effectWith(EffectTrait::Remainder);
  const auto count = static_cast<Eigen::Index>(definition.forms.front().parameters.size());
  const Eigen::Index channels = data.channels();
  // It is linear in its parameters: a column is what the parameter 1 adds.
  std::vector<Eigen::MatrixXd> columns;
  for (Eigen::Index n = 0; n < count; ++n)
  {
    Eigen::MatrixXd one = Eigen::MatrixXd::Zero(channels, count);
    one.col(n).setOnes();
    columns.push_back(
      withRest(data, unmodelledPart(one, data.camera.channels()), predicted) - predicted);
  }
  columns.push_back(data.observed - predicted);
  const int folds = std::min(Folds, static_cast<int>(training.size()));
  const std::vector<int> fold = foldsOf(data, training, folds, seed);
  std::vector<std::vector<Eigen::MatrixXd>> products(static_cast<std::size_t>(folds),
    std::vector<Eigen::MatrixXd>(
      static_cast<std::size_t>(channels), Eigen::MatrixXd::Zero(count + 1, count + 1)));
  Eigen::VectorXd row(count + 1);
  for (const Eigen::Index i : training)
  {
    auto& ofFold = products[static_cast<std::size_t>(fold[static_cast<std::size_t>(i)])];
    for (Eigen::Index k = 0; k < channels; ++k)
    {
      for (Eigen::Index n = 0; n <= count; ++n)
      {
        row[n] = columns[static_cast<std::size_t>(n)](k, i);
      }
      ofFold[static_cast<std::size_t>(k)] += data.weight(k, i) * row * row.transpose();
    }
  }
  return unmodelledPart(regularPart(products), data.camera.channels());
}

} // namespace msi
