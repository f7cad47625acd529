#include "Kernels/Camera/CameraModelFit.h"

#include "Kernels/Camera/ChannelFit.h"
#include "Kernels/Numerics/CounterRandom.h"
#include "Kernels/Spectra/Counted.h"
#include "Kernels/Spectra/Reject.h"

#include <Eigen/SVD>

#include <algorithm>
#include <cmath>
#include <limits>
#include <numeric>
#include <sstream>
#include <utility>

namespace msi
{

namespace
{
constexpr double HardlyPredicted = 0.7; // of the deviation of the responses
constexpr Eigen::Index FewestSamples = 10;
constexpr double DeterminedShare =
  0.5; // of a typical row, for one standard error along a direction

enum Stream : std::uint32_t
{
  FoldStream = 1,
  DrawStream
};

void requireValid(const WavelengthGrid& wavelengths, const Eigen::MatrixXd& reflectance,
  const Eigen::MatrixXd& response, const CameraModelFitOptions& options)
{
  if (reflectance.rows() != wavelengths.size())
  {
    reject("the chart's reflectances have ", reflectance.rows(), " wavelengths, their grid ",
      wavelengths.size());
  }
  if (reflectance.cols() != response.cols())
  {
    reject(
      "the chart has ", reflectance.cols(), " reflectances but ", response.cols(), " responses");
  }
  if (response.rows() == 0)
  {
    reject("the chart's responses have no channel");
  }
  if (!wavelengths.step())
  {
    reject("a camera model is fitted on a uniform wavelength grid of two wavelengths or more; "
           "resample the reflectances");
  }
  if (options.nominal &&
    (options.nominal->channelCount() != response.rows() ||
      options.nominal->wavelengths() != wavelengths))
  {
    reject("the nominal camera has ", options.nominal->channelCount(), " channels and ",
      options.nominal->wavelengths().size(), " wavelengths, the chart ", response.rows(), " and ",
      wavelengths.size(), "; expected the same");
  }
  if (options.dark && options.dark->size() != response.rows())
  {
    reject("the chart has ", response.rows(), " channels but ", options.dark->size(),
      " dark responses are given");
  }
  if (!(options.passbandWidth > 0.0))
  {
    reject("the passband width is ", options.passbandWidth, " nm; expected above 0");
  }
  if (options.draws < 0)
  {
    reject("the number of bootstrap draws is ", options.draws, "; expected 0 or more");
  }
}

std::vector<Eigen::Index> finiteSamples(
  const Eigen::MatrixXd& reflectance, const Eigen::MatrixXd& response)
{
  std::vector<Eigen::Index> list;
  for (Eigen::Index s = 0; s < response.cols(); ++s)
  {
    if (reflectance.col(s).allFinite() && response.col(s).allFinite())
    {
      list.push_back(s);
    }
  }
  return list;
}

// Samples in a random order; sample i of it belongs to fold i mod folds.
std::vector<Eigen::Index> shuffled(Eigen::Index count, std::uint64_t seed)
{
  const CounterRandom random(seed, FoldStream);
  std::vector<Eigen::Index> order(static_cast<std::size_t>(count));
  std::iota(order.begin(), order.end(), 0);
  std::sort(order.begin(), order.end(),
    [&random](Eigen::Index a, Eigen::Index b)
    {
      return random.uniform(static_cast<std::uint64_t>(a)) <
        random.uniform(static_cast<std::uint64_t>(b));
    });
  return order;
}

std::vector<Eigen::Index> every(
  const std::vector<Eigen::Index>& order, int folds, int fold, bool inside)
{
  std::vector<Eigen::Index> list;
  for (std::size_t i = 0; i < order.size(); ++i)
  {
    if ((static_cast<int>(i % static_cast<std::size_t>(folds)) == fold) == inside)
    {
      list.push_back(order[i]);
    }
  }
  return list;
}

struct Trials
{
  std::vector<CameraModelFitTrial> list;
  std::size_t chosen = 0;
};

// Held-out squared error per trial and sample, mean over the channels; slope: K x S, factors of the residuals.
Eigen::MatrixXd heldOutErrors(const ChannelFitProblem& problem,
  const std::vector<PenaltyWeights>& weights, const CameraModelFitOptions& options,
  const Eigen::MatrixXd* slope = nullptr)
{
  const auto trials = static_cast<Eigen::Index>(weights.size());
  Eigen::MatrixXd errors(trials, problem.samples());
  const std::vector<Eigen::Index> order = shuffled(problem.samples(), options.seed);
  for (int fold = 0; fold < options.folds; ++fold)
  {
    const ChannelMoments moments = problem.moments(every(order, options.folds, fold, false));
    const Eigen::VectorXd centers = problem.centers(moments);
    const std::vector<Eigen::Index> heldOut = every(order, options.folds, fold, true);
    for (Eigen::Index t = 0; t < trials; ++t)
    {
      const FittedRows rows = problem.solve(moments, centers, weights[static_cast<std::size_t>(t)]);
      for (const Eigen::Index s : heldOut)
      {
        Eigen::VectorXd residual = problem.residual(rows, s);
        if (slope != nullptr)
        {
          residual.array() *= slope->col(s).array();
        }
        errors(t, s) = residual.squaredNorm() / static_cast<double>(rows.responsivity.rows());
      }
    }
  }
  return errors;
}

Trials tryWeights(const ChannelFitProblem& problem, const ChannelMoments& all,
  const Eigen::VectorXd& centers, const CameraModelFitOptions& options)
{
  const std::vector<PenaltyWeights> weights = problem.candidates();
  const Eigen::MatrixXd errors = heldOutErrors(problem, weights, options);
  const Eigen::VectorXd mean = errors.rowwise().mean();
  Eigen::Index best = 0;
  mean.minCoeff(&best);
  const auto count = static_cast<double>(errors.cols());
  const double bound = mean[best] +
    std::sqrt((errors.row(best).array() - mean[best]).square().sum() / (count - 1.0) / count);
  Trials trials;
  double fewest = std::numeric_limits<double>::infinity();
  for (std::size_t t = 0; t < weights.size(); ++t)
  {
    const double error = mean[static_cast<Eigen::Index>(t)];
    const double freedom = problem.solve(all, centers, weights[t]).freedom;
    trials.list.push_back(
      { weights[t].locality, weights[t].smoothness, std::sqrt(error), freedom });
    if (error <= bound && freedom < fewest)
    {
      fewest = freedom;
      trials.chosen = t;
    }
  }
  return trials;
}

constexpr double LargestSquare = 0.4;
constexpr double LargestRelativeResponse = 2.0;
constexpr int CurveSteps = 14; // of a golden section: 0.8 / 1.618^14 = 0.001

// u of y = (1 - square) u + square u^2.
Eigen::MatrixXd straightened(const Eigen::MatrixXd& response, double square)
{
  const double linear = 1.0 - square;
  return 2.0 * response.array() /
    (linear + (linear * linear + 4.0 * square * response.array()).max(0.0).sqrt());
}

std::optional<DetectorCurve> findCurve(const WavelengthGrid& wavelengths,
  const Eigen::MatrixXd& reflectance, const Eigen::MatrixXd& response,
  const PenaltyWeights& weights, const CameraModelFitOptions& options)
{
  if (response.cwiseAbs().maxCoeff() > LargestRelativeResponse)
  {
    return std::nullopt;
  }
  const auto errorsWith = [&](double square) -> Eigen::VectorXd
  {
    const Eigen::MatrixXd linear = straightened(response, square);
    const Eigen::MatrixXd slope = (1.0 - square) + 2.0 * square * linear.array();
    const ChannelFitProblem problem(wavelengths, reflectance, linear, options);
    return heldOutErrors(problem, { weights }, options, &slope).row(0);
  };
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double low = -LargestSquare;
  double high = LargestSquare;
  double left = high - golden * (high - low);
  double right = low + golden * (high - low);
  double ofLeft = errorsWith(left).mean();
  double ofRight = errorsWith(right).mean();
  for (int step = 0; step < CurveSteps; ++step)
  {
    if (ofLeft < ofRight)
    {
      high = right;
      right = left;
      ofRight = ofLeft;
      left = high - golden * (high - low);
      ofLeft = errorsWith(left).mean();
    }
    else
    {
      low = left;
      left = right;
      ofLeft = ofRight;
      right = low + golden * (high - low);
      ofRight = errorsWith(right).mean();
    }
  }
  DetectorCurve curve;
  curve.square = 0.5 * (low + high);
  const Eigen::VectorXd errors = errorsWith(curve.square);
  curve.heldOutRms = std::sqrt(errors.mean());
  const Eigen::ArrayXd gain = errorsWith(0.0) - errors;
  const auto count = static_cast<double>(gain.size());
  const double deviation = std::sqrt((gain - gain.mean()).square().sum() / (count - 1.0) / count);
  curve.deviations = deviation > 0.0 ? gain.mean() / deviation : 0.0;
  return curve;
}

PenaltyWeights weightsOf(const CameraModelFit& fit)
{
  return { fit.chosen.locality, fit.chosen.smoothness };
}

struct LinearFit
{
  CameraModelFit fit; // without uncertainty and determination
  bool converged;
};

LinearFit fitLinear(const WavelengthGrid& wavelengths, const Eigen::MatrixXd& reflectance,
  const Eigen::MatrixXd& response, const CameraModelFitOptions& options)
{
  const ChannelFitProblem problem(wavelengths, reflectance, response, options);
  std::vector<Eigen::Index> everySample(static_cast<std::size_t>(response.cols()));
  std::iota(everySample.begin(), everySample.end(), 0);
  const ChannelMoments moments = problem.moments(everySample);
  const Eigen::VectorXd centers = problem.centers(moments);
  const Trials trials = tryWeights(problem, moments, centers, options);
  const CameraModelFitTrial chosen = trials.list[trials.chosen];
  FittedRows rows = problem.solve(moments, centers, { chosen.locality, chosen.smoothness });

  CameraModelFit fit{ CameraModel(
    wavelengths, std::move(rows.responsivity), std::move(rows.dark), options.channels) };
  Eigen::MatrixXd residual = response - fit.camera.responsivity() * reflectance;
  residual.colwise() -= fit.camera.dark();
  const auto samples = static_cast<double>(response.cols());
  fit.channelRms = residual.rowwise().squaredNorm().cwiseSqrt() / std::sqrt(samples);
  fit.heldOutRms = chosen.heldOutRms;
  fit.trials = trials.list;
  fit.chosen = chosen;
  fit.summary.residualRms = std::sqrt(residual.squaredNorm() / double(residual.size()));
  fit.summary.unknowns = response.rows() * (wavelengths.size() + (options.dark ? 0 : 1));
  fit.summary.samples = response.cols();
  fit.summary.iterations = rows.steps;
  return { std::move(fit), rows.converged };
}

// Bootstrap over samples: means of products of (row, dark), channel by channel.
void addUncertainty(
  CameraModelFit& fit, const ChannelFitProblem& problem, const CameraModelFitOptions& options)
{
  const PenaltyWeights weights = weightsOf(fit);
  const Eigen::Index channels = fit.camera.channelCount();
  const Eigen::Index bands = fit.camera.wavelengths().size();
  const auto samples = static_cast<std::uint64_t>(problem.samples());
  const CounterRandom random(options.seed, DrawStream);
  std::vector<Eigen::MatrixXd> drawn(
    static_cast<std::size_t>(channels), Eigen::MatrixXd(bands + 1, options.draws));
  std::vector<Eigen::Index> list(static_cast<std::size_t>(samples));
  for (int draw = 0; draw < options.draws; ++draw)
  {
    for (std::uint64_t i = 0; i < samples; ++i)
    {
      const double place = random.uniform(static_cast<std::uint64_t>(draw) * samples + i);
      list[i] = static_cast<Eigen::Index>(place * static_cast<double>(samples));
    }
    const ChannelMoments moments = problem.moments(list);
    const FittedRows rows = problem.solve(moments, problem.centers(moments), weights);
    for (Eigen::Index k = 0; k < channels; ++k)
    {
      drawn[static_cast<std::size_t>(k)].col(draw) << rows.responsivity.row(k).transpose(),
        rows.dark[k];
    }
  }
  fit.responsivityError.resize(channels, bands);
  fit.darkError.resize(channels);
  for (Eigen::Index k = 0; k < channels; ++k)
  {
    Eigen::MatrixXd& each = drawn[static_cast<std::size_t>(k)];
    each.colwise() -= each.rowwise().mean().eval();
    const Eigen::MatrixXd covariance = each * each.transpose() / std::max(1, options.draws - 1);
    fit.responsivityError.row(k) = covariance.diagonal().head(bands).cwiseSqrt().transpose();
    fit.darkError[k] = std::sqrt(covariance(bands, bands));
    fit.covariance.push_back(covariance);
  }
}

// Which directions of M the chart shows (see CameraModelFit::determined).
void addDetermination(CameraModelFit& fit, const Eigen::MatrixXd& reflectance)
{
  const Eigen::MatrixXd centered =
    (reflectance.colwise() - reflectance.rowwise().mean()).transpose();
  const Eigen::JacobiSVD<Eigen::MatrixXd> svd(centered, Eigen::ComputeFullV);
  Eigen::VectorXd norms = fit.camera.responsivity().rowwise().norm();
  std::sort(norms.begin(), norms.end());
  const double typical = norms[norms.size() / 2];
  const Eigen::VectorXd& singular = svd.singularValues();
  Eigen::Index determined = 0;
  while (determined < singular.size() &&
    fit.summary.residualRms < DeterminedShare * typical * singular[determined])
  {
    ++determined;
  }
  fit.determined = determined;
  fit.undetermined = svd.matrixV().rightCols(svd.matrixV().cols() - determined);
  // The diagonal of the projection onto the determined directions.
  const Eigen::VectorXd seen = svd.matrixV().leftCols(determined).rowwise().squaredNorm();
  fit.resolution = (*fit.camera.wavelengths().step() * seen.cwiseInverse().array())
                     .min(fit.camera.wavelengths().back() - fit.camera.wavelengths().front());
  fit.summary.rank = determined;
  fit.summary.condition = determined > 0 ? singular[0] / singular[determined - 1] : 0.0;
}

std::string statusOf(const CameraModelFit& fit, double deviation, bool nominal,
  Eigen::Index leftOut, bool converged, bool straight)
{
  const Eigen::Index bands = fit.camera.wavelengths().size();
  const double range = fit.camera.wavelengths().back() - fit.camera.wavelengths().front();
  std::ostringstream status;
  if (fit.heldOutRms > HardlyPredicted * deviation)
  {
    status << "samples left out are hardly predicted better than by the mean response (rms "
           << fit.heldOutRms << " instead of " << deviation
           << "): do the responses belong to these samples?; ";
  }
  if (fit.determined < bands)
  {
    status << "the chart determines " << fit.determined << " of " << bands
           << " directions of the responsivity; the other "
           << (bands - fit.determined == 1 ? "one rests"
                                           : std::to_string(bands - fit.determined) + " rest")
           << " on the assumptions that it is not negative, "
           << (nominal ? "close to the nominal one" : "confined to a passband") << " and smooth";
    if (fit.determined > 1)
    {
      status << "; detail finer than about "
             << std::lround(range / static_cast<double>(fit.determined - 1))
             << " nm is not in the data";
    }
  }
  else
  {
    status << "the chart determines the responsivity at every wavelength";
  }
  if (leftOut > 0)
  {
    status << "; " << counted(leftOut, "sample") << " with values that are not finite "
           << (leftOut == 1 ? "was" : "were") << " left out";
  }
  if (fit.curve && fit.curve->found())
  {
    const DetectorCurve& curve = *fit.curve;
    status << "; the responses are curved, (1 - s) u + s u^2 with s = " << curve.square << ": ";
    if (straight)
    {
      status << "that curve was taken out of them";
    }
    else
    {
      status << "without the curve the error on samples left out is " << curve.heldOutRms
             << " instead of " << fit.heldOutRms
             << "; linearise the responses or turn Detector Curve on";
    }
  }
  if (!converged)
  {
    status << "; the solver ran out of steps";
  }
  return status.str();
}
}

double CameraModelFit::predictionError(
  Eigen::Index channel, const Eigen::VectorXd& reflectance) const
{
  if (covariance.empty())
  {
    return std::numeric_limits<double>::quiet_NaN();
  }
  Eigen::VectorXd extended(reflectance.size() + 1);
  extended << reflectance, 1.0;
  return std::sqrt(extended.dot(covariance[static_cast<std::size_t>(channel)] * extended));
}

CameraModelFit fitCameraModel(const WavelengthGrid& wavelengths,
  const Eigen::MatrixXd& allReflectance, const Eigen::MatrixXd& allResponse,
  const CameraModelFitOptions& options)
{
  requireValid(wavelengths, allReflectance, allResponse, options);
  const std::vector<Eigen::Index> finite = finiteSamples(allReflectance, allResponse);
  const auto samples = static_cast<Eigen::Index>(finite.size());
  if (samples < FewestSamples)
  {
    reject("the chart has ", samples, " samples with finite values; a camera model needs ",
      FewestSamples, " or more");
  }
  if (options.folds < 2 || options.folds > samples)
  {
    reject("the cross-validation has ", options.folds, " folds; expected 2 to ", samples);
  }
  const Eigen::MatrixXd reflectance = allReflectance(Eigen::all, finite);
  Eigen::MatrixXd response = allResponse(Eigen::all, finite);

  LinearFit linear = fitLinear(wavelengths, reflectance, response, options);
  const std::optional<DetectorCurve> curve =
    findCurve(wavelengths, reflectance, response, weightsOf(linear.fit), options);
  const bool straight = options.detectorCurve && curve && curve->found();
  if (straight)
  {
    response = straightened(response, curve->square);
    linear = fitLinear(wavelengths, reflectance, response, options);
  }
  CameraModelFit fit = std::move(linear.fit);
  fit.curve = curve;
  if (options.draws > 0)
  {
    addUncertainty(fit, ChannelFitProblem(wavelengths, reflectance, response, options), options);
  }
  addDetermination(fit, reflectance);
  fit.summary.complete = fit.determined == wavelengths.size() && linear.converged;
  const Eigen::MatrixXd aboutMean = response.colwise() - response.rowwise().mean();
  const double deviation =
    std::sqrt(aboutMean.squaredNorm() / static_cast<double>(response.size()));
  fit.summary.status = statusOf(fit, deviation, options.nominal.has_value(),
    allResponse.cols() - samples, linear.converged, straight);
  return fit;
}

} // namespace msi
