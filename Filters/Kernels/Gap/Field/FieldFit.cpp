#include "Kernels/Gap/Field/FieldBound.h"

#include <algorithm>

namespace msi
{

namespace
{
constexpr int Rounds = 3;
}

FieldFitter::FieldFitter(const FieldData& data, const FieldStatistics& statistics)
  : Data(data)
  , Statistics(statistics)
  , Glare(sceneMean(data, statistics.model))
{
  const auto K = static_cast<std::size_t>(data.channels());
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(FieldColumn::count(), FieldColumn::count());
  Total.assign(K, zero);
  Fold.assign(FieldFolds, std::vector<Eigen::MatrixXd>(K, zero));
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    const int fold = data.blocks[b].fold;
    for (std::size_t k = 0; fold >= 0 && k < K; ++k)
    {
      const BlockSums& sums = statistics.at(b, static_cast<Eigen::Index>(k));
      Total[k] += sums.normal;
      Fold[static_cast<std::size_t>(fold)][k] += sums.normal;
      Energy += sums.normal(FieldColumn::residual(), FieldColumn::residual());
      Chance += sums.chance;
    }
  }
}

FieldShape FieldFitter::shape() const
{
  const FieldModel& model = Statistics.model;
  return { model.at(ImageParameter::TailRadius, 0), model.at(ImageParameter::CenterX, 0),
    model.at(ImageParameter::CenterY, 0), 0.0, 0.0 };
}

FieldFit FieldFitter::fit(const FieldSet& set, const FieldShape& start, FieldDetail detail) const
{
  const FieldModel& model = Statistics.model;
  const auto K = static_cast<std::size_t>(Data.channels());
  FieldShape shape = this->shape();
  if (start.radius > 0.0 && model.isNeutral(ImageParameter::TailFraction))
  {
    shape.radius = start.radius;
  }
  if (!model.hasVignetting())
  {
    shape.centerX = start.centerX;
    shape.centerY = start.centerY;
  }
  if (model.isNeutral(ImageParameter::GradientRight) &&
    model.isNeutral(ImageParameter::GradientDown))
  {
    shape.gradientRight = start.gradientRight;
    shape.gradientDown = start.gradientDown;
  }
  std::vector<Bound> terms;
  std::vector<char> known(fieldParameterCount(), 0);
  const auto add = [&](const ImageTerm& term, bool held)
  {
    const double neutral = term.parameter == ImageParameter::TailRadius ? shape.radius
      : term.parameter == ImageParameter::CenterX && !held              ? shape.centerX
      : term.parameter == ImageParameter::CenterY && !held              ? shape.centerY
      : isShape(term.parameter) ? model.at(term.parameter, 0)
                                : neutralValue(term.parameter);
    terms.push_back({ term, Eigen::ArrayXd::Constant(Data.channels(), neutral),
      std::vector<char>(K, held ? 1 : 0) });
    known[static_cast<std::size_t>(term.parameter)] = 1;
  };
  for (const FieldChoice* choice : set)
  {
    for (const ImageTerm& term : choice->terms)
    {
      add(term, false);
      const Eigen::ArrayXd& value = model[term.parameter];
      if (!term.perChannel && (value != value[0]).any())
      {
        // Alike in all channels from here on; the common term moves them together.
        add({ term.parameter, true, 0.0, 0.0, term.typical }, true);
        terms.back().wanted.setConstant(value.mean());
      }
    }
  }
  for (std::size_t p = 0; p < fieldParameterCount(); ++p)
  {
    const auto parameter = static_cast<ImageParameter>(p);
    if (known[p] == 0 && !isShape(parameter) && !model.isNeutral(parameter))
    {
      add({ parameter, true, 0.0, 0.0, 1.0 }, true);
    }
  }
  FieldFit fit{ set, model, 0.0, Eigen::VectorXd(), 0.0 };
  std::vector<Eigen::ArrayXd> values;
  for (int round = 0; round < Rounds; ++round)
  {
    solve(Total, terms, values, shape);
    bool beyond = false;
    for (std::size_t t = 0; t < terms.size(); ++t)
    {
      Bound& bound = terms[t];
      for (std::size_t k = 0; k < K; ++k)
      {
        const double value = values[t][static_cast<Eigen::Index>(k)];
        if (bound.held[k] == 0 && (value < bound.term.lower || value > bound.term.upper))
        {
          bound.held[k] = 1;
          bound.wanted[static_cast<Eigen::Index>(k)] =
            std::clamp(value, bound.term.lower, bound.term.upper);
          beyond = true;
        }
      }
    }
    if (!beyond)
    {
      break;
    }
  }
  fit.next[ImageParameter::TailRadius].setConstant(shape.radius);
  std::vector<char> seen(fieldParameterCount(), 0);
  for (std::size_t t = 0; t < terms.size(); ++t)
  {
    const Bound& bound = terms[t];
    Eigen::ArrayXd value = values[t];
    for (std::size_t k = 0; k < K; ++k)
    {
      const auto at = static_cast<Eigen::Index>(k);
      value[at] = bound.held[k] != 0 ? bound.wanted[at] : value[at];
    }
    fit.step = std::max(
      fit.step, (value - model[bound.term.parameter]).abs().maxCoeff() / bound.term.typical);
    const auto p = static_cast<std::size_t>(bound.term.parameter);
    const bool again = seen[p] != 0;
    seen[p] = 1;
    const Eigen::ArrayXd before = model[bound.term.parameter];
    fit.next[bound.term.parameter] =
      again ? Eigen::ArrayXd(fit.next[bound.term.parameter] + value - before) : value;
  }
  const auto energyOf = [](const Eigen::MatrixXd& normal, const Eigen::VectorXd& change)
  {
    return normal(FieldColumn::residual(), FieldColumn::residual()) -
      2.0 * change.dot(normal.col(FieldColumn::residual()).head(FieldColumn::residual())) +
      change.dot(normal.topLeftCorner(FieldColumn::residual(), FieldColumn::residual()) * change);
  };
  fit.blockEnergy.setZero(
    detail == FieldDetail::Blocks ? static_cast<Eigen::Index>(Data.blocks.size()) : 0);
  for (int fold = 0; fold < FieldFolds; ++fold)
  {
    const std::vector<Eigen::MatrixXd>& own = Fold[static_cast<std::size_t>(fold)];
    std::vector<Eigen::MatrixXd> others = Total;
    for (std::size_t k = 0; k < K; ++k)
    {
      others[k] -= own[k];
    }
    const std::vector<Eigen::VectorXd> change = solve(others, terms, values, shape);
    for (std::size_t k = 0; k < K; ++k)
    {
      fit.energy += energyOf(own[k], change[k]);
    }
    for (std::size_t b = 0; detail == FieldDetail::Blocks && b < Data.blocks.size(); ++b)
    {
      for (std::size_t k = 0; Data.blocks[b].fold == fold && k < K; ++k)
      {
        fit.blockEnergy[static_cast<Eigen::Index>(b)] +=
          energyOf(Statistics.at(b, static_cast<Eigen::Index>(k)).normal, change[k]);
      }
    }
  }
  return fit;
}

} // namespace msi
