#include "Kernels/Gap/Field/FieldCorrection.h"

#include "Kernels/Gap/Field/FieldData.h"

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
  using P = FieldParameter;
  if (!model.isNeutral(P::Right) || !model.isNeutral(P::Down) || !model.isNeutral(P::Magnification))
  {
    Registration.emplace(model[P::Right], model[P::Down], model[P::Magnification], pair.extent);
  }
  if (!model.isNeutral(P::BlurVariance))
  {
    Blur = gaussianKernel(model[P::BlurVariance].max(0.0).sqrt());
  }
  if (!model.isNeutral(P::TailFraction))
  {
    Tail.emplace(model.at(P::TailRadius, 0));
  }
}

void FieldCorrection::operator()(
  const ImageWindow& window, float* corrected, CorrectionWorkspace& workspace) const
{
  using P = FieldParameter;
  const std::size_t K = Pair.channels.size();
  const int halo = (Registration ? Registration->reach() : 0) + (Blur ? Blur->radius() : 0) +
    (Tail ? Tail->reach() : 0);
  PixelBuffer& signal = workspace.signal;
  signal.resize(grown(window, halo, Pair.extent), static_cast<int>(K));
  const ImageWindow& region = signal.window;
  for (int y = region.y; y < region.y + region.height; ++y)
  {
    for (int x = region.x; x < region.x + region.width; ++x)
    {
      const auto factor = static_cast<float>(Model.fieldFactor(Pair.fieldX(x), Pair.fieldY(y)));
      const float* source = Filled.data() + Pair.index(x, y) * K;
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
  if (Tail)
  {
    workspace.scratch = signal;
    (*Tail)(workspace.scratch, workspace.tail);
  }
  for (int y = window.y; y < window.y + window.height; ++y)
  {
    for (int x = window.x; x < window.x + window.width; ++x)
    {
      const float* self = signal.pixel(x, y);
      const float* simulated = Pair.simulated + Pair.index(x, y) * K;
      for (std::size_t k = 0; k < K; ++k)
      {
        const auto channel = static_cast<Eigen::Index>(k);
        double u = static_cast<double>(self[k]);
        if (Tail)
        {
          u += Model.at(P::TailFraction, channel) *
            (static_cast<double>(workspace.tail.pixel(x, y)[k]) - u);
        }
        u += Model.at(P::Glare, channel) * Glare[channel] +
          Model.at(P::ConservingGlare, channel) * (Glare[channel] - u);
        u *= Model.bandFactor(channel, x, y) * Model.at(P::Gain, channel);
        u += Model.at(P::Square, channel) * u * u + Model.at(P::Dark, channel);
        *corrected++ = std::isfinite(simulated[k]) ? static_cast<float>(u)
                                                   : std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
}

} // namespace msi
