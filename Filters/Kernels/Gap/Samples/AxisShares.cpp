#include "Kernels/Gap/Samples/AxisShares.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Numerics/LeastSquares.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <functional>

namespace msi
{

namespace
{
constexpr double Ridge = 1e-4; // of the mean square of a column

// Ridge regressions of the gap on any subset of the axes, trained without one fold and tried on it.
class FoldedRegression
{
public:
  FoldedRegression(const GapData& data, const Eigen::MatrixXd& gap, bool contrasts)
    : Bases(axisBases(data, contrasts))
    , Columns(gap.size(), Bases.columns.cols() + 1)
    , Elements(static_cast<std::size_t>(data.folds))
  {
    Columns << (data.count.array() > 0.0).cast<double>().matrix().reshaped().asDiagonal() *
        Bases.columns,
      gap.reshaped();
    for (Eigen::Index i = 0; i < data.samples(); ++i)
    {
      const int fold = data.fold[static_cast<std::size_t>(i)];
      for (Eigen::Index k = 0; fold >= 0 && k < data.channels(); ++k)
      {
        Elements[static_cast<std::size_t>(fold)].push_back(k + data.channels() * i);
      }
    }
    All = Eigen::MatrixXd::Zero(Columns.cols(), Columns.cols());
    for (const std::vector<Eigen::Index>& elements : Elements)
    {
      const Eigen::MatrixXd rows = Columns(elements, Eigen::all);
      Normal.emplace_back(rows.transpose() * rows);
      All += Normal.back();
    }
  }

  const std::vector<std::string>& axes() const noexcept { return Bases.names; }
  double energy() const { return All(All.rows() - 1, All.rows() - 1); }

