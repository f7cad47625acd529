#include "Kernels/Gap/Field/FieldBound.h"

#include "Kernels/Gap/Field/FieldDecisions.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <map>
#include <vector>

namespace msi
{

// What each number of the set changes in the columns of a channel; terms in order, channels within a per-channel term.
std::vector<Eigen::MatrixXd> FieldFitter::design(const FieldSet& set) const
{
  const auto K = Data.channels();
  const FieldShape shape = this->shape();
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
          coefficients(term.parameter, k, shape);
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
        std::pow(ImageDecision::PriorSize * term.typical, -2);
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
        Statistics.at(b, k).normal.col(FieldColumn::residual()).head(FieldColumn::residual());
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
