#include "Kernels/Gap/Samples/GapNoise.h"

#include "Kernels/Doubts/OddOnes.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Samples/GapEvidence.h"
#include "Kernels/Numerics/Angle.h"
#include "Kernels/Numerics/OrderStatistic.h"
#include "Kernels/Spectra/Interpolation.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <cstddef>
#include <limits>

namespace msi
{

namespace
{
constexpr double FineStep = 1.0;           // nm
constexpr double MedianOfNormal = 0.67449; // of the sizes of standard normal values
constexpr int Harmonics = 10;

// Of one reading of each element, K x S.
struct ReadingVariances
{
  Eigen::ArrayXXd within; // between its repeats
  Eigen::ArrayXXd common; // of the error by rounding that they share

  ReadingVariances(const GapData& data, const CameraNoise& noise)
  {
    const Eigen::ArrayXXd step = data.step.replicate(1, data.samples());
    const Eigen::ArrayXXd variance = data.observed.array().unaryExpr(
      [&noise](double response) { return noiseVariance(noise, response); });
    common = variance.binaryExpr(step, &sharedRounding);
    within = variance + step.square() / 12.0 - common;
  }
};

// Variances of the repeats are as uncertain as they are large: four rounds of weights.
CameraNoise fitRepeats(const GapData& data)
{
  const Eigen::ArrayXXd degrees = (data.count.array() - 1.0).max(0.0);
  const Eigen::ArrayXXd variance =
    (data.scatter.array() / degrees.max(1.0)).colwise() - data.step.array().square() / 12.0;
  const Eigen::ArrayXXd response = (degrees > 0.0).select(data.observed.array(), 0.0);
  CameraNoise noise{ std::sqrt(data.scatter.sum() / std::fmax(degrees.sum(), 1.0)) };
  for (int round = 0; round < 4; ++round)
  {
    const Eigen::ArrayXXd weight =
      degrees / ReadingVariances(data, noise).within.max(1e-14).square();
    noise = fittedNoise(response.reshaped(), variance.reshaped(), weight.reshaped());
  }
  return noise;
}

// Of one channel of a sample: the one that is farthest from the median of all and of what is simulated.
void leaveOutFarthest(GapCapture& capture, const GapData& data, const OddReading& odd)
{
  std::vector<double> values{ data.simulated(odd.channel, odd.sample) };
  std::vector<double*> readings;
  for (std::size_t r = 0; r < capture.sampleOf.size(); ++r)
  {
    double& reading = capture.readings(odd.channel, r);
    if (capture.sampleOf[r] == odd.sample && std::isfinite(reading))
    {
      values.push_back(reading);
      readings.push_back(&reading);
    }
  }
  const double median = orderStatistic(values, values.size() / 2);
  **std::max_element(readings.begin(), readings.end(),
    [median](const double* a, const double* b) {
      return std::fabs(*a - median) < std::fabs(*b - median);
    }) = std::numeric_limits<double>::quiet_NaN();
}

// Responsivity beyond the measured wavelengths, each times its distance from the end, times the slope there. Of the value at an end
// of the grid half lies beyond the end, half a step away: a passband that is cut off there.
Eigen::MatrixXd beyondMeasured(const GapData& data, const WavelengthGrid& measured)
{
  const WavelengthGrid& grid = data.camera.wavelengths();
  Eigen::MatrixXd error = Eigen::MatrixXd::Zero(data.channels(), data.samples());
  for (const bool upper : { false, true })
  {
    const double end = upper ? measured.back() : measured.front();
    const double span = 20.0 * (upper ? -1.0 : 1.0);
    Eigen::VectorXd reach = Eigen::VectorXd::Zero(data.channels());
    Eigen::Index atEnd = 0;
    Eigen::Index inside = 0;
    for (Eigen::Index j = 0; j < grid.size(); ++j)
    {
      if (upper ? grid[j] > end : grid[j] < end)
      {
        reach += data.camera.responsivity().col(j) * (grid[j] - end);
      }
      atEnd = std::fabs(grid[j] - end) < std::fabs(grid[atEnd] - end) ? j : atEnd;
      inside = std::fabs(grid[j] - end - span) < std::fabs(grid[inside] - end - span) ? j : inside;
    }
    if (inside != atEnd)
    {
      if (atEnd == 0 || atEnd == grid.size() - 1)
      {
        const double step =
          (grid[atEnd] - grid[inside]) / std::fabs(static_cast<double>(atEnd - inside));
        reach += 0.5 * data.camera.responsivity().col(atEnd) * (0.5 * step);
      }
      const Eigen::MatrixXd& r = data.scene.reflectance();
      error += reach * (r.row(atEnd) - r.row(inside)) / (grid[atEnd] - grid[inside]);
    }
  }
  return error;
}

// Where the grid cuts off a passband the sum counts half a step too much of it.
Eigen::MatrixXd cutOff(const GapData& data)
{
  const Eigen::MatrixXd& responsivity = data.camera.responsivity();
  const Eigen::MatrixXd& r = data.scene.reflectance();
  const Eigen::ArrayXd white = data.camera.whiteResponse();
  const Eigen::MatrixXd mean = white.inverse().matrix().asDiagonal() * (responsivity * r);
  Eigen::MatrixXd error = Eigen::MatrixXd::Zero(data.channels(), data.samples());
  for (const Eigen::Index end : { Eigen::Index(0), r.rows() - 1 })
  {
    error += (0.5 * responsivity.col(end)).asDiagonal() *
      (r.row(end).replicate(data.channels(), 1) - mean);
  }
  return error;
}

// Of what neighbouring channels show, in the samples that have all three: smooth errors cancel, noise does not.
struct SecondDifferences
{
  std::vector<double> values;
  double allowed = 0.0; // sum of their variances by data.variance

