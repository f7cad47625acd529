#include "Kernels/Gap/Field/FieldFit.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <map>

namespace msi
{

namespace
{
constexpr int Rounds = 3;
constexpr double Held = 1e4; // times the information, of a parameter that is held
}

// A term with the value that is wanted (prior or hold), channel by channel.
struct FieldFitter::Bound
{
  ImageTerm term;
  Eigen::ArrayXd wanted;
  std::vector<char> held;
};

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
      const Eigen::MatrixXd normal = sums.normal();
      Total[k] += normal;
      Fold[static_cast<std::size_t>(fold)][k] += normal;
      Energy += normal(FieldColumn::residual(), FieldColumn::residual());
      Chance += sums.chance;
    }
  }
}

FieldFit FieldFitter::fit(const FieldSet& set, const FieldShape& start, FieldDetail detail) const
{
  const FieldModel& model = Statistics.model;
  const auto K = static_cast<std::size_t>(Data.channels());
  FieldModel about = model;
  for (const auto& [parameter, value] : start)
  {
    if (model.isNeutral(stepOf(parameter)))
    {
      about[parameter].setConstant(value);
    }
  }
  std::vector<Bound> terms;
  std::vector<char> known(fieldParameterCount(), 0);
  const auto add = [&](const ImageTerm& term, bool held)
  {
    const ImageNumber& number = numberOf(term.parameter);
    const bool free = isShape(term.parameter) || (number.pull == ImagePull::Itself && !held);
    const double neutral = free ? about.at(term.parameter, 0) : number.neutral;
    terms.push_back({ term, Eigen::ArrayXd::Constant(Data.channels(), neutral),
      std::vector<char>(K, held ? 1 : 0) });
    known[term.parameter] = 1;
  };
  for (const FieldChoice* choice : set)
  {
    for (const ImageTerm& term : choice->terms)
    {
      add(term, false);
      const Eigen::ArrayXd value = model[term.parameter];
      if (!term.perChannel && (value != value[0]).any())
      {
        // Alike in all channels from here on; the common term moves them together.
        add({ term.parameter, true, 0.0, 0.0, term.typical }, true);
        terms.back().wanted.setConstant(value.mean());
      }
    }
  }
  for (ImageParameter parameter = 0; parameter < fieldParameterCount(); ++parameter)
  {
    if (known[parameter] == 0 && !isShape(parameter) && !model.isNeutral(parameter))
    {
      add({ parameter, true, 0.0, 0.0, 1.0 }, true);
    }
  }
  FieldFit fit{ set, model, 0.0, Eigen::VectorXd(), 0.0 };
  std::vector<Eigen::ArrayXd> values;
  for (int round = 0; round < Rounds; ++round)
  {
    solve(Total, terms, values, about);
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
    const bool again = seen[bound.term.parameter] != 0;
    seen[bound.term.parameter] = 1;
    const Eigen::ArrayXd before = model[bound.term.parameter];
    const Eigen::ArrayXd found = fit.next[bound.term.parameter];
    fit.next[bound.term.parameter] = again ? Eigen::ArrayXd(found + value - before) : value;
  }
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
    const std::vector<Eigen::VectorXd> change = solve(others, terms, values, about);
    for (std::size_t k = 0; k < K; ++k)
    {
      fit.energy += energyLeft(own[k], change[k]);
    }
    for (std::size_t b = 0; detail == FieldDetail::Blocks && b < Data.blocks.size(); ++b)
    {
      for (std::size_t k = 0; Data.blocks[b].fold == fold && k < K; ++k)
      {
        fit.blockEnergy[static_cast<Eigen::Index>(b)] +=
          energyLeft(Statistics.at(b, static_cast<Eigen::Index>(k)).normal(), change[k]);
      }
    }
  }
  return fit;
}

ArrowSolution solved(ArrowEquations equations)
{
  const Eigen::Index C = equations.common.rows();
  std::vector<Eigen::MatrixXd> toCommon;
  ArrowSolution solution;
  for (std::size_t k = 0; k < equations.own.size(); ++k)
  {
    const Eigen::MatrixXd& across = equations.across[k];
    const Eigen::VectorXd& gradient = equations.ownGradient[k];
    const bool own = gradient.size() > 0;
    const Eigen::LDLT<Eigen::MatrixXd> factor(equations.own[k]);
    toCommon.emplace_back(own && C > 0 ? Eigen::MatrixXd(factor.solve(across)) : across);
    solution.own.emplace_back(own ? Eigen::VectorXd(factor.solve(gradient)) : gradient);
    if (own)
    {
      equations.common -= across.transpose() * toCommon.back();
      equations.gradient -= across.transpose() * solution.own.back();
    }
  }
  solution.common =
    C > 0 ? Eigen::VectorXd(equations.common.ldlt().solve(equations.gradient)) : equations.gradient;
  for (std::size_t k = 0; k < equations.own.size(); ++k)
  {
    solution.own[k] -= toCommon[k] * solution.common;
  }
  return solution;
}

