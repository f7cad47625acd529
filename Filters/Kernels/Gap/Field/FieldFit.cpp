#include "Kernels/Gap/Field/FieldFit.h"

#include "Kernels/Numerics/LeastSquares.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace msi
{

namespace
{
constexpr int Iterations = 6;
constexpr double Rising = 1.001;   // of the energy, by the prior alone
constexpr double SmallStep = 0.02; // typical sizes
}

struct FieldFitter::Design
{
  std::vector<Eigen::Index> numbers;
  Eigen::MatrixXd columns;

  // normal: products of the columns; change: of these, known beforehand.
  void add(
    const Eigen::MatrixXd& normal, const Eigen::VectorXd& change, NormalEquationsSum& sum) const
  {
    const Eigen::Index last = fieldColumns().residual;
    const auto products = normal.topLeftCorner(last, last);
    sum.add(numbers, columns.transpose() * products * columns, gradient(normal, change));
  }
  Eigen::VectorXd gradient(const Eigen::MatrixXd& normal, const Eigen::VectorXd& change) const
  {
    const Eigen::Index last = fieldColumns().residual;
    return columns.transpose() *
      (normal.col(last).head(last) - normal.topLeftCorner(last, last) * change);
  }
};

FieldFitter::FieldFitter(const FieldData& data, const FieldStatistics& statistics)
  : Data(data)
  , Statistics(statistics)
{
  for (int fold = 0; fold < FieldFolds; ++fold)
  {
    Fold.push_back(
      statistics.normals([&](std::size_t block) { return data.blocks[block].fold == fold; }));
    for (const Eigen::MatrixXd& normal : Fold.back())
    {
      Energy += normal(fieldColumns().residual, fieldColumns().residual);
    }
  }
}

std::vector<FieldFitter::Design> FieldFitter::designs(
  const std::vector<FieldNumber>& numbers, const FieldModel& about) const
{
  std::vector<Design> designs(Data.channels());
  for (Eigen::Index k = 0; k < Data.channels(); ++k)
  {
    for (std::size_t n = 0; n < numbers.size(); ++n)
    {
      if (numbers[n].channel < 0 || numbers[n].channel == k)
      {
        designs[k].numbers.push_back(n);
      }
    }
    designs[k].columns.resize(fieldColumns().residual, designs[k].numbers.size());
    for (Eigen::Index c = 0; c < designs[k].columns.cols(); ++c)
    {
      designs[k].columns.col(c) =
        columnsChanged(numbers[designs[k].numbers[c]].term->parameter, Statistics.model, about, k);
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
  std::vector<FieldNumber> numbers = numbersOf(set, about);
  FieldFit fit{ model, 0.0, 0.0, {}, {}, {} };
  std::vector<char> isFree(fieldParameterCount(), 0);
  for (FieldNumber& number : numbers)
  {
    const ImageParameter parameter = number.term->parameter;
    isFree[parameter] = 1;
    if (number.channel < 0 && (model[parameter] != model.at(parameter, 0)).any())
    {
      fit.next[parameter].setConstant(
        model[parameter].mean()); // alike in all channels from here on
    }
    number.deviation = fit.next.at(parameter, std::max<Eigen::Index>(number.channel, 0)) -
      numberOf(parameter).neutral;
  }
  for (ImageParameter parameter = 0; parameter < fieldParameterCount(); ++parameter)
  {
    if (isFree[parameter] == 0 && !isShape(parameter))
    {
      fit.next[parameter].setConstant(numberOf(parameter).neutral);
    }
  }
  const std::vector<Design> design = designs(numbers, about);
  // What the columns change by numbers that are not free.
  std::vector<Eigen::VectorXd> known;
  for (Eigen::Index k = 0; k < Data.channels(); ++k)
  {
    known.emplace_back(Eigen::VectorXd::Zero(fieldColumns().residual));
    for (ImageParameter parameter = 0; parameter < fieldParameterCount(); ++parameter)
    {
      const double change = fit.next.at(parameter, k) - model.at(parameter, k);
      if (change != 0.0)
      {
        known.back() += change * columnsChanged(parameter, model, about, k);
        fit.step = std::fmax(fit.step, std::fabs(change));
      }
    }
  }
  std::vector<NormalEquations> folds;
  for (const std::vector<Eigen::MatrixXd>& normal : Fold)
  {
    NormalEquationsSum sum(numbers.size());
    for (std::size_t k = 0; k < design.size(); ++k)
    {
      design[k].add(normal[k], known[k], sum);
    }
    folds.push_back(sum.sum());
  }
  fit.linear = LinearFit({ numbers.begin(), numbers.end() }, std::move(folds), set.size() > 1);
  fit.increase = fit.linear.step();
  for (std::size_t n = 0; n < numbers.size(); ++n)
  {
    const FieldNumber& number = numbers[n];
    const double change = fit.increase[n];
    fit.step = std::fmax(fit.step, std::fabs(change) / number.typical);
    fit.next[number.term->parameter].segment(std::max<Eigen::Index>(number.channel, 0),
      number.channel < 0 ? Data.channels() : 1) += change;
  }
  const std::vector<Eigen::VectorXd> without = fit.linear.stepsWithout();
  for (std::size_t f = 0; f < Fold.size(); ++f)
  {
    fit.change.emplace_back();
    for (std::size_t k = 0; k < design.size(); ++k)
    {
      fit.change.back().emplace_back(known[k] + design[k].columns * without[f](design[k].numbers));
      fit.energy += energyLeft(Fold[f][k], fit.change.back().back());
    }
  }
  return fit;
}

Eigen::VectorXd blockEnergies(
  const FieldData& data, const FieldStatistics& statistics, const FieldFit& fit)
{
  Eigen::VectorXd energy = Eigen::VectorXd::Zero(data.blocks.size());
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    const int fold = data.blocks[b].fold;
    for (Eigen::Index k = 0; fold >= 0 && k < data.channels(); ++k)
    {
      energy[b] += statistics.at(b, k).energyLeft(fit.change[fold][k]);
    }
  }
  return energy;
}

FieldFit FieldFitter::fitFromBestStart(const FieldSet& set) const
{
  FieldShape start;
  FieldFit best = fit(set);
  for (const FieldChoice* choice : set)
  {
    if (!Statistics.model.isNeutral(choice->step()))
    {
      continue;
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
      FieldFit other = fit(set, shapes[i]);
      if (other.energy < best.energy)
      {
        best = std::move(other);
        start = shapes[i];
      }
    }
  }
  return best;
}

FieldHypothesis refitted(
  const FieldData& data, const FieldWeights& weights, const FieldSet& set, const FieldModel& start)
{
  const AskedSteps asked = stepsOf(set);
  FieldModel model = start;
  FieldHypothesis best;
  double least = 0.0;
  for (int iteration = 0; iteration < Iterations; ++iteration)
  {
    const auto statistics =
      std::make_shared<FieldStatistics>(fieldStatistics(data, model, &weights, asked));
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

Eigen::VectorXd FieldFitter::standardErrors(const FieldSet& set, const FieldFit& fit) const
{
  const std::vector<FieldNumber> numbers = numbersOf(set, Statistics.model);
  const std::vector<Design> design = designs(numbers, Statistics.model);
  const Eigen::Index count = numbers.size();
  std::map<int, Eigen::VectorXd> ofGroup;
  for (std::size_t b = 0; b < Data.blocks.size(); ++b)
  {
    const FieldBlock& block = Data.blocks[b];
    for (std::size_t k = 0; block.fold >= 0 && k < design.size(); ++k)
    {
      ofGroup.try_emplace(block.group, Eigen::VectorXd::Zero(count))
        .first->second(design[k].numbers) +=
        design[k].gradient(Statistics.at(b, k).normal(), fit.change[block.fold][k]);
    }
  }
  Eigen::MatrixXd scores(count, 0);
  for (const auto& [number, score] : ofGroup)
  {
    scores.conservativeResize(Eigen::NoChange, scores.cols() + 1);
    scores.rightCols(1) = score;
  }
  return fit.linear.covariance(scores).diagonal().cwiseMax(0.0).cwiseSqrt();
}

} // namespace msi
