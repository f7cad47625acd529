#include "Kernels/Gap/Field/FieldFit.h"

#include "Kernels/Gap/Diagnosis/LearnedPrior.h"
#include "Kernels/Numerics/LeastSquares.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <map>

namespace msi
{

namespace
{
constexpr int Rounds = 3;
constexpr int Iterations = 6;
constexpr double Rising = 1.001;   // of the energy, by the prior alone
constexpr double SmallStep = 0.02; // typical sizes
constexpr double Held = 1e4;       // times the information, of a parameter that is held

// Of one common to the channels that of the first.
double valueIn(const FieldModel& model, const FieldNumber& number)
{
  return model.at(number.parameter, std::max<Eigen::Index>(number.channel, 0));
}

double precisionBefore(const FieldNumber& number)
{
  return widePrecision(number.typical);
}
}

// A number with the value that is wanted, by its prior or because it is held there.
struct FieldFitter::Bound
{
  FieldNumber number;
  double wanted;
  bool held;
};

// Of a channel: the numbers that act in it, and what each changes in its columns.
struct FieldFitter::Design
{
  std::vector<Eigen::Index> numbers;
  Eigen::MatrixXd columns;

  Eigen::MatrixXd information(const Eigen::MatrixXd& normal) const
  {
    return columns.transpose() *
      normal.topLeftCorner(FieldColumn::residual(), FieldColumn::residual()) * columns;
  }
  Eigen::VectorXd gradient(const Eigen::MatrixXd& normal) const
  {
    return columns.transpose() * normal.col(FieldColumn::residual()).head(FieldColumn::residual());
  }
};

FieldFitter::FieldFitter(const FieldData& data, const FieldStatistics& statistics)
  : Data(data)
  , Statistics(statistics)
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
      const Eigen::MatrixXd normal = sums.normal();
      Total[k] += normal;
      Fold[static_cast<std::size_t>(fold)][k] += normal;
      Energy += normal(FieldColumn::residual(), FieldColumn::residual());
      Chance += sums.chance;
    }
  }
}

std::vector<FieldFitter::Design> FieldFitter::designs(
  const std::vector<FieldNumber>& numbers, const FieldModel& about) const
{
  std::vector<Design> designs(Total.size());
  for (std::size_t k = 0; k < designs.size(); ++k)
  {
    const auto channel = static_cast<Eigen::Index>(k);
    std::vector<Eigen::VectorXd> columns;
    for (std::size_t n = 0; n < numbers.size(); ++n)
    {
      if (numbers[n].channel < 0 || numbers[n].channel == channel)
      {
        designs[k].numbers.push_back(static_cast<Eigen::Index>(n));
        columns.push_back(columnsChanged(numbers[n].parameter, Statistics.model, about, channel));
      }
    }
    designs[k].columns.resize(FieldColumn::residual(), static_cast<Eigen::Index>(columns.size()));
    for (std::size_t c = 0; c < columns.size(); ++c)
    {
      designs[k].columns.col(static_cast<Eigen::Index>(c)) = columns[c];
    }
  }
  return designs;
}

