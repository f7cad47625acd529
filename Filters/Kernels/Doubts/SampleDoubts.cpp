#include "Kernels/Doubts/SampleDoubts.h"

#include "Kernels/Doubts/MixUps.h"
#include "Kernels/Doubts/OddOnes.h"
#include "Kernels/Doubts/PairSums.h"
#include "Kernels/Estimation/RidgeCalibration.h"
#include "Kernels/Numerics/OrderStatistic.h"
#include "Kernels/Spectra/Counted.h"
#include "Kernels/Spectra/PossibleValues.h"

#include <algorithm>
#include <cmath>
#include <set>
#include <sstream>

namespace msi
{

namespace
{
constexpr Eigen::Index FewestOfChart = 8;
constexpr Eigen::Index FewestOfMedium = 5;
constexpr double HardlyPredicted = 0.5; // of the deviation is left
constexpr double MuchLess = 0.25;       // of the squares left
constexpr double Gamma = 2.2;
constexpr double LeastDeviation = 0.005; // of a channel's, below which nobody cares
constexpr double OtherExposure = 1.25;   // times
constexpr double OverError = 4.0;        // times what the chart's camera errs by
constexpr double OtherDark = 0.035;      // of the channels' largest responses
constexpr double SaturatedOneIn = 20.0;  // samples with the largest response
constexpr double FewestSaturated = 3.0;
constexpr double Different = 0.05; // of the largest response

// The camera that answers to the samples' reflectance.
RidgeFit cameraOf(const SampleSet& samples)
{
  return fitRidge({ samples.response, samples.reflectance });
}

double median(const Eigen::VectorXd& values)
{
  return orderStatistic(values, values.size() / 2);
}

// Of each channel; 1 for one that is the same everywhere.
Eigen::ArrayXd deviations(const Eigen::MatrixXd& responses)
{
  const Eigen::ArrayXd deviation =
    (responses.colwise() - responses.rowwise().mean()).rowwise().squaredNorm().array().sqrt() /
    std::sqrt(static_cast<double>(responses.cols()));
  return (deviation > 0.0).select(deviation, 1.0);
}

double scatterOf(const Eigen::MatrixXd& responses)
{
  return std::sqrt(deviations(responses).square().mean());
}

// "a and b (2 of 16 samples)"
std::string partOf(const std::vector<std::string>& some, const NamedSamples& all)
{
  return listedFew(some) + " (" + std::to_string(some.size()) + " of " +
    counted(all.set.size(), "sample") + ")";
}

// left: what others leave of each sample, K x S.
std::string oddQuestion(
  const Eigen::MatrixXd& left, const Eigen::ArrayXd& deviation, const NamedSamples& samples)
{
  Eigen::VectorXd squares = (left.array().colwise() / deviation).square().colwise().mean();
  squares /= std::fmax(median(squares), LeastDeviation * LeastDeviation);
  std::vector<std::string> odd;
  for (const Eigen::Index i : oddOnes({ squares.begin(), squares.end() }))
  {
    odd.push_back(samples.names[static_cast<std::size_t>(i)]);
  }
  return odd.empty() ? std::string()
                     : "Odd? " + partOf(odd, samples) +
      ": far from what the others predict. Look at label, patch and readings.";
}

// Channels that are the same in every sample.
std::vector<Eigen::Index> constantChannels(const Eigen::MatrixXd& responses)
{
  std::vector<Eigen::Index> dead;
  for (Eigen::Index k = 0; responses.cols() > 1 && k < responses.rows(); ++k)
  {
    if ((responses.row(k).array() == responses(k, 0)).all())
    {
      dead.push_back(k);
    }
  }
  return dead;
}

std::string deadQuestion(const NamedSamples& samples, const std::vector<std::string>& channels)
{
  const Eigen::Index last = samples.set.size() - 1;
  if (last < 1 || samples.set.reflectance.leftCols(last) == samples.set.reflectance.rightCols(last))
  {
    return {}; // as they should be
  }
  std::ostringstream text;
  for (const Eigen::Index k : constantChannels(samples.set.response))
  {
    text << (text.tellp() > 0 ? ", " : "Dead? Channel ") << channels[static_cast<std::size_t>(k)]
         << " is " << samples.set.response(k, 0);
  }
  return text.tellp() > 0 ? text.str() + " in every sample: is it connected, and nothing before it?"
                          : std::string();
}

// Of each sample, as if its residual had the weight of all others: leverage makes it larger.
Eigen::MatrixXd standardized(const RidgeFit& camera)
{
  return camera.leftOut * (1.0 - camera.leverage.array()).sqrt().matrix().asDiagonal();
}

std::string saturationQuestion(const Eigen::MatrixXd& responses, const Eigen::MatrixXd& predicted,
  const std::vector<std::string>& channels)
{
  const double most =
    std::fmax(FewestSaturated, static_cast<double>(responses.cols()) / SaturatedOneIn);
  for (Eigen::Index k = 0; k < responses.rows(); ++k)
  {
    const double largest = responses.row(k).maxCoeff();
    double count = 0.0;
    double low = largest;
    double high = 0.0;
    for (Eigen::Index i = 0; i < responses.cols(); ++i)
    {
      if (responses(k, i) == largest)
      {
        count += 1.0;
        low = std::fmin(low, predicted(k, i));
        high = std::fmax(high, predicted(k, i));
      }
    }
    if (count >= most && high - low > Different * largest &&
      count < static_cast<double>(responses.cols()))
    {
      return "Saturated? Channel " + channels[static_cast<std::size_t>(k)] +
        " has its largest response in " + std::to_string(std::lround(count)) + " of " +
        counted(responses.cols(), "sample") + ": a shorter exposure keeps what differs.";
    }
  }
  return {};
}

// Another exposure or dark level than the camera that the chart shows.
std::string levelQuestion(
  const Eigen::MatrixXd& responses, const Eigen::MatrixXd& predicted, double leastOffset)
{
  // Gains: of the line through the origin or of the other one, whichever is nearer to 1.
  const std::vector<PairSums> channels = sumsOfChannels(responses, predicted);
  Eigen::ArrayXd gain(responses.rows());
  Eigen::ArrayXd offset(responses.rows());
  for (Eigen::Index k = 0; k < responses.rows(); ++k)
  {
    const PairSums& sums = channels[static_cast<std::size_t>(k)];
    const double slope = sums.isFlat() ? 1.0 : sums.ofBoth() / sums.ofSimulated();
    offset[k] = (sums.real - slope * sums.simulated) / sums.n;
    gain[k] = std::clamp(1.0, std::fmin(slope, sums.gain()), std::fmax(slope, sums.gain()));
  }
  const double level = median(offset.matrix());
  std::ostringstream text;
  text.precision(2);
  if (gain.maxCoeff() > OtherExposure || gain.minCoeff() < 1.0 / OtherExposure)
  {
    text << "Exposure? The responses are " << gain.minCoeff() << " to " << gain.maxCoeff()
         << " times those of the chart's camera to the same reflectance: the same exposure times, "
            "white and light?";
  }
  else if (std::fabs(level) > leastOffset && ((offset > 0.0).all() || (offset < 0.0).all()))
  {
    text << "Dark? The responses are " << std::fabs(level) << (level > 0.0 ? " above" : " below")
         << " those of the chart's camera to the same reflectance, dark or bright: was the dark "
            "image taken off, and is there no gloss?";
  }
  return text.str();
}

// Other orders of the samples, and other places where these are known: from -1 to 1.
std::vector<Arrangement> ordersOf(const NamedSamples& samples)
{
  if (samples.x.size() < 2)
  {
    return arrangementsOf(samples.set.size());
  }
  const double extent = std::fmax(
    samples.x.maxCoeff() - samples.x.minCoeff(), samples.y.maxCoeff() - samples.y.minCoeff());
  return arrangementsOf(samples.set.size(), 2.0 * samples.x / extent, 2.0 * samples.y / extent);
}

using Numbers = std::vector<double>;

Numbers numbersOf(const SampleSet& set, Eigen::Index sample)
{
  Numbers numbers(set.reflectance.col(sample).begin(), set.reflectance.col(sample).end());
  numbers.insert(numbers.end(), set.response.col(sample).begin(), set.response.col(sample).end());
  return numbers;
}

// other: whose samples are known, too.
std::string twiceQuestion(const NamedSamples& samples, const SampleSet& other)
{
  std::set<Numbers> known;
  for (Eigen::Index i = 0; i < other.size(); ++i)
  {
    known.insert(numbersOf(other, i));
  }
  std::vector<std::string> twice;
  for (Eigen::Index i = 0; i < samples.set.size(); ++i)
  {
    if (!known.insert(numbersOf(samples.set, i)).second)
    {
      twice.push_back(samples.names[static_cast<std::size_t>(i)]);
    }
  }
  return twice.empty() ? std::string()
                       : "Twice? " + partOf(twice, samples) +
      ": the same numbers as another sample, there or in the chart. Where one of both is held out "
      "the error is too small.";
}

// A chart's camera, and the responses that it predicts of each sample by all others; in another order where that fits better.
struct ChartCamera
{
  RidgeFit camera;
  Eigen::MatrixXd predicted;
  std::string mixUp;

