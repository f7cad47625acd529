#include "Kernels/Gap/Samples/GapData.h"

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/SetSearch.h"
#include "Kernels/Numerics/CounterRandom.h"
#include "Kernels/Spectra/Interpolation.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <limits>
#include <numeric>
#include <tuple>
#include <utility>

namespace msi
{

namespace
{
void validate(const GapCapture& capture)
{
  const Eigen::Index channels = capture.camera.channelCount();
  if (capture.readings.rows() != channels)
  {
    reject(
      "the camera has ", channels, " channels but the readings have ", capture.readings.rows());
  }
  if (static_cast<Eigen::Index>(capture.sampleOf.size()) != capture.readings.cols())
  {
    reject("there are ", capture.readings.cols(), " readings but ", capture.sampleOf.size(),
      " sample numbers for them");
  }
  const Eigen::Index samples = capture.samples.reflectance.cols();
  for (std::size_t i = 0; i < capture.sampleOf.size(); ++i)
  {
    if (capture.sampleOf[i] < 0 || capture.sampleOf[i] >= samples)
    {
      reject("reading ", i + 1, " belongs to sample number ", capture.sampleOf[i],
        " but there are only ", samples, " samples, counted from 0");
    }
  }
  if (!capture.names.empty() && static_cast<Eigen::Index>(capture.names.size()) != samples)
  {
    reject("there are ", samples, " samples but ", capture.names.size(), " names for them");
  }
  if (capture.samples.reflectance.rows() != capture.wavelengths.size())
  {
    reject("the samples' reflectances have ", capture.samples.reflectance.rows(),
      " wavelengths, their grid ", capture.wavelengths.size());
  }
}

// Without positions that differ, or an order that does, nothing depends on them.
void dropConstantColumns(SceneSamples& samples)
{
  const auto constant = [](const Eigen::VectorXd& v)
  { return v.size() > 0 && !(v.maxCoeff() > v.minCoeff()); }; // or not a number
  if (samples.x.size() > 0 && constant(samples.x) && constant(samples.y))
  {
    samples.x.resize(0);
    samples.y.resize(0);
  }
  if (constant(samples.order))
  {
    samples.order.resize(0);
  }
}

SampleScene alignedScene(const GapCapture& capture)
{
  SceneSamples samples = capture.samples;
  const WavelengthGrid& grid = capture.camera.wavelengths();
  if (grid != capture.wavelengths)
  {
    samples.reflectance =
      (resamplingMatrix(capture.wavelengths, grid) * samples.reflectance).eval();
  }
  fillInUnknown(samples);
  dropConstantColumns(samples);
  return SampleScene(grid, std::move(samples));
}

void averageReadings(const GapCapture& capture, GapData& data)
{
  const Eigen::Index channels = data.camera.channelCount();
  const Eigen::Index samples = data.scene.size();
  data.observed = Eigen::MatrixXd::Zero(channels, samples);
  data.count = Eigen::MatrixXd::Zero(channels, samples);
  data.scatter = Eigen::MatrixXd::Zero(channels, samples);
  data.variance = Eigen::MatrixXd::Zero(channels, samples);
  data.step = Eigen::VectorXd::Zero(channels);
  for (Eigen::Index k = 0; k < channels; ++k)
  {
    std::vector<double> values(capture.readings.cols());
    const auto row = capture.readings.row(k);
    values.erase(std::copy_if(row.begin(), row.end(), values.begin(),
                   [](double v) { return std::isfinite(v); }),
      values.end());
    data.step[k] = stepBetween(std::move(values));
  }
  for (Eigen::Index j = 0; j < capture.readings.cols(); ++j)
  {
    const Eigen::Index sample = capture.sampleOf[j];
    for (Eigen::Index k = 0; k < channels; ++k)
    {
      const double value = capture.readings(k, j);
      if (std::isfinite(value))
      {
        // Welford's update.
        const double before = value - data.observed(k, sample);
        data.count(k, sample) += 1.0;
        data.observed(k, sample) += before / data.count(k, sample);
        data.scatter(k, sample) += before * (value - data.observed(k, sample));
      }
    }
  }
}

constexpr std::size_t FewestValues = 8;
constexpr double FewestSteps = 32.0; // between the extremes; fewer may be those of a chart
constexpr double OffMultiple = 0.1;  // steps; counts over white have as few as four digits
constexpr double Equal = 1e-9;       // of the range
constexpr int MostStepsApart = 4;    // of the two nearest values

// The step of which all these differences are multiples, about this large; 0 where they are not.
double commonStep(const std::vector<double>& ascending, double about)
{
  double length = 0.0;
  double steps = 0.0;
  for (const double difference : ascending)
  {
    const double step = steps > 0.0 ? length / steps : about;
    const double count = std::round(difference / step);
    if (count < 1.0 || std::fabs(difference / step - count) > OffMultiple)
    {
      return 0.0;
    }
    length += difference;
    steps += count;
  }
  return steps < FewestSteps ? 0.0 : length / steps;
}
}

double stepBetween(std::vector<double> values)
{
  std::sort(values.begin(), values.end());
  std::vector<double> differences;
  for (std::size_t i = 1; i < values.size(); ++i)
  {
    if (const double d = values[i] - values[i - 1]; d > Equal * (values.back() - values.front()))
    {
      differences.push_back(d);
    }
  }
  std::sort(differences.begin(), differences.end());
  double step = 0.0;
  for (int apart = 1;
       apart <= MostStepsApart && differences.size() + 1 >= FewestValues && !(step > 0.0); ++apart)
  {
    step = commonStep(differences, differences.front() / apart);
  }
  return step;
}

void fillInUnknown(SceneSamples& samples)
{
  if (samples.x.size() > 0 && samples.y.size() == samples.x.size())
  {
    const auto unknown = !(samples.x.array().isFinite() && samples.y.array().isFinite());
    const double none = std::numeric_limits<double>::quiet_NaN();
    samples.x = unknown.select(none, samples.x);
    samples.y = unknown.select(none, samples.y);
  }
  constexpr auto Known = Eigen::PropagateNumbers;
  const auto fill = [](Eigen::VectorXd& v, double middle)
  {
    if (v.size() > 0)
    {
      const double low = v.minCoeff<Known>();
      const double high = v.maxCoeff<Known>();
      v = v.array().isFinite().select(v, low + middle * (high - low)).eval();
    }
  };
  fill(samples.x, 0.5);
  fill(samples.y, 0.5);
  fill(samples.order, 0.0);
}

std::vector<std::string> sampleNames(const GapCapture& capture)
{
  std::vector<std::string> names = capture.names;
  for (Eigen::Index i = static_cast<Eigen::Index>(names.size());
       i < capture.samples.reflectance.cols(); ++i)
  {
    names.push_back("sample " + std::to_string(i + 1));
  }
  return names;
}

GapData prepareGapData(const GapCapture& capture, const GapOptions& options, IndexList leftOut)
{
  validate(capture);
  GapData data{ capture.camera, alignedScene(capture), sampleNames(capture), {}, {}, {}, {}, {}, {},
    {}, {}, std::move(leftOut), {}, 0 };
  averageReadings(capture, data);
  data.count.reshaped()(data.leftOut).setZero();
  data.simulated = cameraResponse(data.camera)(data.scene.reflectance());
  for (Eigen::Index j = 0; j < data.samples(); ++j)
  {
    if (!data.simulated.col(j).allFinite())
    {
      data.count.col(j).setZero();
    }
    if (data.anyMeasured(j))
    {
      data.usable.push_back(j);
    }
    data.observed.col(j) =
      (data.count.col(j).array() > 0.0).select(data.observed.col(j), data.simulated.col(j));
  }
  data.elements = data.measured().count();
  if (data.usable.size() < 2)
  {
    reject("a diagnosis needs 2 samples or more with reading and reflectance; ", data.usable.size(),
      " of ", data.samples(), " have both");
  }
  data.folds = foldsOf(data, data.usable, std::max(options.folds, 2), options.seed);
  return data;
}

Eigen::MatrixXd measuredOnly(const GapData& data, const Eigen::MatrixXd& values)
{
  return data.measured().select(values, 0.0);
}

GroupEnergies energiesOf(const GapData& data, const SampleList& samples,
  const Eigen::MatrixXd& before, const Eigen::MatrixXd& after)
{
  GroupEnergies energies(data.samples(), 3);
  energies << before.colwise().squaredNorm().transpose(), after.colwise().squaredNorm().transpose(),
    measuredOnly(data, data.variance).colwise().sum().transpose();
  return energies(samples, Eigen::all);
}

double energyBesideGain(const GapData& data, const Eigen::MatrixXd& weight, bool ofChannels)
{
  const auto sum = [&weight](const Eigen::ArrayXXd& values) -> Eigen::ArrayXd
  { return (weight.array() > 0.0).select(weight.array() * values, 0.0).rowwise().sum(); };
  const Eigen::ArrayXXd response = data.simulated;
  const Eigen::ArrayXXd gap = data.observed - data.simulated;
  return energiesBesideGain(
    sum(response.square()), sum(response * gap), sum(gap.square()), ofChannels)
    .sum();
}

void setWeights(GapData& data)
{
  const double energy = energyBesideGain(data, data.measured().cast<double>(), false) /
    static_cast<double>(data.elements);
  const double tolerance = Decision::FormPart * energy + 1e-14;
  data.weight = data.measured().cast<double>() / (data.variance.array() + tolerance);
}

SampleList samplesOutside(const GapData& data, std::size_t fold)
{
  const SampleList& inside = data.folds[fold];
  SampleList others;
  std::set_difference(data.usable.begin(), data.usable.end(), inside.begin(), inside.end(),
    std::back_inserter(others));
  return others;
}

std::vector<SampleList> foldsOf(
  const GapData& data, SampleList among, std::size_t folds, std::uint64_t seed)
{
  const CounterRandom random(seed, 71);
  const auto byKey = [](const auto& keyOf)
  { return [keyOf](Eigen::Index a, Eigen::Index b) { return keyOf(a) < keyOf(b); }; };
  const Eigen::VectorXd level = data.simulated.colwise().maxCoeff();
  std::sort(among.begin(), among.end(),
    byKey([&](Eigen::Index i) { return std::make_tuple(data.scene.medium()[i], level[i], i); }));
  std::vector<SampleList> dealt(std::min(folds, among.size()));
  // As many at a time as there are folds, one to each.
  for (auto first = among.begin(); first != among.end();)
  {
    const auto last = first + std::min<std::ptrdiff_t>(dealt.size(), among.end() - first);
    std::sort(first, last, byKey([&](Eigen::Index i) { return random.uniform(i); }));
    for (SampleList& fold : dealt)
    {
      if (first != last)
      {
        fold.push_back(*first++);
      }
    }
  }
  for (SampleList& fold : dealt)
  {
    std::sort(fold.begin(), fold.end());
  }
  return dealt;
}

} // namespace msi
