#include "Kernels/Gap/Field/FieldBound.h"

#include "Kernels/Gap/Field/FieldDecisions.h"

#include <Eigen/Cholesky>

#include <cmath>

namespace msi
{

namespace
{
constexpr double Held = 1e4; // times the information, of a parameter that is held
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
    A.emplace_back(FieldColumn::residual(), C);
    B.emplace_back(FieldColumn::residual(), O);
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
    const auto local = normal[static_cast<std::size_t>(k)].topLeftCorner(
      FieldColumn::residual(), FieldColumn::residual());
    H += A.back().transpose() * local * A.back();
    g += A.back().transpose() *
      normal[static_cast<std::size_t>(k)]
        .col(FieldColumn::residual())
        .head(FieldColumn::residual());
  }
  const auto pull = [this](const Bound& bound, Eigen::Index k, double information, double& onto)
  {
    const double value = Statistics.model.at(bound.term.parameter, k);
    const double precision = bound.held[static_cast<std::size_t>(k)] != 0
      ? Held * (information + 1.0)
      : std::pow(ImageDecision::PriorSize * bound.term.typical, -2);
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
    const auto local = normal[k].topLeftCorner(FieldColumn::residual(), FieldColumn::residual());
    const Eigen::MatrixXd LB = local * B[k];
    Eigen::MatrixXd D = B[k].transpose() * LB;
    Eigen::VectorXd h =
      B[k].transpose() * normal[k].col(FieldColumn::residual()).head(FieldColumn::residual());
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

} // namespace msi
