// Gain or offset that changes while a chart is captured.
#include "Kernels/Camera/Effects/Effect.h"

#include <cmath>
#include <functional>
#include <memory>
#include <vector>

namespace msi
{

namespace
{
// The course of the drift over the capture time t = 0..1.
std::function<double(double)> courseOf(const BoundEffect& effect)
{
  const auto is = [&form = effect.form().name](const char* stem)
  { return form.rfind(stem, 0) == 0; };
  if (is("step") || is("offset_step"))
  {
    return [place = effect.value("place"), width = effect.value("width")](double t)
    {
      const double s = std::fmin(std::fmax((t - place) / width + 0.5, 0.0), 1.0);
      return s * s * (3.0 - 2.0 * s);
    };
  }
  if (is("warm_up"))
  {
    return [constant = effect.value("constant")](double t) { return -std::expm1(-t / constant); };
  }
  if (is("settling"))
  {
    return [constant = effect.value("constant")](double t) { return std::exp(-t / constant); };
  }
  return [anchor = effect.value("anchor")](double t) { return t - anchor; };
}

std::unique_ptr<BlockOperator> makeDrift(const BoundEffect& effect)
{
  return blockOperator(
    [courseAt = courseOf(effect), changes = ChannelValues(effect.perChannel("change")),
      adds = effect.form().has(FormTrait::Adds)](auto signal, const ColumnContext& columns)
    {
      using Scalar = typename decltype(signal)::Scalar;
      for (Eigen::Index j = 0; j < signal.cols(); ++j)
      {
        const auto course = static_cast<Scalar>(courseAt(columns.time[j]));
        auto u = signal.col(j).array();
        if (adds)
        {
          u += course * changes.as<Scalar>();
        }
        else
        {
          u += course * changes.as<Scalar>() * u;
        }
      }
    });
}

EffectParameter change(const char* unit)
{
  return { "change", unit, 0.0, -0.6, 0.6, 0.03, "change over the course" };
}

// Where a step may lie: the starts of a fit that must find its place.
std::vector<std::vector<double>> places()
{
  std::vector<std::vector<double>> starts;
  for (int i = 1; i <= 9; ++i)
  {
    starts.push_back({ 0.03, 0.1 * i, 0.02 });
  }
  return starts;
}
}

Effect sessionDrift()
{
  const EffectParameter anchor{ "anchor", "session", 0.0, 0.0, 1.0, 0.2,
    "time at which the nominal value holds", false, true };
  const EffectParameter place{ "place", "session", 0.5, 0.0, 1.0, 0.1, "time of the step", false,
    false, true };
  const EffectParameter width{ "width", "session", 0.02, 0.001, 0.3, 0.01, "duration of the step",
    false, true };
  const EffectParameter constant{ "constant", "session", 0.3, 0.05, 1.0, 0.1, "time constant" };
  const std::vector<std::vector<double>> constants = { { 0.03, 0.1 }, { 0.03, 0.8 } };
  Effect effect;
  effect.definition = { "session_drift", "Session drift",
    "Lamp, detector or electronics change while samples are captured one after the other; time "
    "runs from 0 to 1 over the capture order.",
    EffectStage::Detector, EffectNeed::Order,
    { { "slope", "u (1 + change (t - anchor))", { change("1"), anchor } },
      { "step", "u (1 + change) from `place` on", { change("1"), place, width }, places() },
      { "warm_up", "u (1 + change (1 - exp(-t / constant)))", { change("1"), constant },
        constants },
      { "settling", "u (1 + change exp(-t / constant))", { change("1"), constant }, constants },
      { "slope_per_channel", "u_k (1 + change_k (t - anchor))", { change("1").ofLight(), anchor } },
      { "step_per_channel", "u_k (1 + change_k) from `place` on",
        { change("1").ofLight(), place, width }, places() },
      { "warm_up_per_channel", "u_k (1 + change_k (1 - exp(-t / constant)))",
        { change("1").ofLight(), constant }, constants },
      { "settling_per_channel", "u_k (1 + change_k exp(-t / constant))",
        { change("1").ofLight(), constant }, constants },
      { "offset_slope", "u + change (t - anchor)", { change("white"), anchor }, {},
        FormTrait::Adds },
      { "offset_step", "u + change from `place` on", { change("white"), place, width }, places(),
        FormTrait::Adds } },
    Captures::InterleavedWhite };
  effect.makeBlock = makeDrift;
  return effect;
}

} // namespace msi
