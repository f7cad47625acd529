#include "Kernels/Gap/Samples/SampleObservation.h"

#include "Kernels/Gap/Samples/ColumnProducts.h"
#include "Kernels/Gap/Samples/OrderBreaks.h"

#include <Eigen/Cholesky>
#include <Eigen/QR>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
// The residual and everything the present effects can do, taken out of the way.
class Remainder
{
public:
  Remainder(const EffectFitter& fitter, const EffectFit& current)
    : RootWeight(
        Eigen::Map<const Eigen::ArrayXd>(fitter.weight().data(), fitter.weight().size()).sqrt())
  {
    if (current.jacobian.cols() > 0)
    {
      const Eigen::MatrixXd columns = RootWeight.matrix().asDiagonal() * current.jacobian;
      Eigen::ColPivHouseholderQR<Eigen::MatrixXd> qr(columns);
      Basis = qr.householderQ() * Eigen::MatrixXd::Identity(columns.rows(), qr.rank());
    }
  }
  // Of one column, with nothing where there is no weight.
  Eigen::VectorXd cleared(const Eigen::VectorXd& column) const
  {
    Eigen::VectorXd rest = (RootWeight > 0.0).select(RootWeight * column.array(), 0.0);
    if (Basis.cols() > 0)
    {
      rest -= Basis * columnProducts(Basis, rest);
    }
    return rest;
  }
  // Squared error left of a cleared residual after one linear step with these columns of a jacobian.
  double leftAfter(const Eigen::VectorXd& residual, const Eigen::MatrixXd& columns,
    const std::vector<FreeParameter>& free) const
  {
    const Eigen::MatrixXd weighted = RootWeight.matrix().asDiagonal() * columns;
    Eigen::MatrixXd normal = columnProducts(weighted);
    if (Basis.cols() > 0)
    {
      const Eigen::MatrixXd along = columnProducts(Basis, weighted);
      normal -= along.transpose() * along;
    }
    for (Eigen::Index p = 0; p < columns.cols(); ++p)
    {
      const double spread = free[static_cast<std::size_t>(p)].spread;
      normal(p, p) += 1.0 / (spread * spread);
    }
    const Eigen::VectorXd gradient = columnProducts(weighted, residual);
    return residual.squaredNorm() - gradient.dot(normal.ldlt().solve(gradient));
  }

private:
  Eigen::ArrayXd RootWeight;
  Eigen::MatrixXd Basis;
};

// No square yet, and slope and constant of the line through the squared signals of each channel.
std::vector<double> besideLine(const GapData& data)
{
  const Eigen::Index channels = data.channels();
  std::vector<double> start(static_cast<std::size_t>(1 + 2 * channels), 0.0);
  for (Eigen::Index k = 0; k < channels; ++k)
  {
    double n = 0, x = 0, xx = 0, xxx = 0;
    for (Eigen::Index j = 0; j < data.samples(); ++j)
    {
      if (data.weight(k, j) > 0.0)
      {
        const double u = data.simulated(k, j) - data.camera.dark()[k];
        n += 1.0;
        x += u;
        xx += u * u;
        xxx += u * u * u;
      }
    }
    const double spread = n * xx - x * x;
    if (spread > 1e-9 * n * xx)
    {
      const double slope = (n * xxx - x * xx) / spread;
      start[static_cast<std::size_t>(1 + k)] = slope;
      start[static_cast<std::size_t>(1 + channels + k)] = (xx - slope * x) / n;
    }
  }
  return start;
}

std::vector<std::vector<double>> startsOf(
  const EffectChoice& choice, const GapData& data, const OrderBreaks& breaks)
{
  const std::vector<EffectParameter>& parameters = choice.form->parameters;
  if (std::any_of(parameters.begin(), parameters.end(),
        [](const EffectParameter& parameter) { return parameter.searched; }))
  {
    return breaks.startsFor(*choice.form);
  }
  if (choice.form->has(FormTrait::BesideLine))
  {
    return { besideLine(data) };
  }
  std::vector<std::vector<double>> starts = choice.form->starts;
  if (choice.effect->has(EffectTrait::LimitsResponse))
  {
    starts.push_back({ 0.98 * data.observed.maxCoeff(), starts.front()[1] });
  }
  return starts;
}
}

std::vector<GapPreview> SampleObservation::previews(const ObservedFit& from) const
{
  const EffectFit current = linearised(from);
  const GapData& data = Fitter.data();
  const Remainder remainder(Fitter, current);
  const auto flatten = [](const Eigen::MatrixXd& m) -> Eigen::VectorXd
  { return Eigen::Map<const Eigen::VectorXd>(m.data(), m.size()); };
  const Eigen::VectorXd residual = remainder.cleared(flatten(data.observed - current.predicted));
  const double before = residual.squaredNorm();
  const OrderBreaks breaks(Fitter, current.predicted);
  const std::size_t position = current.set.size();
  const std::optional<StagedResponse> present =
    stagedResponse(data.camera, data.scene, current.set);
  std::vector<GapPreview> previews;
  for (std::size_t option = 0; present && option < Choices.size(); ++option)
  {
    const EffectChoice& choice = Choices[option];
    if (current.set.has(choice))
    {
      continue;
    }
    std::vector<std::vector<double>> starts = startsOf(choice, data, breaks);
    if (starts.empty())
    {
      starts.emplace_back();
    }
    GapPreview best{ option, {}, 0.0, 0.0 };
    for (const std::vector<double>& start : starts)
    {
      EffectSet set = current.set;
      set.add(choice, data.camera, start);
      std::vector<FreeParameter> free = set.freeParameters(data.camera);
      free.erase(std::remove_if(free.begin(), free.end(),
                   [position](const FreeParameter& p) { return p.effect < position; }),
        free.end());
      const std::optional<StagedResponse> base = stagedResponse(*present, set);
      if (!base)
      {
        continue;
      }
      const bool there =
        start.empty() && set.whiteAfterEffects() == current.set.whiteAfterEffects();
      const Eigen::VectorXd here =
        there ? residual : remainder.cleared(flatten(data.observed - base->response()));
      const Eigen::MatrixXd columns = jacobian(*base, set, free);
      const double gain = before - remainder.leftAfter(here, columns, free);
      best.parameters = static_cast<double>(columns.cols()) +
        static_cast<double>(set.steps() - current.set.steps());
      if (gain > best.gain)
      {
        best.gain = gain;
        best.start = start;
      }
    }
    previews.push_back(std::move(best));
  }
  std::stable_sort(previews.begin(), previews.end(),
    [](const GapPreview& a, const GapPreview& b) { return a.gain > b.gain; });
  return previews;
}

} // namespace msi
