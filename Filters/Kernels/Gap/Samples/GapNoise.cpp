#include "Kernels/Gap/Samples/GapNoise.h"

#include "Kernels/Gap/Samples/TableDecisions.h"
#include "Kernels/Spectra/Interpolation.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double FineStep = 1.0; // nm

double modelVariance(const ReadingNoise& noise, double response)
{
  return noise.read * noise.read + noise.shot * noise.shot * std::fmax(response, 0.0);
}

// Weighted least squares of variance on (1, u) with coefficients >= 0; three rounds of weights.
ReadingNoise fitRepeats(const GapData& data)
{
  double read2 = 0.0;
  double shot2 = 0.0;
  double scale = 0.0;
  double degrees = 0.0;
  for (Eigen::Index i = 0; i < data.count.size(); ++i)
  {
    scale += data.scatter(i);
    degrees += std::fmax(data.count(i) - 1.0, 0.0);
  }
  read2 = scale / std::fmax(degrees, 1.0);
  for (int round = 0; round < 4; ++round)
  {
    double a11 = 0, a12 = 0, a22 = 0, b1 = 0, b2 = 0;
    for (Eigen::Index i = 0; i < data.count.size(); ++i)
    {
      const double dof = data.count(i) - 1.0;
      if (dof <= 0.0)
      {
        continue;
      }
      const double u = std::fmax(data.observed(i), 0.0);
      const double model = std::fmax(read2 + shot2 * u, 1e-14);
      const double weight = dof / (model * model);
      const double sample = data.scatter(i) / dof;
      a11 += weight;
      a12 += weight * u;
      a22 += weight * u * u;
      b1 += weight * sample;
      b2 += weight * sample * u;
    }
    const double determinant = a11 * a22 - a12 * a12;
    double constant = determinant > 1e-12 * a11 * a22 ? (a22 * b1 - a12 * b2) / determinant : -1.0;
    double slope = determinant > 1e-12 * a11 * a22 ? (a11 * b2 - a12 * b1) / determinant : -1.0;
    if (constant < 0.0 || slope < 0.0)
    {
      // On the border the better of the two one-parameter fits.
      const double onlyConstant = b1 / a11;
      const double onlySlope = a22 > 0.0 ? b2 / a22 : 0.0;
      const bool flat = b1 * b1 / a11 >= (a22 > 0.0 ? b2 * b2 / a22 : 0.0);
      constant = flat ? onlyConstant : 0.0;
      slope = flat ? 0.0 : onlySlope;
    }
    read2 = constant;
    shot2 = slope;
  }
  return { std::sqrt(std::fmax(read2, 0.0)), std::sqrt(std::fmax(shot2, 0.0)) };
}
}

NoiseFinding findNoise(const GapData& data, const std::optional<ReadingNoise>& given)
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
  double ratio = 0.0;
  for (Eigen::Index i = 0; i < data.count.size(); ++i)
  {
    if (data.count(i) > 1.0)
    {
      ratio += data.scatter(i) / std::fmax(modelVariance(*given, data.observed(i)), 1e-14);
    }
  }
  ratio /= finding.degrees;
  finding.excess = std::sqrt(ratio);
  finding.excessDeviations = (ratio - 1.0) / std::sqrt(2.0 / finding.degrees);
  if (ratio > TableDecision::ExcessVariance &&
    finding.excessDeviations > TableDecision::ExcessDeviations)
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

Eigen::MatrixXd readingVariance(const GapData& data, const ReadingNoise& noise)
{
  Eigen::MatrixXd variance(data.channels(), data.samples());
  for (Eigen::Index i = 0; i < variance.size(); ++i)
  {
    // A short series of equal rounded readings is no proof of no noise at all.
    variance(i) = modelVariance(noise, data.observed(i)) / std::fmax(data.count(i), 1.0) + 1e-12;
  }
  return variance;
}

Eigen::VectorXd reflectanceErrorGain(const CameraModel& camera)
{
  return camera.responsivity().rowwise().squaredNorm();
}

namespace
{
// Responsivity beyond the measured wavelengths, each times its distance from the end, times the slope there.
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
      const Eigen::MatrixXd& r = data.scene.reflectance();
      error += reach * (r.row(atEnd) - r.row(inside)) / (grid[atEnd] - grid[inside]);
    }
  }
  return error.array().isFinite().select(error, 0.0);
}
}

Eigen::MatrixXd integrationVariance(const GapData& data, const WavelengthGrid& measured)
{
  const WavelengthGrid& grid = data.camera.wavelengths();
  const Eigen::MatrixXd outside = beyondMeasured(data, measured);
  const auto step = grid.step();
  if (!step || *step <= 2.0 * FineStep || grid.size() < 6)
  {
    return outside.cwiseAbs2();
  }
  const double parts = std::round(*step / FineStep);
  const WavelengthGrid fine = WavelengthGrid::uniform(
    grid.front(), grid.front() + static_cast<double>(grid.size() - 1) * *step, *step / parts);
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
  const Eigen::MatrixXd curve = responsivity * ((up - straight) * r);
  const Eigen::ArrayXXd all =
    sum.array().square() + curve.array().square() + outside.array().square();
  return all.isFinite().select(all, 0.0).matrix();
}

} // namespace msi
