#include "Kernels/Estimation/Methods/Methods.h"

#include "Kernels/Estimation/CrossValidation.h"
#include "Kernels/Estimation/ExpansionEstimator.h"
#include "Kernels/Estimation/KernelSystem.h"

#include <cmath>
#include <limits>
#include <sstream>
#include <vector>

namespace msi
{

namespace
{
struct ExpansionCandidate
{
  Expansion expansion = Expansion::Linear;
  double penalty = 1e-5;
  double tuningWeight = 1.0;
};

// Terms centered and divided by their standard deviation, samples by columns.
struct ScaledTerms
{
  ScaledTerms(Expansion expansion, const Eigen::MatrixXd& responses)
    : values(expanded(expansion, responses))
    , mean(values.rowwise().mean())
  {
    values.colwise() -= mean;
    inverse = values.cwiseAbs2().rowwise().mean().cwiseSqrt().unaryExpr(
      [](double deviation) { return deviation > 0.0 ? 1.0 / deviation : 0.0; });
    values = inverse.asDiagonal() * values;
  }
  Eigen::MatrixXd gram() const
  {
    return values.transpose() * values / static_cast<double>(values.rows());
  }

  Eigen::MatrixXd values;
  Eigen::VectorXd mean;
  Eigen::VectorXd inverse;
};

std::string_view describe(Expansion expansion)
{
  switch (expansion)
  {
    case Expansion::Linear:
      return "responses";
    case Expansion::Squares:
      return "responses and squares";
    case Expansion::Products:
      return "responses and products of two";
    case Expansion::Roots:
      break;
  }
  return "responses and roots of products of two";
}

EstimationFit fitExpansions(
  const SampleSet& calibration, const SampleSet& tuning, const std::vector<Expansion>& expansions)
{
  requireTrainingSamples(calibration, tuning);
  const SampleSet samples = joined(calibration, tuning);
  const Eigen::VectorXd scale = samples.response.cwiseAbs2().rowwise().mean().cwiseSqrt().unaryExpr(
    [](double size) { return size > 0.0 ? 1.0 / size : 1.0; });
  const Eigen::MatrixXd responses = scale.asDiagonal() * samples.response;
  const Eigen::MatrixXd outputs = samples.reflectance.transpose();
  const auto solve = [&](const ExpansionCandidate& candidate, const Eigen::MatrixXd& gram)
  {
    return solveKernelSystem(gram, outputs,
      joinedWeights(calibration.size(), tuning.size(), candidate.tuningWeight), candidate.penalty);
  };

  CandidateChoice choice;
  choice.leftOutRms = std::numeric_limits<double>::quiet_NaN();
  ExpansionCandidate best;
  if (tuning.size() >= FewestToChoose)
  {
    double least = std::numeric_limits<double>::infinity();
    for (const Expansion expansion : expansions)
    {
      const Eigen::MatrixXd gram = ScaledTerms(expansion, responses).gram();
      for (const double penalty : { 1e-2, 1e-3, 1e-4, 1e-5, 1e-6, 1e-7 })
      {
        for (const double weight : tuningWeights(calibration, tuning))
        {
          const ExpansionCandidate candidate{ expansion, penalty, weight };
          const double squares =
            solve(candidate, gram).leftOutError.bottomRows(tuning.size()).squaredNorm();
          if (squares < least)
          {
            least = squares;
            best = candidate;
          }
        }
      }
    }
    choice.leftOutRms = std::sqrt(least / static_cast<double>(tuning.reflectance.size()));
    choice.chosen = true;
  }

  const ScaledTerms terms(best.expansion, responses);
  const KernelSolution solution = solve(best, terms.gram());
  const auto count = static_cast<double>(terms.values.rows());
  Eigen::MatrixXd coefficients(samples.bands(), terms.values.rows() + 1);
  coefficients.leftCols(terms.values.rows()) =
    (terms.values * solution.coefficients).transpose() * (terms.inverse / count).asDiagonal();
  coefficients.rightCols(1) =
    solution.constant - coefficients.leftCols(terms.values.rows()) * terms.mean;
  EstimationFit result;
  result.estimator = std::make_shared<ExpansionEstimator>(NamedMatrices{
    { "expansion.kind", Eigen::MatrixXd::Constant(1, 1, static_cast<double>(best.expansion)) },
    { "expansion.scale", scale }, { "expansion.coefficients", coefficients } });
  std::ostringstream status;
  status.precision(3);
  status << describe(best.expansion) << ", penalty " << best.penalty << ", tuning weight "
         << best.tuningWeight << ", " << choiceText(choice, tuning);
  result.summary = summaryOfChoice(choice, calibration, tuning, status.str());
  result.summary.unknowns = coefficients.size();
  return result;
}

EstimationFit fitPolynomial(
  const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& /*options*/)
{
  return fitExpansions(
    calibration, tuning, { Expansion::Linear, Expansion::Squares, Expansion::Products });
}

EstimationFit fitRootPolynomial(
  const SampleSet& calibration, const SampleSet& tuning, const EstimationOptions& /*options*/)
{
  return fitExpansions(calibration, tuning, { Expansion::Linear, Expansion::Roots });
}
}

EstimationMethod polynomialMethod()
{
  return { "polynomial", "Polynomial", "weighted polynomial regression of degree one or two",
    fitPolynomial };
}

EstimationMethod rootPolynomialMethod()
{
  return { "root-polynomial", "Root-polynomial",
    "weighted regression on roots of products of responses", fitRootPolynomial };
}

} // namespace msi
