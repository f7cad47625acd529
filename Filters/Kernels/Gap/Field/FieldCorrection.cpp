#include "Kernels/Gap/Field/FieldCorrection.h"

#include "Kernels/Camera/Imaging/ScatterTail.h"
#include "Kernels/Gap/Field/FieldData.h"

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <utility>
#include <vector>

namespace msi
{

FieldCorrection::FieldCorrection(const FieldPair& pair, const FieldModel& model)
  : Pair(pair)
  , Model(model)
  , Glare(SceneCells(pair).mean(model))
  , Filled(filledScene(pair))
{
  const Eigen::Index K = pair.channels.size();
  std::vector<ImageDisplacement> displacements;
  Eigen::ArrayXd variance(K);
  for (Eigen::Index k = 0; k < K; ++k)
  {
    const SceneChange change = model.ofScene(k);
    displacements.push_back(change.displacement);
    variance[k] = change.blurVariance;
    Tail.push_back(change.tailWeights);
    for (int pass = Passes; pass < TailPasses; ++pass)
    {
      Passes = Tail.back()[pass] != 0.0 ? pass + 1 : Passes;
    }
  }
  if (std::any_of(imageSteps().begin(), imageSteps().end(),
        [&model](const PlacedStep& step)
        { return step.step->displace != nullptr && !model.isNeutral(step); }))
  {
    Registration.emplace(std::move(displacements), pair.extent);
  }
  if ((variance > 0.0).any())
  {
    Blur = gaussianKernel(variance.sqrt());
  }
}

void FieldCorrection::operator()(
  const ImageWindow& window, float* corrected, CorrectionWorkspace& workspace) const
{
  const std::size_t K = Pair.channels.size();
  const int halo =
    (Registration ? Registration->reach() : 0) + (Blur ? Blur->radius() : 0) + splineReach(Passes);
  PixelBuffer& signal = workspace.signal;
  signal.resize(grown(window, halo, Pair.extent), static_cast<int>(K));
  const ImageWindow& region = signal.window;
  const FieldFactor field(Model);
  const float* scene = Filled.empty() ? Pair.simulated : Filled.data();
  for (int y = region.y; y < region.y + region.height; ++y)
  {
    for (int x = region.x; x < region.x + region.width; ++x)
    {
      const auto factor = static_cast<float>(field(Pair.fieldX(x), Pair.fieldY(y)));
      const float* source = scene + Pair.index(x, y) * K;
      float* out = signal.pixel(x, y);
      for (std::size_t k = 0; k < K; ++k)
      {
        out[k] = factor * source[k];
      }
    }
  }
  if (Registration)
  {
    (*Registration)(signal, workspace.scratch);
  }
  if (Blur)
  {
    convolve(*Blur, signal);
  }
  PixelBuffer& wide = workspace.scratch;
  wide = signal;
  workspace.tail = signal;
  for (int pass = 0; pass < Passes; ++pass)
  {
    convolve(splineKernel(signal.channels, 1 << pass), wide);
    for (std::size_t i = 0; i < signal.values.size(); ++i)
    {
      signal.values[i] +=
        static_cast<float>(Tail[i % K][pass]) * (wide.values[i] - workspace.tail.values[i]);
    }
  }
  std::vector<FieldLines> rows, columns;
  std::vector<ChannelSteps> lights, behind;
  for (std::size_t k = 0; k < K; ++k)
  {
    rows.emplace_back(Model, true, k, -1, window.y, window.height);
    columns.emplace_back(Model, false, k, -1, window.x, window.width);
    lights.push_back(Model.steps(ImageStage::Light, ImageStage::Light, k));
    behind.push_back(Model.steps(ImageStage::Exposure, ImageStage::Detector, k));
  }
  std::vector<double>& light = workspace.light;
  light.resize(K);
  for (int y = window.y; y < window.y + window.height; ++y)
  {
    for (int x = window.x; x < window.x + window.width; ++x)
    {
      const float* self = signal.pixel(x, y);
      const float* simulated = Pair.simulated + Pair.index(x, y) * K;
      ImagePixel pixel;
      pixel.x = Pair.fieldX(x);
      pixel.y = Pair.fieldY(y);
      for (std::size_t k = 0; k < K; ++k)
      {
        pixel.mean = Glare[k];
        workspace.others.clear();
        addElsewhere(Pair, scene, field, { x, y }, k, workspace.others);
        light[k] = run(lights[k], pixel, workspace.others.data(), static_cast<double>(self[k]));
      }
      pixel.ofAll = std::accumulate(light.begin(), light.end(), 0.0) / static_cast<double>(K);
      for (std::size_t k = 0; k < K; ++k)
      {
        pixel.self = light[k];
        pixel.channel = channelPlace(k, K);
        pixel.previous = k > 0 ? &light[k - 1] : nullptr;
        pixel.next = k + 1 < K ? &light[k + 1] : nullptr;
        pixel.row = rows[k][y - window.y];
        pixel.column = columns[k][x - window.x];
        const double answer = run(behind[k], pixel, nullptr, light[k]);
        *corrected++ = std::isfinite(simulated[k]) ? static_cast<float>(answer)
                                                   : std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
}

} // namespace msi
