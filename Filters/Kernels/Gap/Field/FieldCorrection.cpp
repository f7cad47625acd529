#include "Kernels/Gap/Field/FieldCorrection.h"

#include "Kernels/Camera/Imaging/ScatterTail.h"
#include "Kernels/Gap/Field/FieldBlockLight.h"
#include "Kernels/Gap/Field/FieldColumns.h"
#include "Kernels/Gap/Field/FieldScene.h"

#include <cmath>
#include <limits>

namespace msi
{

FieldCorrection::FieldCorrection(const FieldPair& pair, const FieldModel& model)
  : Pair(pair)
  , Model(model)
  , Glare(sceneMean(pair, model))
  , Filled(filledScene(pair))
{
  using P = ImageParameter;
  if (!model.isNeutral(P::Right) || !model.isNeutral(P::Down) ||
    !model.isNeutral(P::Magnification) || !model.isNeutral(P::Rotation))
  {
    Registration.emplace(
      model[P::Right], model[P::Down], model[P::Magnification], model[P::Rotation], pair.extent);
  }
  if (!model.isNeutral(P::BlurVariance))
  {
    Blur = gaussianKernel(model[P::BlurVariance].max(0.0).sqrt());
  }
  for (std::size_t k = 0; k < pair.channels.size(); ++k)
  {
    const auto channel = static_cast<Eigen::Index>(k);
    Detector.emplace_back(model, channel);
    Tail.push_back(tailWeights(model, channel).cast<float>());
    for (int pass = Passes; pass < TailPasses; ++pass)
    {
      Passes = Tail.back()[pass] != 0.0F ? pass + 1 : Passes;
    }
  }
}

void FieldCorrection::operator()(
  const ImageWindow& window, float* corrected, CorrectionWorkspace& workspace) const
{
  using P = ImageParameter;
  const std::size_t K = Pair.channels.size();
  const int halo = (Registration ? Registration->reach() : 0) + (Blur ? Blur->radius() : 0) +
    2 * ((1 << Passes) - 1);
  PixelBuffer& signal = workspace.signal;
  signal.resize(grown(window, halo, Pair.extent), static_cast<int>(K));
  const ImageWindow& region = signal.window;
  const float* scene = Filled.empty() ? Pair.simulated : Filled.data();
  for (int y = region.y; y < region.y + region.height; ++y)
  {
    for (int x = region.x; x < region.x + region.width; ++x)
    {
      const auto factor = static_cast<float>(Model.fieldFactor(Pair.fieldX(x), Pair.fieldY(y)));
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
      signal.values[i] += Tail[i % K][pass] * (wide.values[i] - workspace.tail.values[i]);
    }
  }
  std::vector<FieldLines> rows, columns;
  for (std::size_t k = 0; k < K; ++k)
  {
    const auto channel = static_cast<Eigen::Index>(k);
    rows.emplace_back(Model, true, channel, -1, window.y, window.height);
    columns.emplace_back(Model, false, channel, -1, window.x, window.width);
  }
  std::vector<double>& light = workspace.light;
  light.resize(K);
  for (int y = window.y; y < window.y + window.height; ++y)
  {
    for (int x = window.x; x < window.x + window.width; ++x)
    {
      const float* self = signal.pixel(x, y);
      const float* simulated = Pair.simulated + Pair.index(x, y) * K;
      for (std::size_t k = 0; k < K; ++k)
      {
        const auto channel = static_cast<Eigen::Index>(k);
        double& u = light[k];
        u = static_cast<double>(self[k]);
        u += Model.at(P::Glare, channel) * Glare[channel] +
          Model.at(P::ConservingGlare, channel) * (Glare[channel] - u);
        for (std::size_t number = 0; number < imageLights().size(); ++number)
        {
          u += Model.at(imageLight(number), channel) *
            lightElsewhere(Pair, scene, Model, imageLights()[number], { x, y }, k);
        }
      }
      for (std::size_t k = 0; k < K; ++k)
      {
        const auto channel = static_cast<Eigen::Index>(k);
        const double before = k > 0 ? light[k - 1] : 0.0;
        double lit = light[k] + Model.at(P::Retained, channel) * before;
        lit += k > 0 ? Model.at(P::FromPrevious, channel) * (before - light[k]) : 0.0;
        lit += k + 1 < K ? Model.at(P::FromNext, channel) * (light[k + 1] - light[k]) : 0.0;
        const Eigen::Index row = y - window.y;
        const Eigen::Index column = x - window.x;
        const double u = (lit * (1.0 + rows[k].factor[row] + columns[k].factor[column]) +
                           rows[k].added[row] + columns[k].added[column]) *
          Model.at(P::Gain, channel);
        *corrected++ = std::isfinite(simulated[k]) ? static_cast<float>(Detector[k](u).value)
                                                   : std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
}

} // namespace msi