  SecondDifferences(const GapData& data, const Eigen::MatrixXd& residual, Eigen::Index middle)
  {
    for (Eigen::Index i = 0; i < data.samples(); ++i)
    {
      if (data.count.col(i).segment(middle - 1, 3).minCoeff() > 0.0)
      {
        const auto three = residual.col(i).segment(middle - 1, 3);
        const auto variance = data.variance.col(i).segment(middle - 1, 3);
        values.push_back(three[0] - 2.0 * three[1] + three[2]);
        allowed += variance[0] + 4.0 * variance[1] + variance[2];
      }
    }
  }
};

constexpr double LeastFactor = 1.25;
constexpr double LargestFactor = 20.0;
constexpr double FarMoreLikely = 10.0; // natural logarithm of the likelihood ratio
constexpr double LeastScatter = 1e-5;
constexpr std::size_t FewestDifferences = 8;
constexpr double Together = 0.15; // correlation of neighbouring channels

// Where a function with one hill between ln(low) and ln(high) is highest: golden section.
template <typename Function>
double highest(double low, double high, const Function& function)
{
  const double golden = 0.5 * (std::sqrt(5.0) - 1.0);
  double a = std::log(low);
  double b = std::log(high);
  for (int step = 0; step < 30; ++step)
  {
    const double left = b - golden * (b - a);
    const double right = a + golden * (b - a);
    const bool rises = function(std::exp(left)) < function(std::exp(right));
    (rises ? a : b) = rises ? left : right;
  }
  return std::exp(0.5 * (a + b));
}

// Normal residuals whose covariance, sample by sample, is diagonal plus `common`.
double logLikelihood(const GapData& data, const Eigen::MatrixXd& residual,
  const Eigen::ArrayXXd& variance, const Eigen::MatrixXd& common)
{
  double sum = 0.0;
  for (const Eigen::Index j : data.usable)
  {
    const auto measured = data.count.col(j).array() > 0.0;
    Eigen::MatrixXd covariance = common;
    covariance.diagonal().array() += variance.col(j);
    const Eigen::VectorXd there = measured.cast<double>();
    covariance.array() *= (there * there.transpose()).array();
    covariance.diagonal() += Eigen::VectorXd::Ones(there.size()) - there;
    const Eigen::LLT<Eigen::MatrixXd> root(covariance);
    const Eigen::VectorXd e = measured.select(residual.col(j), 0.0);
    sum -=
      root.matrixL().toDenseMatrix().diagonal().array().log().sum() + 0.5 * e.dot(root.solve(e));
  }
  return sum;
}
}

double sharedRounding(double variance, double step)
{
  double sum = 0.0;
  for (int n = 1; n <= Harmonics && step > 0.0; ++n)
  {
    const double cycle = TwoPi * n / step;
    sum += 2.0 / (cycle * cycle) * std::exp(-cycle * cycle * variance);
  }
  return sum;
}

NoiseFinding findNoise(const GapData& data, const std::optional<CameraNoise>& given)
{
  NoiseFinding finding;
  finding.degrees = (data.count.array() - 1.0).cwiseMax(0.0).sum();
  const bool repeats = finding.degrees >= 4.0;
  if (!given)
  {
    finding.unknown = !repeats;
    finding.fromRepeats = repeats;
    if (repeats)
    {
      finding.reading = fitRepeats(data);
    }
    return finding;
  }
  finding.reading = *given;
  if (!repeats)
  {
    return finding;
  }
  const double ratio =
    (data.count.array() > 1.0)
      .select(data.scatter.array() / ReadingVariances(data, *given).within.max(1e-14), 0.0)
      .sum() /
    finding.degrees;
  finding.excess = finding.shown = std::sqrt(ratio);
  finding.excessDeviations = (ratio - 1.0) / std::sqrt(2.0 / finding.degrees);
  if (finding.excess > Decision::BeyondNoise && finding.excessDeviations > Decision::SureDeviations)
  {
    finding.fromRepeats = true;
    finding.reading = fitRepeats(data);
  }
  else
  {
    finding.excess = 1.0;
  }
  return finding;
}

std::vector<OddReading> leaveOutOddReadings(GapCapture& capture, const GapOptions& options)
{
  std::vector<OddReading> all;
  for (;;)
  {
    const GapData data = prepareGapData(capture, options);
    const ReadingVariances expected(data, findNoise(data, capture.noise).reading);
    std::vector<OddReading> repeated;
    std::vector<double> scatter;
    for (const Eigen::Index i : data.usable)
    {
      for (Eigen::Index k = 0; k < data.channels(); ++k)
      {
        if (data.count(k, i) > 1.0)
        {
          // One step from one rounded reading to another is never odd.
          const double usual = std::fmax(expected.within(k, i), 0.5 * data.step[k] * data.step[k]);
          repeated.push_back({ k, i });
          scatter.push_back(
            data.scatter(k, i) / ((data.count(k, i) - 1.0) * std::fmax(usual, 1e-14)));
        }
      }
    }
    const IndexList odd = oddOnes(scatter, all.size());
    if (odd.empty())
    {
      return all;
    }
    for (const Eigen::Index n : odd)
    {
      all.push_back(repeated[n]);
      leaveOutFarthest(capture, data, all.back());
    }
  }
}

Eigen::MatrixXd readingVariance(const GapData& data, const CameraNoise& noise)
{
  const ReadingVariances one(data, noise);
  // A short series of equal rounded readings is no proof of no noise at all.
  return (one.within / data.count.array().max(1.0) + one.common + 1e-12).matrix();
}

Eigen::VectorXd reflectanceErrorGain(const CameraModel& camera)
{
  return camera.responsivity().rowwise().squaredNorm();
}

ChannelMask fittedChannels(const CameraModel& camera)
{
  return camera.responsivity().cwiseAbs().rowwise().sum().array() >
    (1.0 + Decision::SmallPart) * camera.whiteResponse().array().abs();
}

Eigen::MatrixXd integrationVariance(const GapData& data, const WavelengthGrid& measured)
{
  const WavelengthGrid& grid = data.camera.wavelengths();
  const Eigen::VectorXd notFitted = (!fittedChannels(data.camera)).cast<double>();
  const Eigen::MatrixXd ofEnds =
    beyondMeasured(data, measured).cwiseAbs2() + notFitted.asDiagonal() * cutOff(data).cwiseAbs2();
  const auto known = [](const Eigen::ArrayXXd& all) -> Eigen::MatrixXd
  { return all.isFinite().select(all, 0.0); };
  const auto step = grid.step();
  if (!step || *step <= 2.0 * FineStep || grid.size() < 6)
  {
    return known(ofEnds);
  }
  const double parts = std::round(*step / FineStep);
  // Each value stands for the step around it, at the ends, too.
  const double half = 0.5 * (*step - *step / parts);
  const WavelengthGrid fine = WavelengthGrid::uniform(grid.front() - half,
    grid.front() + static_cast<double>(grid.size() - 1) * *step + half, *step / parts);
  const Eigen::MatrixXd up = resamplingMatrix(grid, fine, InterpolationMethod::CubicLagrange);
  Eigen::MatrixXd responsivity = data.camera.responsivity() * up.transpose();
  const Eigen::ArrayXd white = data.camera.whiteResponse().array();
  const Eigen::ArrayXd area = responsivity.rowwise().sum().array();
  for (Eigen::Index k = 0; k < responsivity.rows(); ++k)
  {
    responsivity.row(k) *= std::fabs(area[k]) > 0.0 ? white[k] / area[k] : 0.0;
  }
  const Eigen::MatrixXd& r = data.scene.reflectance();
  const Eigen::MatrixXd straight = resamplingMatrix(grid, fine, InterpolationMethod::Linear);
  const Eigen::MatrixXd sum = responsivity * (up * r) - data.camera.responsivity() * r;
  const Eigen::MatrixXd bent = (up - straight) * r;
  // A mean over wavelengths is off by no more than the largest difference.
  const Eigen::MatrixXd most = white.abs().matrix() * bent.cwiseAbs().colwise().maxCoeff();
  const Eigen::MatrixXd curve = (responsivity * bent).cwiseAbs().cwiseMin(most);
  return known(notFitted.asDiagonal() * sum.cwiseAbs2() + curve.cwiseAbs2() + ofEnds);
}

double robustDeviation(std::vector<double> values)
{
  std::transform(
    values.begin(), values.end(), values.begin(), [](double v) { return std::fabs(v); });
  return orderStatistic(values, values.size() / 2) / MedianOfNormal;
}

Eigen::MatrixXd unknownVariance(const GapData& data, const Eigen::MatrixXd& left)
{
  const auto measured = data.measured();
  const Eigen::MatrixXd residual = shareOverAxes(data, left).heldOutResidual;
  Eigen::VectorXd variance = Eigen::VectorXd::Zero(data.channels());
  for (Eigen::Index k = 0; k < data.channels(); ++k)
  {
    std::vector<double> values;
    for (Eigen::Index i = 0; i < data.samples(); ++i)
    {
      if (measured(k, i))
      {
        values.push_back(residual(k, i));
      }
    }
    std::vector<double> differences;
    if (data.channels() > 2)
    {
      const Eigen::Index middle = std::clamp<Eigen::Index>(k, 1, data.channels() - 2);
      differences = SecondDifferences(data, residual, middle).values;
    }
    variance[k] = values.empty() ? 0.0 : std::pow(robustDeviation(values), 2);
    if (!differences.empty())
    {
      // Of noise, six times its variance.
      variance[k] = std::fmin(
        variance[k], std::pow(robustDeviation(differences), 2) / 6.0 + std::pow(SampleScatter, 2));
    }
  }
  return (variance.array() + 1e-12).matrix().replicate(1, data.samples());
}

double reflectanceScatter(const GapData& data, const Eigen::MatrixXd& residual, double unpredicted)
{
  const auto measured = data.measured();
  const Eigen::VectorXd gain = reflectanceErrorGain(data.camera);
  const double noise = measured.select(data.variance.array(), 0.0).sum();
  const double perUnit = measured.select(gain.replicate(1, data.samples()).array(), 0.0).sum();
  double variance = std::fmax(unpredicted - noise, 0.0) / perUnit;
  double excess = 0.0;
  double through = 0.0;
  for (Eigen::Index k = 1; k + 1 < data.channels(); ++k)
  {
    const SecondDifferences differences(data, residual, k);
    if (differences.values.size() >= FewestDifferences)
    {
      excess += std::pow(robustDeviation(differences.values), 2) -
        differences.allowed / static_cast<double>(differences.values.size());
      const auto& m = data.camera.responsivity();
      through += (m.row(k - 1) - 2.0 * m.row(k) + m.row(k + 1)).squaredNorm();
    }
  }
  if (through > 0.0)
  {
    variance = std::fmin(variance, std::fmax(excess, 0.0) / through);
  }
  return std::fmin(std::sqrt(variance), LargestReflectanceNoise);
}

double excessScatter(const GapData& data, const Eigen::MatrixXd& residual,
  const Eigen::MatrixXd& noise, const Eigen::MatrixXd& integration)
{
  const auto measured = data.measured();
  const Eigen::MatrixXd& m = data.camera.responsivity();
  const Eigen::MatrixXd through = m * m.transpose();
  const auto noisy = [&](double factor) -> Eigen::ArrayXXd
  { return factor * factor * noise.array() + integration.array(); };
  const auto asNoise = [&](double factor)
  {
    const Eigen::ArrayXXd variance = noisy(factor);
    return -0.5 * measured.select(variance.log() + residual.array().square() / variance, 0.0).sum();
  };
  const auto asReflectance = [&](double scatter)
  { return logLikelihood(data, residual, noisy(1.0), scatter * scatter * through); };
  const double factor = highest(1.0, LargestFactor, asNoise);
  if (factor < LeastFactor ||
    asNoise(factor) <
      asReflectance(highest(LeastScatter, LargestReflectanceNoise, asReflectance)) + FarMoreLikely)
  {
    return 1.0;
  }
  const Eigen::ArrayXXd whitened = measured.select(residual.array() / noisy(factor).sqrt(), 0.0);
  const Eigen::Index pairs = data.channels() - 1;
  const double products = (whitened.topRows(pairs) * whitened.bottomRows(pairs)).sum();
  const double size = whitened.square().sum() / static_cast<double>(data.elements);
  const double correlation =
    products / (size * static_cast<double>(std::max<Eigen::Index>(pairs, 1) * data.samples()));
  return std::fabs(correlation) < Together ? factor : 1.0;
}

} // namespace msi