FieldFit FieldFitter::fit(const FieldSet& set, const FieldShape& start) const
{
  const FieldModel& model = Statistics.model;
  FieldModel about = model;
  for (const auto& [parameter, value] : start)
  {
    if (model.isNeutral(stepOf(parameter)))
    {
      about[parameter].setConstant(value);
    }
  }
  std::vector<FieldNumber> numbers = numbersOf(set, Data.channels());
  std::vector<Bound> bounds;
  const auto hold = [&](ImageParameter parameter, double typical, double wanted)
  {
    for (Eigen::Index k = 0; k < Data.channels(); ++k)
    {
      bounds.push_back({ { nullptr, nullptr, parameter, k, 0.0, 0.0, typical }, wanted, true });
    }
  };
  std::vector<char> known(fieldParameterCount(), 0);
  for (const FieldNumber& number : numbers)
  {
    const ImageNumber& kind = numberOf(number.parameter);
    const bool stays = isShape(number.parameter) || kind.pull == ImagePull::Itself;
    bounds.push_back({ number, stays ? about.at(number.parameter, 0) : kind.neutral, false });
    known[number.parameter] = 1;
    const Eigen::ArrayXd value = model[number.parameter];
    if (number.channel < 0 && (value != value[0]).any())
    {
      // Alike in all channels from here on; the common number moves them together.
      hold(number.parameter, number.typical, value.mean());
    }
  }
  for (ImageParameter parameter = 0; parameter < fieldParameterCount(); ++parameter)
  {
    if (known[parameter] == 0 && !isShape(parameter) && !model.isNeutral(parameter))
    {
      hold(parameter, 1.0, numberOf(parameter).neutral);
    }
  }
  numbers.clear();
  for (const Bound& bound : bounds)
  {
    numbers.push_back(bound.number);
  }
  const std::vector<Design> design = designs(numbers, about);
  const Eigen::MatrixXd prior = priorOf(set, bounds);
  Eigen::VectorXd step;
  bool beyond = true;
  for (int round = 0; round < Rounds && beyond; ++round)
  {
    step = solve(Total, design, bounds, prior);
    beyond = false;
    for (std::size_t n = 0; n < bounds.size(); ++n)
    {
      Bound& bound = bounds[n];
      const double value = valueIn(model, bound.number) + step[static_cast<Eigen::Index>(n)];
      if (!bound.held && (value < bound.number.lower || value > bound.number.upper))
      {
        bound.held = true;
        bound.wanted = std::clamp(value, bound.number.lower, bound.number.upper);
        beyond = true;
      }
    }
  }
  FieldFit fit{ model, 0.0, 0.0, {} };
  for (std::size_t n = 0; n < bounds.size(); ++n)
  {
    const Bound& bound = bounds[n];
    const Eigen::Index channel = bound.number.channel;
    const double change =
      bound.held ? bound.wanted - valueIn(model, bound.number) : step[static_cast<Eigen::Index>(n)];
    fit.step = std::fmax(fit.step, std::fabs(change) / bound.number.typical);
    fit.next[bound.number.parameter].segment(
      std::max<Eigen::Index>(channel, 0), channel < 0 ? Data.channels() : 1) += change;
  }
  for (const std::vector<Eigen::MatrixXd>& own : Fold)
  {
    std::vector<Eigen::MatrixXd> others = Total;
    for (std::size_t k = 0; k < others.size(); ++k)
    {
      others[k] -= own[k];
    }
    const Eigen::VectorXd without = solve(others, design, bounds, prior);
    fit.change.emplace_back();
    for (std::size_t k = 0; k < others.size(); ++k)
    {
      fit.change.back().emplace_back(design[k].columns * without(design[k].numbers));
      fit.energy += energyLeft(own[k], fit.change.back().back());
    }
  }
  return fit;
}

Eigen::MatrixXd FieldFitter::priorOf(const FieldSet& set, const std::vector<Bound>& bounds) const
{
  const auto count = static_cast<Eigen::Index>(bounds.size());
  Eigen::MatrixXd prior = Eigen::MatrixXd::Zero(count, count);
  for (Eigen::Index n = 0; n < count; ++n)
  {
    prior(n, n) = precisionBefore(bounds[static_cast<std::size_t>(n)].number);
  }
  // Beside others numbers of single channels keep to what they do not have in common.
  std::vector<FreeNumber> numbers = freeNumbers(set, Statistics.model);
  const auto own = static_cast<Eigen::Index>(numbers.size());
  if (set.size() > 1 &&
    std::any_of(
      numbers.begin(), numbers.end(), [](const FreeNumber& number) { return number.perChannel; }))
  {
    const Eigen::MatrixXd posterior = information(set) + prior.topLeftCorner(own, own);
    const Eigen::VectorXd variance =
      posterior.ldlt().solve(Eigen::MatrixXd::Identity(own, own)).diagonal();
    for (Eigen::Index n = 0; n < own; ++n)
    {
      numbers[static_cast<std::size_t>(n)].variance = variance[n];
    }
    prior.topLeftCorner(own, own) = fitPrecision(numbers);
  }
  return prior;
}

