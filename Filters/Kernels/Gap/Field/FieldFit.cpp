#include "Kernels/Gap/Field/FieldFit.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <map>

namespace msi
{

namespace
{
constexpr int Columns = FieldColumn::Residual;
constexpr double PriorSize = 10.0; // typical sizes
constexpr double Held = 1e4;       // times the information, of a parameter that is held
constexpr int Rounds = 3;
}

// A term with the value that is wanted (prior or hold), channel by channel.
struct FieldFitter::Bound
{
  FieldTerm term;
  Eigen::ArrayXd wanted;
  std::vector<char> held;
};

FieldFitter::FieldFitter(const FieldData& data, const FieldStatistics& statistics)
  : Data(data)
  , Statistics(statistics)
  , Glare(sceneMean(data, statistics.model))
{
  const auto K = static_cast<std::size_t>(data.channels());
  const Eigen::MatrixXd zero = Eigen::MatrixXd::Zero(FieldColumn::Count, FieldColumn::Count);
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
      Energy += sums.normal(Columns, Columns);
      Chance += sums.chance;
    }
  }
}

// The normal matrix is an arrow: parameters of one channel meet only those of that channel and the common ones. The
// channels are eliminated one by one, then the common ones are solved for.
// Returns the change of the columns, K; `values` gets the parameters.
std::vector<Eigen::VectorXd> FieldFitter::solve(const std::vector<Eigen::MatrixXd>& normal,
  const std::vector<Bound>& terms, std::vector<Eigen::ArrayXd>& values,
  const FieldShape& shape) const
{
  const auto K = static_cast<Eigen::Index>(normal.size());
  std::vector<std::size_t> common;
  std::vector<std::size_t> own;
  for (std::size_t t = 0; t < terms.size(); ++t)
  {
    (terms[t].term.perChannel ? own : common).push_back(t);
  }
  const auto C = static_cast<Eigen::Index>(common.size());
  const auto O = static_cast<Eigen::Index>(own.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(C, C);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(C);
  std::vector<Eigen::MatrixXd> A;
  std::vector<Eigen::MatrixXd> B;
  for (Eigen::Index k = 0; k < K; ++k)
  {
    A.emplace_back(Columns, C);
    B.emplace_back(Columns, O);
    for (Eigen::Index c = 0; c < C; ++c)
    {
      A.back().col(c) =
        coefficients(terms[common[static_cast<std::size_t>(c)]].term.parameter, k, shape);
    }
    for (Eigen::Index o = 0; o < O; ++o)
    {
      B.back().col(o) =
        coefficients(terms[own[static_cast<std::size_t>(o)]].term.parameter, k, shape);
    }
    const auto local = normal[static_cast<std::size_t>(k)].topLeftCorner(Columns, Columns);
    H += A.back().transpose() * local * A.back();
    g += A.back().transpose() * normal[static_cast<std::size_t>(k)].col(Columns).head(Columns);
  }
  const auto pull = [this](const Bound& bound, Eigen::Index k, double information, double& onto)
  {
    const double value = Statistics.model.at(bound.term.parameter, k);
    const double precision = bound.held[static_cast<std::size_t>(k)] != 0
      ? Held * (information + 1.0)
      : std::pow(PriorSize * bound.term.typical, -2);
    onto += precision * (bound.wanted[k] - value);
    return precision;
  };
  for (Eigen::Index c = 0; c < C; ++c)
  {
    H(c, c) += pull(terms[common[static_cast<std::size_t>(c)]], 0, H(c, c), g[c]);
  }
  std::vector<Eigen::MatrixXd> toCommon;
  std::vector<Eigen::VectorXd> alone;
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    const auto local = normal[k].topLeftCorner(Columns, Columns);
    const Eigen::MatrixXd LB = local * B[k];
    Eigen::MatrixXd D = B[k].transpose() * LB;
    Eigen::VectorXd h = B[k].transpose() * normal[k].col(Columns).head(Columns);
    for (Eigen::Index o = 0; o < O; ++o)
    {
      D(o, o) +=
        pull(terms[own[static_cast<std::size_t>(o)]], static_cast<Eigen::Index>(k), D(o, o), h[o]);
    }
    const Eigen::MatrixXd E = LB.transpose() * A[k]; // O x C
    const Eigen::LDLT<Eigen::MatrixXd> factor(D);
    toCommon.emplace_back(O > 0 && C > 0 ? Eigen::MatrixXd(factor.solve(E)) : E);
    alone.emplace_back(O > 0 ? Eigen::VectorXd(factor.solve(h)) : h);
    if (O > 0)
    {
      H -= E.transpose() * toCommon.back();
      g -= E.transpose() * alone.back();
    }
  }
  const Eigen::VectorXd change = C > 0 ? Eigen::VectorXd(H.ldlt().solve(g)) : g;
  std::vector<Eigen::VectorXd> columns;
  values.assign(terms.size(), Eigen::ArrayXd());
  for (std::size_t t = 0; t < terms.size(); ++t)
  {
    values[t] = Statistics.model[terms[t].term.parameter];
  }
  for (Eigen::Index c = 0; c < C; ++c)
  {
    values[common[static_cast<std::size_t>(c)]] += change[c];
  }
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    const Eigen::VectorXd mine = alone[k] - toCommon[k] * change;
    for (Eigen::Index o = 0; o < O; ++o)
    {
      values[own[static_cast<std::size_t>(o)]][static_cast<Eigen::Index>(k)] += mine[o];
    }
    columns.emplace_back(A[k] * change + B[k] * mine);
  }
  return columns;
}

