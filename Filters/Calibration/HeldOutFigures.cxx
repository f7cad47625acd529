#include "HeldOutFigures.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include "Kernels/Difference/ErrorSummary.h"

#include <cmath>
#include <utility>

namespace msi
{

namespace
{
// Shares of values, and the normal deviates within which they lie.
const std::pair<const char*, double> Intervals[msi::IntervalCount] = {
  { "coverage90", 1.6448536269514722 }, { "coverage95", 1.959963984540054 }
};

// Every value is zero on all ranks but one.
void sumValues(std::vector<double>& values, vtkMultiProcessController* controller)
{
  if (!controller)
  {
    return;
  }
  std::vector<double> all(values.size());
  controller->AllReduce(
    values.data(), all.data(), static_cast<vtkIdType>(values.size()), vtkCommunicator::SUM_OP);
  values = std::move(all);
}

Figures figuresOf(const Eigen::VectorXd& errors)
{
  const auto summary = summarize(errors);
  return { summary.mean, summary.median, summary.p95, summary.max };
}
}

HeldOutJudge::HeldOutJudge(const WavelengthGrid& bands, const std::vector<std::string>& illuminants,
  const ViewingConditions& conditions, const std::string& difference, const Eigen::MatrixXd& target)
  : Target(target)
  , Difference(ColorDifference::named(difference))
  , Metrics(errorNames(illuminants, { Difference.metric() }))
{
  for (const auto& name : illuminants)
  {
    const TristimulusTransform tristimulus(
      bands, conditions.illuminant(name), conditions.observer());
    Eigen::Matrix3Xd lab = tristimulus(target);
    const CIELAB space(tristimulus.whitePoint());
    space.fromXYZ(lab, lab);
    Colors.push_back({ tristimulus, space, std::move(lab) });
  }
  for (const auto& interval : Intervals)
  {
    Metrics.push_back({ interval.first, "" });
  }
}

HeldOutErrors HeldOutJudge::operator()(
  const MethodEstimate& estimate, const std::vector<Eigen::Index>& heldOut) const
{
  HeldOutErrors errors{ { figuresOf(estimate.rms) }, { estimate.rms } };
  for (const auto& color : Colors)
  {
    Eigen::Matrix3Xd lab = color.tristimulus(estimate.reflectance);
    color.space.fromXYZ(lab, lab);
    Eigen::VectorXd difference(lab.cols());
    const Eigen::Matrix3Xd reference = color.targetLab(Eigen::all, heldOut);
    Difference.apply(reference, lab, difference);
    errors.figures.push_back(figuresOf(difference));
    errors.samples.push_back(std::move(difference));
  }
  for (const auto& interval : Intervals)
  {
    Figures coverage;
    coverage.fill(std::nan(""));
    if (estimate.standardDeviation.size() > 0)
    {
      const Eigen::ArrayXXd error =
        (estimate.reflectance - Target(Eigen::all, heldOut)).array().abs();
      const auto within = error <= interval.second * estimate.standardDeviation.array();
      coverage[0] = within.cast<double>().mean();
    }
    errors.figures.push_back(coverage);
  }
  return errors;
}

FigureStore::FigureStore(
  std::size_t counts, std::size_t draws, std::size_t methods, std::size_t metrics)
  : Draws(draws)
  , Methods(methods)
  , Metrics(metrics)
  , Values(counts * draws * methods * metrics * FigureCount)
{
}

double* FigureStore::at(std::size_t count, std::size_t draw, std::size_t method, std::size_t metric)
{
  return Values.data() +
    (((count * Draws + draw) * Methods + method) * Metrics + metric) * FigureCount;
}

void FigureStore::sumOverRanks(vtkMultiProcessController* controller)
{
  sumValues(Values, controller);
}

SampleErrorStore::SampleErrorStore(
  std::vector<Count> counts, std::size_t methods, std::size_t samples)
  : Counts(std::move(counts))
  , Methods(methods)
  , Samples(samples)
{
  std::size_t size = 0;
  for (const auto& count : Counts)
  {
    Offsets.push_back(size);
    size += count.draws * count.metrics * Methods * Samples;
  }
  Values.resize(size);
}

Eigen::Map<Eigen::MatrixXd> SampleErrorStore::at(
  std::size_t count, std::size_t method, std::size_t metric)
{
  const auto& sizes = Counts[count];
  return { Values.data() + Offsets[count] +
      (method * sizes.metrics + metric) * sizes.draws * Samples,
    static_cast<Eigen::Index>(sizes.draws), static_cast<Eigen::Index>(Samples) };
}

void SampleErrorStore::sumOverRanks(vtkMultiProcessController* controller)
{
  sumValues(Values, controller);
}

} // namespace msi
