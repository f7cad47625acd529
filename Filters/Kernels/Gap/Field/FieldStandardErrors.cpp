#include "Kernels/Gap/Field/FieldBound.h"

#include "Kernels/Gap/Field/FieldDecisions.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <map>
#include <utility>

namespace msi
{

Eigen::VectorXd FieldFitter::standardErrors(const FieldSet& set) const
{
  const auto K = Data.channels();
  std::vector<std::pair<ImageTerm, Eigen::Index>> single; // channel, -1: common
  for (const FieldChoice* choice : set)
  {
    for (const ImageTerm& term : choice->terms)
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
    static_cast<std::size_t>(K), Eigen::MatrixXd::Zero(FieldColumn::residual(), p));
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
      Total[static_cast<std::size_t>(k)].topLeftCorner(
        FieldColumn::residual(), FieldColumn::residual()) *
      columns;
  }
  for (Eigen::Index i = 0; i < p; ++i)
  {
    information(i, i) +=
      std::pow(ImageDecision::PriorSize * single[static_cast<std::size_t>(i)].first.typical, -2);
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
        Statistics.at(b, k).normal.col(FieldColumn::residual()).head(FieldColumn::residual());
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

Eigen::MatrixXd FieldFitter::contributionProducts(const FieldSet& set) const
{
  const FieldModel& model = Statistics.model;
  const auto count = static_cast<Eigen::Index>(set.size());
  const FieldShape shape = this->shape();
  Eigen::MatrixXd products = Eigen::MatrixXd::Zero(count + 1, count + 1);
  for (Eigen::Index k = 0; k < Data.channels(); ++k)
  {
    Eigen::MatrixXd columns = Eigen::MatrixXd::Zero(FieldColumn::residual(), count + 1);
    for (Eigen::Index e = 0; e < count; ++e)
    {
      for (const ImageTerm& term : set[static_cast<std::size_t>(e)]->terms)
      {
        if (!isPlace(term.parameter))
        {
          columns.col(e) += (model.at(term.parameter, k) - neutralValue(term.parameter)) *
            coefficients(term.parameter, k, shape);
        }
      }
    }
    columns.col(count) = columns.leftCols(count).rowwise().sum();
    products += columns.transpose() *
      Total[static_cast<std::size_t>(k)].topLeftCorner(
        FieldColumn::residual(), FieldColumn::residual()) *
      columns;
  }
  return products;
}

} // namespace msi