// Returns the change of the columns, K; `values` gets the parameters.
std::vector<Eigen::VectorXd> FieldFitter::solve(const std::vector<Eigen::MatrixXd>& normal,
  const std::vector<Bound>& terms, std::vector<Eigen::ArrayXd>& values,
  const FieldModel& about) const
{
  std::vector<const Bound*> common;
  std::vector<const Bound*> own;
  for (const Bound& bound : terms)
  {
    (bound.term.perChannel ? own : common).push_back(&bound);
  }
  const auto design = [&](const std::vector<const Bound*>& bounds, Eigen::Index channel)
  {
    Eigen::MatrixXd columns(FieldColumn::residual(), static_cast<Eigen::Index>(bounds.size()));
    for (std::size_t b = 0; b < bounds.size(); ++b)
    {
      columns.col(static_cast<Eigen::Index>(b)) =
        columnsChanged(bounds[b]->term.parameter, Statistics.model, about, channel);
    }
    return columns;
  };
  // Priors and holds.
  const auto pull = [&](const std::vector<const Bound*>& bounds, Eigen::Index channel,
                      Eigen::MatrixXd& information, Eigen::VectorXd& gradient)
  {
    for (std::size_t b = 0; b < bounds.size(); ++b)
    {
      const Bound& bound = *bounds[b];
      const auto at = static_cast<Eigen::Index>(b);
      const double precision = bound.held[static_cast<std::size_t>(channel)] != 0
        ? Held * (information(at, at) + 1.0)
        : std::pow(Decision::FreeSpread * bound.term.typical, -2);
      gradient[at] +=
        precision * (bound.wanted[channel] - Statistics.model.at(bound.term.parameter, channel));
      information(at, at) += precision;
    }
  };
  const auto C = static_cast<Eigen::Index>(common.size());
  ArrowEquations equations{ Eigen::MatrixXd::Zero(C, C), Eigen::VectorXd::Zero(C), {}, {}, {} };
  std::vector<Eigen::MatrixXd> A;
  std::vector<Eigen::MatrixXd> B;
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    const auto channel = static_cast<Eigen::Index>(k);
    A.push_back(design(common, channel));
    B.push_back(design(own, channel));
    const auto local = normal[k].topLeftCorner(FieldColumn::residual(), FieldColumn::residual());
    const auto residual = normal[k].col(FieldColumn::residual()).head(FieldColumn::residual());
    equations.common += A[k].transpose() * local * A[k];
    equations.gradient += A[k].transpose() * residual;
    const Eigen::MatrixXd along = local * B[k];
    equations.own.emplace_back(B[k].transpose() * along);
    equations.ownGradient.emplace_back(B[k].transpose() * residual);
    equations.across.emplace_back(along.transpose() * A[k]);
    pull(own, channel, equations.own[k], equations.ownGradient[k]);
  }
  pull(common, 0, equations.common, equations.gradient);
  const ArrowSolution solution = solved(std::move(equations));
  std::vector<Eigen::VectorXd> columns;
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    columns.emplace_back(A[k] * solution.common + B[k] * solution.own[k]);
  }
  values.clear();
  Eigen::Index nextCommon = 0;
  Eigen::Index nextOwn = 0;
  for (const Bound& bound : terms)
  {
    values.emplace_back(Statistics.model[bound.term.parameter]);
    for (std::size_t k = 0; bound.term.perChannel && k < normal.size(); ++k)
    {
      values.back()[static_cast<Eigen::Index>(k)] += solution.own[k][nextOwn];
    }
    values.back() += bound.term.perChannel ? 0.0 : solution.common[nextCommon];
    ++(bound.term.perChannel ? nextOwn : nextCommon);
  }
  return columns;
}

// What each number of the set changes in the columns of a channel; terms in order, channels within a per-channel term.
std::vector<Eigen::MatrixXd> FieldFitter::design(const FieldSet& set) const
{
  const auto K = Data.channels();
  Eigen::Index count = 0;
  for (const FieldChoice* choice : set)
  {
    for (const ImageTerm& term : choice->terms)
    {
      count += term.perChannel ? K : 1;
    }
  }
  std::vector<Eigen::MatrixXd> design(
    static_cast<std::size_t>(K), Eigen::MatrixXd::Zero(FieldColumn::residual(), count));
  for (Eigen::Index k = 0; k < K; ++k)
  {
    Eigen::Index next = 0;
    for (const FieldChoice* choice : set)
    {
      for (const ImageTerm& term : choice->terms)
      {
        design[static_cast<std::size_t>(k)].col(next + (term.perChannel ? k : 0)) =
          columnsChanged(term.parameter, Statistics.model, Statistics.model, k);
        next += term.perChannel ? K : 1;
      }
    }
  }
  return design;
}

Eigen::MatrixXd FieldFitter::information(const FieldSet& set) const
{
  const std::vector<Eigen::MatrixXd> columns = design(set);
  const Eigen::Index count = columns.front().cols();
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(count, count);
  for (std::size_t k = 0; k < columns.size(); ++k)
  {
    information += columns[k].transpose() *
      Total[k].topLeftCorner(FieldColumn::residual(), FieldColumn::residual()) * columns[k];
  }
  return information;
}

Eigen::VectorXd FieldFitter::standardErrors(const FieldSet& set) const
{
  const auto K = Data.channels();
  const std::vector<Eigen::MatrixXd> columns = design(set);
  Eigen::MatrixXd normal = information(set);
  const Eigen::Index p = normal.rows();
  Eigen::Index next = 0;
  for (const FieldChoice* choice : set)
  {
    for (const ImageTerm& term : choice->terms)
    {
      const Eigen::Index size = term.perChannel ? K : 1;
      normal.diagonal().segment(next, size).array() +=
        std::pow(Decision::FreeSpread * term.typical, -2);
      next += size;
    }
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
    for (Eigen::Index k = 0; k < K; ++k)
    {
      g += columns[static_cast<std::size_t>(k)].transpose() *
        Statistics.at(b, k).normal().col(FieldColumn::residual()).head(FieldColumn::residual());
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
