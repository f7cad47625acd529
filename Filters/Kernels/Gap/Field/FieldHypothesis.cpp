#include "Kernels/Gap/Field/FieldHypothesis.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace msi
{

namespace
{
constexpr int Iterations = 4;
constexpr double SmallStep = 0.02; // typical sizes
constexpr double Radii[] = { 2.0, 4.0, 8.0, 16.0, 32.0 };
constexpr double Centers[] = { -0.3, 0.0, 0.3 }; // half fields
}

FieldSet joined(FieldSet set, const FieldChoice& choice)
{
  set.push_back(&choice);
  return set;
}

bool hasTerm(const FieldSet& set, ImageParameter parameter)
{
  return std::any_of(set.begin(), set.end(),
    [parameter](const FieldChoice* choice) { return choice->has(parameter); });
}

FieldHypothesis refitted(const FieldData& data, const FieldWeights& weights, const FieldSet& set,
  const FieldModel& start, const FieldLoop& loop)
{
  FieldModel model = start;
  FieldHypothesis best;
  for (int iteration = 0; iteration < Iterations; ++iteration)
  {
    const auto statistics =
      std::make_shared<FieldStatistics>(fieldStatistics(data, model, &weights, loop));
    FieldFit fit = FieldFitter(data, *statistics).fit(set);
    const double step = fit.step;
    const FieldModel next = fit.next;
    if (!best.statistics || fit.energy < best.fit.energy || step < SmallStep)
    {
      best = { set, statistics, std::move(fit) };
    }
    if (step < SmallStep)
    {
      break;
    }
    model = next;
  }
  return best;
}

FieldFit linearFit(const FieldFitter& fitter, const FieldSet& set, FieldDetail detail)
{
  const FieldModel& model = fitter.statistics().model;
  const bool tail =
    hasTerm(set, ImageParameter::TailFraction) && model.isNeutral(ImageParameter::TailFraction);
  // Terms of a higher order are known about the model's center alone.
  const bool center = !model.hasVignetting() && hasTerm(set, ImageParameter::CenterX) &&
    !hasTerm(set, ImageParameter::Fourth);
  FieldShape start;
  std::optional<FieldFit> best;
  const auto tryOut = [&](const FieldShape& shape)
  {
    FieldFit fit = fitter.fit(set, shape, detail);
    if (!best || fit.energy < best->energy)
    {
      best = std::move(fit);
      start = shape;
    }
  };
  tryOut(start);
  for (const double radius : Radii)
  {
    if (tail)
    {
      tryOut({ radius, 0.0, 0.0, 0.0, 0.0 });
    }
  }
  if (hasTerm(set, ImageParameter::GradientBend) &&
    model.isNeutral(ImageParameter::GradientRight) && model.isNeutral(ImageParameter::GradientDown))
  {
    FieldShape bent = start;
    const double right = best->next.at(ImageParameter::GradientRight, 0);
    const double down = best->next.at(ImageParameter::GradientDown, 0);
    const double size = std::hypot(right, down);
    if (size > 0.0)
    {
      bent.gradientRight = right / size;
      bent.gradientDown = down / size;
      tryOut(bent);
    }
  }
  const FieldShape found = start;
  for (const double right : Centers)
  {
    for (const double down : Centers)
    {
      if (center)
      {
        tryOut({ found.radius, right, down, found.gradientRight, found.gradientDown });
      }
    }
  }
  return std::move(*best);
}

std::vector<std::string> indistinctEffects(
  const FieldData& data, const FieldFitter& fitter, const std::vector<FieldChoice>& choices)
{
  std::vector<std::string> found;
  for (const FieldChoice& choice : choices)
  {
    if (!choice.has(EffectTrait::ActsOnEdges))
    {
      continue;
    }
    double information = 0.0;
    for (Eigen::Index k = 0; k < data.channels(); ++k)
    {
      const Eigen::VectorXd column =
        columnsChanged(choice.terms.front().parameter, fitter.statistics().model, k,
          { neutralValue(ImageParameter::TailRadius), 0.0, 0.0, 0.0, 0.0 });
      for (std::size_t b = 0; b < data.blocks.size(); ++b)
      {
        information += column.dot(
          fitter.statistics().at(b, k).normal.topLeftCorner(column.size(), column.size()) * column);
      }
    }
    const bool missing = 1.0 / std::sqrt(std::fmax(information, 1e-30)) >
      ImageDecision::Indistinct * choice.terms.front().typical;
    const std::string& name = choice.effect->name;
    if (missing && std::find(found.begin(), found.end(), name) == found.end())
    {
      found.push_back(name);
    }
  }
  return found;
}

} // namespace msi