  ChartCamera(const NamedSamples& chart, const std::vector<std::string>& channels)
    : camera(cameraOf(chart.set))
    , predicted(chart.set.response - camera.leftOut)
  {
    const std::vector<Arrangement> orders = ordersOf(chart);
    double least = camera.leaveOneOutRms;
    const double hardly = HardlyPredicted * scatterOf(chart.set.response);
    for (std::size_t n = 0; least > hardly && n < orders.size(); ++n)
    {
      const std::vector<Eigen::Index>& instead = orders[n].instead;
      const RidgeFit other =
        cameraOf({ chart.set.reflectance(Eigen::all, instead), chart.set.response });
      if (other.leaveOneOutRms < least)
      {
        least = other.leaveOneOutRms;
        predicted(Eigen::all, instead) = chart.set.response - other.leftOut;
      }
    }
    mixUp = msi::mixUp(chart.set.response, predicted, orders, channels, chart.names).question;
  }
};

// Of the squares about the mean what the camera that a chart shows leaves; each sample by all others.
double partLeft(const RidgeFit& camera, const Eigen::MatrixXd& responses)
{
  return std::pow(camera.leaveOneOutRms / scatterOf(responses), 2);
}

// The same of what is predicted of a medium, after a straight line in each channel.
double partLeft(const Eigen::MatrixXd& responses, const Eigen::MatrixXd& predicted)
{
  double together = 0.0;
  for (const PairSums& channel : sumsOfChannels(responses, predicted))
  {
    together += channel.correlation() / static_cast<double>(responses.rows());
  }
  return 1.0 - together;
}

// Responses of which much less is left once they are raised to a power. left(responses): what part of the squares; asTold: of these.
template <typename Left>
std::string curveQuestion(const Eigen::MatrixXd& responses, double asTold, const Left& left)
{
  std::ostringstream text;
  text.precision(2);
  for (const double power : { Gamma, 1.0 / Gamma })
  {
    if (left(responses.cwiseMax(0.0).array().pow(power).matrix()) < MuchLess * asTold)
    {
      text << "Curved? The responses go with the reflectance much better once raised to the power "
           << power
           << ": are they gamma-encoded, as in JPEG files? Expected are responses in "
              "proportion to the light.";
      break;
    }
  }
  return text.str();
}

// What all others leave of a medium's samples beside the chart's, from which they may differ by gains and by an offset that may go with
// the reflectance.
Eigen::MatrixXd leftBeside(
  const SampleSet& chart, const SampleSet& medium, const Eigen::MatrixXd& predicted)
{
  SampleSet both = joined(chart, medium);
  for (Eigen::Index k = 0; k < medium.channels(); ++k)
  {
    const double gain = median(medium.response.row(k)) / median(predicted.row(k));
    both.response.row(k).tail(medium.size()) /= std::isfinite(gain) && gain > 0.0 ? gain : 1.0;
  }
  both.reflectance.conservativeResize(both.bands() + 2, Eigen::NoChange);
  both.reflectance.bottomRows(2).setZero();
  both.reflectance.bottomRightCorner(2, medium.size()).row(0).setOnes();
  both.reflectance.bottomRightCorner(2, medium.size()).row(1) = medium.reflectance.colwise().mean();
  return standardized(cameraOf(both)).rightCols(medium.size());
}
}

std::vector<std::string> doubtsOf(const NamedSamples& chartInAll,
  const std::vector<std::string>& allChannels, const NamedSamples* mediumInAll)
{
  NamedSamples chart = chartInAll;
  NamedSamples medium = mediumInAll == nullptr ? NamedSamples{} : *mediumInAll;
  std::vector<std::string> questions;
  const auto ask = [&questions](const NamedSamples& samples, const std::string& question)
  {
    if (!question.empty())
    {
      questions.push_back(samples.table + ": " + question);
    }
  };
  ask(chart, deadQuestion(chart, allChannels));
  ask(medium, deadQuestion(medium, allChannels));
  ask(medium, twiceQuestion(medium, chart.set));
  // From here on without the dead channels.
  std::vector<Eigen::Index> dead = constantChannels(chart.set.response);
  const std::vector<Eigen::Index> deadOfMedium = constantChannels(medium.set.response);
  dead.insert(dead.end(), deadOfMedium.begin(), deadOfMedium.end());
  std::vector<Eigen::Index> alive;
  std::vector<std::string> channels;
  for (Eigen::Index k = 0; k < chart.set.channels(); ++k)
  {
    if (std::find(dead.begin(), dead.end(), k) == dead.end())
    {
      alive.push_back(k);
      channels.push_back(allChannels[static_cast<std::size_t>(k)]);
    }
  }
  if (alive.empty() || chart.set.size() < FewestOfChart)
  {
    return questions;
  }
  chart.set.response = chart.set.response(alive, Eigen::all).eval();
  const ChartCamera seen(chart, channels);
  const Eigen::ArrayXd deviation = deviations(chart.set.response);
  ask(chart, saturationQuestion(chart.set.response, seen.predicted, channels));
  if (!seen.mixUp.empty())
  {
    ask(chart, seen.mixUp);
    return questions;
  }
  ask(chart, oddQuestion(standardized(seen.camera), deviation, chart));
  std::string curved = curveQuestion(chart.set.response, partLeft(seen.camera, chart.set.response),
    [&chart](const Eigen::MatrixXd& raised) {
      return partLeft(cameraOf({ chart.set.reflectance, raised }), raised);
    });
  ask(chart, curved);
  if (medium.set.size() < FewestOfMedium)
  {
    return questions;
  }
  medium.set.response = medium.set.response(alive, Eigen::all).eval();
  const Eigen::MatrixXd predicted = seen.camera.fit.transform(medium.set.reflectance);
  ask(medium, saturationQuestion(medium.set.response, predicted, channels));
  const std::string mixedUp =
    mixUp(medium.set.response, predicted, ordersOf(medium), channels, medium.names).question;
  ask(medium, mixedUp);
  if (!mixedUp.empty())
  {
    return questions;
  }
  ask(medium, oddQuestion(leftBeside(chart.set, medium.set, predicted), deviation, medium));
  if (curved.empty())
  {
    curved = curveQuestion(medium.set.response, partLeft(medium.set.response, predicted),
      [&predicted](const Eigen::MatrixXd& raised) { return partLeft(raised, predicted); });
    ask(medium, curved);
  }
  if (curved.empty())
  {
    const double leastOffset = std::fmax(
      OtherDark * typicalLevel(chart.set.response), OverError * seen.camera.leaveOneOutRms);
    ask(medium, levelQuestion(medium.set.response, predicted, leastOffset));
  }
  return questions;
}

} // namespace msi