Eigen::VectorXd FieldFitter::solve(const std::vector<Eigen::MatrixXd>& normal,
  const std::vector<Design>& design, const std::vector<Bound>& bounds,
  const Eigen::MatrixXd& prior) const
{
  const auto count = static_cast<Eigen::Index>(bounds.size());
  Eigen::VectorXd gradient = Eigen::VectorXd::Zero(count);
  if (count == 0)
  {
    return gradient;
  }
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(count, count);
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    information(design[k].numbers, design[k].numbers) += design[k].information(normal[k]);
    gradient(design[k].numbers) += design[k].gradient(normal[k]);
  }
  Eigen::VectorXd off(count);
  Eigen::MatrixXd precision = prior;
  for (Eigen::Index n = 0; n < count; ++n)
  {
    const Bound& bound = bounds[static_cast<std::size_t>(n)];
    off[n] = bound.wanted - valueIn(Statistics.model, bound.number);
    if (bound.held)
    {
      precision.row(n).setZero();
      precision.col(n).setZero();
      precision(n, n) = Held * (information(n, n) + 1.0);
    }
  }
  gradient += precision * off;
  information += precision;
  return information.ldlt().solve(gradient);
}

Eigen::VectorXd blockEnergies(
  const FieldData& data, const FieldStatistics& statistics, const FieldFit& fit)
{
  Eigen::VectorXd energy = Eigen::VectorXd::Zero(static_cast<Eigen::Index>(data.blocks.size()));
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    const int fold = data.blocks[b].fold;
    for (Eigen::Index k = 0; fold >= 0 && k < data.channels(); ++k)
    {
      energy[static_cast<Eigen::Index>(b)] += energyLeft(statistics.at(b, k).normal(),
        fit.change[static_cast<std::size_t>(fold)][static_cast<std::size_t>(k)]);
    }
  }
  return energy;
}

FieldFit FieldFitter::fitFromBestStart(const FieldSet& set) const
{
  FieldShape start;
  FieldFit best = fit(set);
  const auto tryOut = [&](const FieldShape& shape)
  {
    FieldFit other = fit(set, shape);
    if (other.energy < best.energy)
    {
      best = std::move(other);
      start = shape;
    }
  };
  for (const FieldChoice* choice : set)
  {
    if (!Statistics.model.isNeutral(choice->step()))
    {
      continue;
    }
    if (choice->twice)
    {
      FieldShape there = start;
      for (const ImageTerm& term : choice->terms)
      {
        there[term.parameter] = best.next.at(term.parameter, 0);
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
      shapes = more.empty() ? shapes : more;
    }
    for (std::size_t i = 0; shapes.size() > 1 && i < shapes.size(); ++i)
    {
      tryOut(shapes[i]);
    }
  }
  return best;
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

Eigen::MatrixXd FieldFitter::information(const FieldSet& set) const
{
  const std::vector<FieldNumber> numbers = numbersOf(set, Data.channels());
  const auto count = static_cast<Eigen::Index>(numbers.size());
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(count, count);
  const std::vector<Design> design = designs(numbers, Statistics.model);
  for (std::size_t k = 0; k < design.size(); ++k)
  {
    information(design[k].numbers, design[k].numbers) += design[k].information(Total[k]);
  }
  return information;
}

Eigen::VectorXd FieldFitter::standardErrors(const FieldSet& set) const
{
  const std::vector<FieldNumber> numbers = numbersOf(set, Data.channels());
  const std::vector<Design> design = designs(numbers, Statistics.model);
  Eigen::MatrixXd normal = information(set);
  const Eigen::Index p = normal.rows();
  for (Eigen::Index n = 0; n < p; ++n)
  {
    normal(n, n) += precisionBefore(numbers[static_cast<std::size_t>(n)]);
  }
  Eigen::MatrixXd scatter = Eigen::MatrixXd::Zero(p, p);
  std::map<int, Eigen::VectorXd> ofGroup;
  for (std::size_t b = 0; b < Data.blocks.size(); ++b)
  {
    if (Data.blocks[b].fold < 0)
    {
      continue;
    }
    Eigen::VectorXd& g =
      ofGroup.try_emplace(Data.blocks[b].group, Eigen::VectorXd::Zero(p)).first->second;
    for (std::size_t k = 0; k < design.size(); ++k)
    {
      g(design[k].numbers) +=
        design[k].gradient(Statistics.at(b, static_cast<Eigen::Index>(k)).normal());
    }
  }
  for (const auto& [number, g] : ofGroup)
  {
    scatter += g * g.transpose();
  }
  const Eigen::LDLT<Eigen::MatrixXd> factor(normal);
  const Eigen::MatrixXd half = factor.solve(scatter);
  const Eigen::MatrixXd covariance = factor.solve(half.transpose());
  return covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
}

} // namespace msi