  // Held-out energy that these axes explain. residual: what they leave, where it is asked for.
  double explained(std::size_t subset, Eigen::MatrixXd* residual) const
  {
    std::vector<Eigen::Index> chosen;
    Eigen::Index column = 0;
    for (std::size_t a = 0; a < Bases.end.size(); ++a)
    {
      for (; column < Bases.end[a]; ++column)
      {
        if ((subset >> a & 1U) != 0)
        {
          chosen.push_back(column);
        }
      }
    }
    const Eigen::Index gap = column;
    double left = 0.0;
    for (std::size_t f = 0; f < Normal.size(); ++f)
    {
      const Eigen::MatrixXd others = All - Normal[f];
      Eigen::MatrixXd normal = others(chosen, chosen);
      normal.diagonal().array() += Ridge * All.diagonal()(chosen).array() + 1e-12;
      Eigen::VectorXd change = Eigen::VectorXd::Zero(gap);
      const Eigen::VectorXd gradient = others.col(gap)(chosen);
      change(chosen) = normal.llt().solve(gradient).eval();
      left += energyLeft(Normal[f], change);
      if (residual != nullptr)
      {
        const Eigen::MatrixXd rows = Columns(Elements[f], Eigen::all);
        residual->reshaped()(Elements[f]) = rows.col(gap) - rows.leftCols(gap) * change;
      }
    }
    return energy() - left;
  }

private:
  AxisBases Bases;
  Eigen::MatrixXd Columns;                         // of the axes, and last the gap
  std::vector<std::vector<Eigen::Index>> Elements; // of each fold
  std::vector<Eigen::MatrixXd> Normal;             // of each fold
  Eigen::MatrixXd All;
};

using CellOf = std::function<std::string(Eigen::Index, Eigen::Index)>;

CellOf cellOf(const GapData& data, const std::string& axis)
{
  const SampleScene& scene = data.scene;
  if (axis == "channel" || axis == "spectral_shape")
  {
    return [&data](Eigen::Index k, Eigen::Index)
    { return data.camera.channels()[static_cast<std::size_t>(k)]; };
  }
  if (axis == "medium" || axis == "scene")
  {
    const bool medium = axis == "medium";
    const std::vector<int>& number = medium ? scene.medium() : scene.scene();
    const std::vector<std::string>& names = medium ? scene.media() : scene.scenes();
    return [&number, &names](Eigen::Index, Eigen::Index i)
    { return names[static_cast<std::size_t>(number[static_cast<std::size_t>(i)])]; };
  }
  if (axis == "position")
  {
    const Eigen::VectorXd& x = scene.samples().x;
    const Eigen::VectorXd& y = scene.samples().y;
    return [&x, &y](Eigen::Index, Eigen::Index i)
    {
      return GapPart(x[i], x.minCoeff(), x.maxCoeff(), 3).text("x") + ", " +
        GapPart(y[i], y.minCoeff(), y.maxCoeff(), 3).text("y");
    };
  }
  if (axis == "order")
  {
    const Eigen::VectorXd& order = scene.samples().order;
    return [&order](Eigen::Index, Eigen::Index i)
    { return GapPart(order[i], order.minCoeff(), order.maxCoeff(), 5).text("order"); };
  }
  if (axis == "level")
  {
    double low = 0.0;
    double high = 0.0;
    for (Eigen::Index i = 0; i < data.simulated.size(); ++i)
    {
      if (data.count(i) > 0.0)
      {
        low = std::fmin(low, data.simulated(i));
        high = std::fmax(high, data.simulated(i));
      }
    }
    return [&data, low, high](Eigen::Index k, Eigen::Index i)
    { return GapPart(data.simulated(k, i), low, high, 5).text("level"); };
  }
  return [](Eigen::Index, Eigen::Index i) { return "sample " + std::to_string(i + 1); };
}

// The cells of an axis with the largest shares of the gap's energy: channels, media, scenes, thirds of the field, fifths of
// level and order, samples.
std::vector<GapCell> worstCells(
  const GapData& data, const Eigen::MatrixXd& gap, const std::string& axis)
{
  const CellOf cell = cellOf(data, axis);
  const bool perElement = axis == "level" || axis == "channel" || axis == "spectral_shape";
  GapCells cells;
  for (Eigen::Index i = 0; i < gap.cols(); ++i)
  {
    for (Eigen::Index k = 0; perElement && k < gap.rows(); ++k)
    {
      cells.add(cell(k, i), gap(k, i) * gap(k, i));
    }
    if (!perElement)
    {
      cells.add(cell(0, i), gap.col(i).squaredNorm());
    }
  }
  return cells.worst();
}

// What the mean over one half of a sample's channels predicts of the other half.
double sampleEnergy(const GapData& data, const Eigen::MatrixXd& residual)
{
  double energy = 0.0;
  for (Eigen::Index i = 0; i < data.samples(); ++i)
  {
    double sum[2] = { 0.0, 0.0 };
    double count[2] = { 0.0, 0.0 };
    for (Eigen::Index k = 0; k < data.channels(); ++k)
    {
      if (data.count(k, i) > 0.0)
      {
        sum[k % 2] += residual(k, i);
        count[k % 2] += 1.0;
      }
    }
    if (count[0] > 0.0 && count[1] > 0.0)
    {
      energy += (count[0] + count[1]) * (sum[0] / count[0]) * (sum[1] / count[1]);
    }
  }
  return std::fmax(energy, 0.0);
}

}

AxisShares shareOverAxes(const GapData& data, const Eigen::MatrixXd& gap, bool withCells)
{
  FoldedRegression regression(data, gap, false);
  AxisShares shares;
  shares.heldOutResidual = Eigen::MatrixXd::Zero(data.channels(), data.samples());
  const std::size_t count = regression.axes().size();
  const std::vector<double> shapley = shapleyOfAxes(
    count,
    [&](std::size_t subset)
    {
      const bool all = subset + 1 == std::size_t(1) << count;
      const double explained =
        regression.explained(subset, all ? &shares.heldOutResidual : nullptr);
      shares.predictable = all ? std::fmax(explained, 0.0) : shares.predictable;
      return explained;
    },
    [&] { regression = FoldedRegression(data, gap, true); });
  const double noise = ((data.count.array() > 0.0).cast<double>() * data.variance.array()).sum();
  const double beyond = std::fmax(regression.energy() - noise, 1e-300);
  double total = 0.0;
  for (std::size_t a = 0; a < count; ++a)
  {
    shares.axes.push_back({ regression.axes()[a], std::fmax(shapley[a] / beyond, 0.0), {} });
    total += shares.axes.back().share;
  }
  shares.axes.push_back({ "sample", sampleEnergy(data, shares.heldOutResidual) / beyond, {} });
  total += shares.axes.back().share;
  for (GapAxis& axis : shares.axes)
  {
    axis.share /= std::fmax(total, 1.0);
  }
  shares.axes = worthNaming(std::move(shares.axes));
  for (std::size_t a = 0; withCells && a < shares.axes.size(); ++a)
  {
    shares.axes[a].worst = worstCells(data, gap, shares.axes[a].axis);
  }
  return shares;
}

} // namespace msi
