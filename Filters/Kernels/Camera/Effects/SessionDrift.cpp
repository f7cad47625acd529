// Gain or offset that changes while a chart is captured.
#include "Kernels/Camera/Effects/Effect.h"

#include <cmath>
#include <string>

namespace msi
{

namespace
{
// The course of the drift over the capture time t = 0..1.
class Course
{
public:
  explicit Course(const BoundEffect& effect)
    : Name(effect.form().name)
  {
    const auto starts = [this](const char* stem) { return Name.rfind(stem, 0) == 0; };
    if (starts("step") || starts("offset_step"))
    {
      Kind = Step;
      Place = effect.value("place");
      Width = effect.value("width");
    }
    else if (starts("warm_up") || starts("settling"))
    {
      Kind = starts("warm_up") ? WarmUp : Settling;
      Place = effect.value("constant");
    }
    else
    {
      Kind = Slope;
      Place = effect.value("anchor");
    }
  }
  double operator()(double t) const noexcept
  {
    switch (Kind)
    {
      case Step:
      {
        const double s = std::fmin(std::fmax((t - Place) / Width + 0.5, 0.0), 1.0);
        return s * s * (3.0 - 2.0 * s);
      }
      case WarmUp:
        return -std::expm1(-t / Place);
      case Settling:
        return std::exp(-t / Place);
      case Slope:
        break;
    }
    return t - Place;
  }

private:
  enum
  {
    Slope,
    Step,
    WarmUp,
    Settling
  } Kind = Slope;
  std::string Name;
  double Place = 0.0;
  double Width = 0.0;
};

class SessionDrift
{
public:
  explicit SessionDrift(const BoundEffect& effect)
    : Over(effect)
    , Change(effect.perChannel("change"))
    , Offset(effect.form().name.rfind("offset", 0) == 0)
  {
  }
  template <typename Scalar>
  void operator()(Block<Scalar> signal, const ColumnContext& columns) const noexcept
  {
    for (Eigen::Index j = 0; j < signal.cols(); ++j)
    {
      const auto course = static_cast<Scalar>(Over(columns.time[j]));
      auto u = signal.col(j).array();
      if (Offset)
      {
        u += course * Change.as<Scalar>();
      }
      else
      {
        u += course * Change.as<Scalar>() * u;
      }
    }
  }

private:
  Course Over;
  ChannelValues Change;
  bool Offset;
};

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
    "runs "
    "from 0 to 1 over the capture order.",
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
  effect.makeBlock = makeBlockOperator<SessionDrift>;
  return effect;
}

} // namespace msi