FieldShape FieldFitter::shape() const
{
  const FieldModel& model = Statistics.model;
  return { model.at(FieldParameter::TailRadius, 0), model.at(FieldParameter::CenterX, 0),
    model.at(FieldParameter::CenterY, 0) };
}

FieldFit FieldFitter::fit(const FieldSet& set, const FieldShape& start) const
{
  const FieldModel& model = Statistics.model;
  const auto K = static_cast<std::size_t>(Data.channels());
  FieldShape shape = this->shape();
  if (start.radius > 0.0 && model.isNeutral(FieldParameter::TailFraction))
  {
    shape.radius = start.radius;
  }
  if (!model.hasVignetting())
  {
    shape.centerX = start.centerX;
    shape.centerY = start.centerY;
  }
  std::vector<Bound> terms;
  std::vector<char> known(FieldParameters, 0);
  const auto add = [&](const FieldTerm& term, bool held)
  {
    const double neutral = term.parameter == FieldParameter::TailRadius ? shape.radius
      : term.parameter == FieldParameter::CenterX && !held               ? shape.centerX
      : term.parameter == FieldParameter::CenterY && !held               ? shape.centerY
      : isShape(term.parameter) ? model.at(term.parameter, 0)
                                : neutralValue(term.parameter);
    terms.push_back({ term, Eigen::ArrayXd::Constant(Data.channels(), neutral),
      std::vector<char>(K, held ? 1 : 0) });
    known[static_cast<std::size_t>(term.parameter)] = 1;
  };
  for (const FieldChoice* choice : set)
  {
    for (const FieldTerm& term : choice->terms)
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
  for (std::size_t p = 0; p < FieldParameters; ++p)
  {
    const auto parameter = static_cast<FieldParameter>(p);
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
  fit.next[FieldParameter::TailRadius].setConstant(shape.radius);
  std::vector<char> seen(FieldParameters, 0);
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
  fit.blockEnergy.setZero(static_cast<Eigen::Index>(Data.blocks.size()));
  for (int fold = 0; fold < FieldFolds; ++fold)
  {
    std::vector<Eigen::MatrixXd> others = Total;
    for (std::size_t k = 0; k < K; ++k)
    {
      others[k] -= Fold[static_cast<std::size_t>(fold)][k];
    }
    const std::vector<Eigen::VectorXd> change = solve(others, terms, values, shape);
    for (std::size_t b = 0; b < Data.blocks.size(); ++b)
    {
      for (std::size_t k = 0; Data.blocks[b].fold == fold && k < K; ++k)
      {
        const Eigen::MatrixXd& normal = Statistics.at(b, static_cast<Eigen::Index>(k)).normal;
        fit.blockEnergy[static_cast<Eigen::Index>(b)] += normal(Columns, Columns) -
          2.0 * change[k].dot(normal.col(Columns).head(Columns)) +
          change[k].dot(normal.topLeftCorner(Columns, Columns) * change[k]);
      }
    }
  }
  fit.energy = fit.blockEnergy.sum();
  return fit;
}

Eigen::VectorXd FieldFitter::standardErrors(const FieldSet& set) const
{
  const auto K = Data.channels();
  std::vector<std::pair<FieldTerm, Eigen::Index>> single; // channel, -1: common
  for (const FieldChoice* choice : set)
  {
    for (const FieldTerm& term : choice->terms)
    {
      for (Eigen::Index k = term.perChannel ? 0 : -1; k < (term.perChannel ? K : 0); ++k)
      {
        single.emplace_back(term, k);
      }
    }
  }
  const auto p = static_cast<Eigen::Index>(single.size());
  const FieldShape shape = this->shape();
  std::vector<Eigen::MatrixXd> design(
    static_cast<std::size_t>(K), Eigen::MatrixXd::Zero(Columns, p));
  Eigen::MatrixXd information = Eigen::MatrixXd::Zero(p, p);
  for (Eigen::Index k = 0; k < K; ++k)
  {
    Eigen::MatrixXd& columns = design[static_cast<std::size_t>(k)];
    for (Eigen::Index i = 0; i < p; ++i)
    {
      const auto& [term, channel] = single[static_cast<std::size_t>(i)];
      if (channel < 0 || channel == k)
      {
        columns.col(i) = coefficients(term.parameter, k, shape);
      }
    }
    information += columns.transpose() *
      Total[static_cast<std::size_t>(k)].topLeftCorner(Columns, Columns) * columns;
  }
  for (Eigen::Index i = 0; i < p; ++i)
  {
    information(i, i) +=
      std::pow(PriorSize * single[static_cast<std::size_t>(i)].first.typical, -2);
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
      g += design[static_cast<std::size_t>(k)].transpose() *
        Statistics.at(b, k).normal.col(Columns).head(Columns);
    }
  }
  for (const auto& [number, g] : ofGroup)
  {
    scatter += g * g.transpose();
  }
  const Eigen::LDLT<Eigen::MatrixXd> factor(information);
  const Eigen::MatrixXd half = factor.solve(scatter);
  const Eigen::MatrixXd covariance = factor.solve(half.transpose());
  return covariance.diagonal().cwiseMax(0.0).cwiseSqrt();
}

} // namespace msi
