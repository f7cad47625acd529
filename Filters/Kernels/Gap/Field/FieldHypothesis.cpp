#include "Kernels/Gap/Field/FieldHypothesis.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"

#include <algorithm>
#include <cmath>
#include <optional>

namespace msi
{

namespace
{
constexpr int Iterations = 6;
constexpr double Rising = 1.001;   // of the energy, by the prior alone
constexpr double SmallStep = 0.02; // typical sizes
}

FieldSet joined(FieldSet set, const FieldChoice& choice)
{
  set.push_back(&choice);
  return set;
}

FieldHypothesis refitted(const FieldData& data, const FieldWeights& weights, const FieldSet& set,
  const FieldModel& start, const FieldLoop& loop)
{
  const AskedSteps asked = stepsOf(set);
  FieldModel model = start;
  FieldHypothesis best;
  double least = 0.0;
  for (int iteration = 0; iteration < Iterations; ++iteration)
  {
    const auto statistics =
      std::make_shared<FieldStatistics>(fieldStatistics(data, model, &weights, loop, asked));
    const FieldFitter fitter(data, *statistics);
    if (best.statistics && !(fitter.energy() < least * Rising))
    {
      model.goHalfwayTo(best.statistics->model); // the step was too long
      continue;
    }
    least = fitter.energy();
    best = { set, statistics, fitter.fit(set) };
    if (best.fit.step < SmallStep)
    {
      break;
    }
    model = best.fit.next;
  }
  return best;
}

FieldFit linearFit(const FieldFitter& fitter, const FieldSet& set, FieldDetail detail)
{
  const FieldModel& model = fitter.statistics().model;
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
  for (const FieldChoice* choice : set)
  {
    if (!model.isNeutral(stepOf(choice->terms.front().parameter)))
    {
      continue;
    }
    if (choice->twice)
    {
      FieldShape there = start;
      for (const ImageTerm& term : choice->terms)
      {
        there[term.parameter] = best->next.at(term.parameter, 0);
      }
      tryOut(there);
    }
    // Every combination of the starts.
    std::vector<FieldShape> shapes{ start };
    for (const ImageTerm& term : choice->terms)
    {
      std::vector<FieldShape> more;
      for (const FieldShape& shape : shapes)
      {
        for (const double value : term.starts)
        {
          more.push_back(shape);
          more.back()[term.parameter] = value;
        }
      }
      if (!more.empty())
      {
        shapes = std::move(more);
      }
    }
    for (std::size_t i = 0; shapes.size() > 1 && i < shapes.size(); ++i)
    {
      tryOut(shapes[i]);
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
      const Eigen::VectorXd column = columnsChanged(
        choice.terms.front().parameter, fitter.statistics().model, fitter.statistics().model, k);
      for (std::size_t b = 0; b < data.blocks.size(); ++b)
      {
        information += column.dot(
          fitter.statistics().at(b, k).normal().topLeftCorner(column.size(), column.size()) *
          column);
      }
    }
    const bool missing = Decision::SureDeviations / std::sqrt(std::fmax(information, 1e-30)) >
      choice.terms.front().typical;
    const std::string& name = choice.effect->name;
    if (missing && std::find(found.begin(), found.end(), name) == found.end())
    {
      found.push_back(name);
    }
  }
  return found;
}

} // namespace msi
