#include "Kernels/Camera/StagedResponse.h"

#include "Kernels/Camera/Effects/EffectChain.h"
#include "Kernels/Camera/Effects/SceneRun.h"

#include <algorithm>
#include <utility>

namespace msi
{

namespace
{
using Stage = std::shared_ptr<const Eigen::MatrixXd>;

Stage keep(Eigen::MatrixXd values)
{
  return std::make_shared<const Eigen::MatrixXd>(std::move(values));
}

// The samples of these media, as the chain numbers them.
std::vector<Eigen::Index> samplesIn(
  const std::vector<int>& media, const EffectChain& chain, const SampleScene& scene)
{
  std::vector<char> wanted;
  for (const std::string& name : scene.media())
  {
    const int number = chain.mediumNumber(name);
    wanted.push_back(std::find(media.begin(), media.end(), number) != media.end() ? 1 : 0);
  }
  std::vector<Eigen::Index> samples;
  for (std::size_t j = 0; j < scene.medium().size(); ++j)
  {
    if (wanted[static_cast<std::size_t>(scene.medium()[j])] != 0)
    {
      samples.push_back(static_cast<Eigen::Index>(j));
    }
  }
  return samples;
}

Stage withColumns(
  const Stage& whole, const std::vector<Eigen::Index>& samples, const Eigen::MatrixXd& columns)
{
  Eigen::MatrixXd changed = *whole;
  changed(Eigen::all, samples) = columns;
  return keep(std::move(changed));
}
}

StagedResponse::StagedResponse(CameraModel camera, const SampleScene& scene,
  std::vector<CameraEffect> effects, CameraSimulatorOptions options)
  : Scene(&scene)
  , Chain(std::make_unique<const EffectChain>(
      std::move(camera), std::move(effects), options.whiteAfterEffects))
{
  respond(nullptr);
}

StagedResponse::StagedResponse(
  const StagedResponse& related, std::vector<CameraEffect> effects, CameraSimulatorOptions options)
  : Scene(related.Scene)
  , Chain(std::make_unique<const EffectChain>(
      *related.Chain, std::move(effects), options.whiteAfterEffects))
  , Tail(related.Tail)
{
  respond(&related);
}

StagedResponse::~StagedResponse() = default;
StagedResponse::StagedResponse(StagedResponse&&) noexcept = default;
StagedResponse& StagedResponse::operator=(StagedResponse&&) noexcept = default;

void StagedResponse::respond(const StagedResponse* related)
{
  const SceneRun run(*Chain, *Scene);
  reflectAndIntegrate(run, related);

  const bool sameIntegral = related != nullptr && Integral == related->Integral;
  Illuminated = !Chain->illuminates()                         ? Integral
    : sameIntegral && Chain->illuminatesLike(*related->Chain) ? related->Illuminated
                                                              : nullptr;
  if (!Illuminated)
  {
    Eigen::MatrixXd signal = *Integral;
    run.illuminate(signal, Tail);
    Illuminated = keep(std::move(signal));
  }

  const bool sameLight = related != nullptr && Illuminated == related->Illuminated;
  Detected = !Chain->detects()                         ? Illuminated
    : sameLight && Chain->detectsLike(*related->Chain) ? related->Detected
                                                       : nullptr;
  if (!Detected)
  {
    Eigen::MatrixXd signal = *Illuminated;
    run.detect(signal);
    Detected = keep(std::move(signal));
  }
}

void StagedResponse::reflectAndIntegrate(const SceneRun& run, const StagedResponse* related)
{
  if (related == nullptr)
  {
    Reflected = Chain->needsMedium() ? keep(run.reflected()) : nullptr;
    Integral = keep(Reflected ? run.integral(*Reflected) : run.integral());
    return;
  }
  const std::vector<int> media = Chain->mediaReflectedOtherwise(*related->Chain);
  const bool alike = Chain->integratesLike(*related->Chain);
  if (media.empty())
  {
    Reflected = related->Reflected;
    Integral =
      alike ? related->Integral : keep(Reflected ? run.integral(*Reflected) : run.integral());
    return;
  }
  const std::vector<Eigen::Index> samples = samplesIn(media, *Chain, *Scene);
  if (alike)
  {
    Integral = withColumns(related->Integral, samples, run.integral(run.reflected(samples)));
    return;
  }
  Reflected = related->Reflected ? withColumns(related->Reflected, samples, run.reflected(samples))
                                 : keep(run.reflected());
  Integral = keep(run.integral(*Reflected));
}

} // namespace msi
