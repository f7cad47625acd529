#include "HeldOutFigures.h"

#include "vtkCommunicator.h"
#include "vtkMultiProcessController.h"

#include "Kernels/Difference/ErrorSummary.h"

#include <cmath>

namespace msi
{

namespace
{
constexpr double TwoSidedNormal95 = 1.959963984540054;

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
  Metrics.push_back({ "coverage95", "" });
}

std::vector<Figures> HeldOutJudge::operator()(
  const MethodEstimate& estimate, const std::vector<Eigen::Index>& heldOut) const
{
  std::vector<Figures> figures{ figuresOf(estimate.rms) };
  for (const auto& color : Colors)
  {
    Eigen::Matrix3Xd lab = color.tristimulus(estimate.reflectance);
    color.space.fromXYZ(lab, lab);
    Eigen::VectorXd difference(lab.cols());
    const Eigen::Matrix3Xd reference = color.targetLab(Eigen::all, heldOut);
    Difference.apply(reference, lab, difference);
    figures.push_back(figuresOf(difference));
  }
  Figures coverage;
  coverage.fill(std::nan(""));
  if (estimate.standardDeviation.size() > 0)
  {
    const Eigen::ArrayXXd error =
      (estimate.reflectance - Target(Eigen::all, heldOut)).array().abs();
    const auto within = error <= TwoSidedNormal95 * estimate.standardDeviation.array();
    coverage[0] = within.cast<double>().mean();
  }
  figures.push_back(coverage);
  return figures;
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
  if (!controller)
  {
    return;
  }
  std::vector<double> all(Values.size());
  controller->AllReduce(
    Values.data(), all.data(), static_cast<vtkIdType>(Values.size()), vtkCommunicator::SUM_OP);
  Values = std::move(all);
}

} // namespace msi
