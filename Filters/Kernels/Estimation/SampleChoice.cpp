#include "Kernels/Estimation/SampleChoice.h"

#include "Kernels/Estimation/Transfer/TransferFeatures.h"
#include "Kernels/Estimation/Transfer/TransferKernel.h"
#include "Kernels/Spectra/Counted.h"

#include <Eigen/Cholesky>

#include <cmath>
#include <limits>
#include <sstream>
#include <stdexcept>
#include <string>

namespace msi
{

namespace
{
void requireResponses(const Eigen::MatrixXd& responses, const std::string& name)
{
  if (responses.size() == 0)
  {
    throw std::invalid_argument(
      "there are no " + name + " responses; expected at least one sample");
  }
  if (!responses.allFinite())
  {
    throw std::invalid_argument(
      "a response of the " + name + " samples is not finite; expected finite numbers");
  }
}

// Each channel divided by its root mean square over the chart, as the method transfer does.
Eigen::VectorXd inverseScales(const Eigen::MatrixXd& chart)
{
  return chart.cwiseAbs2().rowwise().mean().cwiseSqrt().unaryExpr(
    [](double scale) { return scale > 0.0 ? 1.0 / scale : 1.0; });
}

// Covariance of the candidates' reflectance, up to a common factor, once the chart is known.
Eigen::MatrixXd candidateCovariance(
  const TransferKernel& kernel, const Eigen::MatrixXd& chart, const Eigen::MatrixXd& candidates)
{
  const TransferFeatures features = featuresOf(TransferSpace::Linear, chart);
  const Eigen::MatrixXd a = features.ofChart(chart);
  const Eigen::MatrixXd b = features.ofChart(candidates);
  Eigen::MatrixXd ofChart = covariance(kernel, a, a.cols(), a, a.cols());
  ofChart.diagonal().array() += kernel[TransferKernel::ChartNoise];
  const Eigen::MatrixXd white =
    ofChart.llt().matrixL().solve(covariance(kernel, a, a.cols(), b, 0));
  return covariance(kernel, b, 0, b, 0) - white.transpose() * white;
}

Eigen::ArrayXd expectedErrors(const Eigen::ArrayXd& variances)
{
  return variances.max(0.0).sqrt();
}
}

SampleChoice chooseSamples(const Eigen::MatrixXd& chartResponses,
  const Eigen::MatrixXd& candidateResponses, Eigen::Index count)
{
  requireResponses(chartResponses, "chart");
  requireResponses(candidateResponses, "candidate");
  std::ostringstream message;
  if (chartResponses.rows() != candidateResponses.rows())
  {
    message << "the chart has " << chartResponses.rows()
            << " response channels and the candidates have " << candidateResponses.rows()
            << "; expected the same channels in both";
    throw std::invalid_argument(message.str());
  }
  if (count < 1 || count > candidateResponses.cols())
  {
    message << counted(count, "sample") << (count == 1 ? " is" : " are") << " to be chosen from "
            << candidateResponses.cols() << "; expected a number from 1 to "
            << candidateResponses.cols();
    throw std::invalid_argument(message.str());
  }
  const TransferKernel kernel = startingKernel();
  const double noise = kernel[TransferKernel::TargetNoise];
  const Eigen::VectorXd scales = inverseScales(chartResponses);
  Eigen::MatrixXd left = candidateCovariance(
    kernel, scales.asDiagonal() * chartResponses, scales.asDiagonal() * candidateResponses);
  const double before = expectedErrors(left.diagonal().array()).sum();

  SampleChoice choice;
  Eigen::ArrayXd remaining = Eigen::ArrayXd::Zero(left.cols()); // were this candidate measured, too
  while (static_cast<Eigen::Index>(choice.samples.size()) < count)
  {
    const Eigen::ArrayXd variances = left.diagonal().array();
    for (Eigen::Index i = 0; i < left.cols(); ++i)
    {
      remaining[i] =
        expectedErrors(variances - left.col(i).array().square() / (variances[i] + noise)).sum();
    }
    remaining(choice.samples).setConstant(std::numeric_limits<double>::infinity());
    Eigen::Index next = 0;
    choice.explained.push_back(1.0 - remaining.minCoeff(&next) / before);
    choice.samples.push_back(next);
    const Eigen::VectorXd column = left.col(next) / std::sqrt(left(next, next) + noise);
    left -= column * column.transpose();
  }
  return choice;
}

} // namespace msi
