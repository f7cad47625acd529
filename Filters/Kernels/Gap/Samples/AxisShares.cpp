#include "Kernels/Gap/Samples/AxisShares.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Numerics/LeastSquares.h"
#include "Kernels/Numerics/OrderStatistic.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double Ridge = 1e-4; // of the mean square of a column
constexpr std::size_t ManyGroups = 6;

using Elements = Eigen::ArrayXXd;                          // K x S
using OfSamples = Eigen::Array<double, 1, Eigen::Dynamic>; // S

// The regressors of the axes on the elements k + K i: the columns of one axis after the other.
class AxisColumns
{
public:
  explicit AxisColumns(const GapData& data)
    : Measured(data.measured())
  {
  }
  // One row for all channels, or one for each.
  void add(const Elements& values)
  {
    const Elements all = values.replicate(Measured.rows() / values.rows(), 1);
    List.emplace_back(Measured.select(all, 0.0).reshaped());
    AxisOf.push_back(Names.size());
  }
  // One column a channel: the values in that channel, less the mean over the channels if centered.
  void addEachChannel(const Elements& values, bool centered)
  {
    const double mean = centered ? 1.0 / static_cast<double>(Measured.rows()) : 0.0;
    for (Eigen::Index c = 0; c < Measured.rows(); ++c)
    {
      Eigen::ArrayXd factor = Eigen::ArrayXd::Constant(Measured.rows(), -mean);
      factor[c] += 1.0;
      add(values.colwise() * factor);
    }
  }
  void finish(const char* axis) { Names.emplace_back(axis); }

  const std::vector<std::string>& axes() const noexcept { return Names; }
  // The numbers of the columns of some axes.
  std::vector<Eigen::Index> of(std::size_t subset) const
  {
    std::vector<Eigen::Index> chosen;
    for (std::size_t c = 0; c < List.size(); ++c)
    {
      if ((subset >> AxisOf[c] & 1U) != 0)
      {
        chosen.push_back(static_cast<Eigen::Index>(c));
      }
    }
    return chosen;
  }
  // All, and last the gap; 0 where nothing was measured.
  Eigen::MatrixXd with(const Eigen::MatrixXd& gap) const
  {
    Eigen::MatrixXd all(gap.size(), static_cast<Eigen::Index>(List.size()) + 1);
    for (std::size_t c = 0; c < List.size(); ++c)
    {
      all.col(static_cast<Eigen::Index>(c)) = List[c];
    }
    all.rightCols(1) = gap.reshaped();
    return all;
  }

private:
  Eigen::Array<bool, Eigen::Dynamic, Eigen::Dynamic> Measured;
  std::vector<std::string> Names;
  std::vector<std::size_t> AxisOf; // of each column
  std::vector<Eigen::VectorXd> List;
};

// First and second derivative under every passband, per 100 nm.
Elements derivativeUnder(const GapData& data, int order)
{
  const WavelengthGrid& grid = data.camera.wavelengths();
  const Eigen::Index last = grid.size() - 1;
  Eigen::MatrixXd derivative = data.scene.reflectance();
  for (int n = 0; n < order; ++n)
  {
    Eigen::MatrixXd next = Eigen::MatrixXd::Zero(derivative.rows(), derivative.cols());
    for (Eigen::Index j = 0; j <= last && last > 0; ++j)
    {
      const Eigen::Index a = std::max<Eigen::Index>(j - 1, 0);
      const Eigen::Index b = std::min(j + 1, last);
      next.row(j) = 100.0 * (derivative.row(b) - derivative.row(a)) / (grid[b] - grid[a]);
    }
    derivative = std::move(next);
  }
  return data.camera.responsivity() * derivative;
}

void addGroups(AxisColumns& columns, const std::vector<int>& group, std::size_t count,
  const Elements& u, bool contrasts)
{
  const int groups = static_cast<int>(count);
  const Eigen::Map<const Eigen::Array<int, 1, Eigen::Dynamic>> number(group.data(), u.cols());
  for (int g = 0; g + (contrasts ? 1 : 0) < groups; ++g)
  {
    const OfSamples member =
      (number == g).cast<double>() - (contrasts ? 1.0 / static_cast<double>(groups) : 0.0);
    if (count <= ManyGroups)
    {
      columns.addEachChannel(member.replicate(u.rows(), 1), false);
      columns.add(u.square().rowwise() * member);
    }
    else
    {
      columns.add(member);
    }
    columns.add(u.rowwise() * member);
  }
}

double upperLevel(const GapData& data)
{
  std::vector<double> levels;
  for (Eigen::Index i = 0; i < data.observed.size(); ++i)
  {
    if (data.count(i) > 0.0)
    {
      levels.push_back(data.simulated(i));
    }
  }
  return orderStatistic(
    levels, static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(levels.size() - 1)));
}

// Mean response of the usable neighbours minus the sample's own.
Elements surroundMinusSelf(const GapData& data)
{
  Elements difference = Elements::Zero(data.channels(), data.samples());
  for (Eigen::Index i = 0; i < data.samples(); ++i)
  {
    std::vector<int> near = data.scene.neighbours()[static_cast<std::size_t>(i)];
    near.erase(std::remove_if(near.begin(), near.end(),
                 [&](int other) { return !(data.count.col(other).array() > 0.0).any(); }),
      near.end());
    if (!near.empty())
    {
      difference.col(i) = data.simulated(Eigen::all, near).rowwise().mean() - data.simulated.col(i);
    }
  }
  return difference;
}

void addPosition(AxisColumns& columns, const GapData& data, const Elements& u, bool contrasts)
{
  const OfSamples x = data.scene.fieldX().transpose();
  const OfSamples y = data.scene.fieldY().transpose();
  const OfSamples square = x.square() + y.square();
  for (const OfSamples& factor : { x, y, OfSamples(square - (contrasts ? square.mean() : 0.0)),
         OfSamples(x.square() - y.square()), OfSamples(x * y) })
  {
    columns.add(u.rowwise() * factor);
  }
  columns.add(x);
  columns.add(y);
  columns.add(surroundMinusSelf(data));
}

void addOrder(AxisColumns& columns, const GapData& data, const Elements& u, bool contrasts)
{
  const double common = contrasts ? 1.0 : 0.0;
  const OfSamples time = data.scene.time().transpose();
  const OfSamples t = time - 0.5 * common;
  columns.add(u.rowwise() * t);
  columns.add(u.rowwise() * OfSamples(t.square() - common * t.square().mean()));
  columns.add(t);
  for (const double place : { 0.2, 0.4, 0.6, 0.8 })
  {
    const OfSamples behind = (time > place).cast<double>() - common * (1.0 - place);
    columns.add(u.rowwise() * behind);
  }
  columns.addEachChannel(u.rowwise() * t, true);
}

void addShape(AxisColumns& columns, const GapData& data, const Elements& u)
{
  columns.addEachChannel(derivativeUnder(data, 1), false);
  columns.add(derivativeUnder(data, 2));
  const OfSamples mean = data.scene.reflectance().colwise().mean();
  columns.add(mean.replicate(u.rows(), 1) - u);
  Elements neighbours = Elements::Zero(u.rows(), u.cols());
  const Elements step = u.bottomRows(u.rows() - 1) - u.topRows(u.rows() - 1);
  neighbours.topRows(step.rows()) += step;
  neighbours.bottomRows(step.rows()) -= step;
  columns.add(neighbours);
}

// With `contrasts` the columns of medium, scene, position and order leave out what all of their cells have in common.
AxisColumns axisColumns(const GapData& data, bool contrasts)
{
  const Elements u = data.simulated;
  AxisColumns columns(data);
  columns.addEachChannel(Elements::Ones(u.rows(), u.cols()), false);
  columns.addEachChannel(u, true);
  columns.finish("channel");
  columns.add(u);
  columns.add(u.square());
  columns.add(u.cube());
  columns.add((u - upperLevel(data)).cwiseMax(0.0));
  columns.finish("level");
  const SampleScene& scene = data.scene;
  if (scene.media().size() > 1)
  {
    addGroups(columns, scene.medium(), scene.media().size(), u, contrasts);
    columns.finish("medium");
  }
  if (scene.scenes().size() > 1)
  {
    addGroups(columns, scene.scene(), scene.scenes().size(), u, contrasts);
    columns.finish("scene");
  }
  if (scene.hasPositions())
  {
    addPosition(columns, data, u, contrasts);
    columns.finish("position");
  }
  if (scene.hasOrder())
  {
    addOrder(columns, data, u, contrasts);
    columns.finish("order");
  }
  addShape(columns, data, u);
  columns.finish("spectral_shape");
  return columns;
}

// Ridge regressions of the gap on any subset of the axes, trained without one fold and tried on it.
class FoldedRegression
{
public:
  FoldedRegression(const GapData& data, const Eigen::MatrixXd& gap, bool contrasts)
    : Bases(axisColumns(data, contrasts))
    , Columns(Bases.with(gap))
    , Held(static_cast<std::size_t>(data.folds))
  {
    for (Eigen::Index i = 0; i < data.samples(); ++i)
    {
      const int fold = data.fold[static_cast<std::size_t>(i)];
      for (Eigen::Index k = 0; fold >= 0 && k < data.channels(); ++k)
      {
        Held[static_cast<std::size_t>(fold)].push_back(k + data.channels() * i);
      }
    }
    All = Eigen::MatrixXd::Zero(Columns.cols(), Columns.cols());
    for (const std::vector<Eigen::Index>& elements : Held)
    {
      const Eigen::MatrixXd rows = Columns(elements, Eigen::all);
      Normal.emplace_back(rows.transpose() * rows);
      All += Normal.back();
    }
  }

  const std::vector<std::string>& axes() const noexcept { return Bases.axes(); }
  double energy() const { return All(All.rows() - 1, All.rows() - 1); }

  // Held-out energy that these axes explain. residual: what they leave, where it is asked for.
  double explained(std::size_t subset, Eigen::MatrixXd* residual) const
  {
    const std::vector<Eigen::Index> chosen = Bases.of(subset);
    const Eigen::Index gap = Columns.cols() - 1;
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
        const Eigen::MatrixXd rows = Columns(Held[f], Eigen::all);
        residual->reshaped()(Held[f]) = rows.col(gap) - rows.leftCols(gap) * change;
      }
    }
    return energy() - left;
  }

private:
  AxisColumns Bases;
  Eigen::MatrixXd Columns;                     // of the axes, and last the gap
  std::vector<std::vector<Eigen::Index>> Held; // elements, of each fold
  std::vector<Eigen::MatrixXd> Normal;         // of each fold
  Eigen::MatrixXd All;
};

// The medium, scene, third of the field or fifth of the order of a sample, or itself.
std::string sampleCell(const GapData& data, const std::string& axis, Eigen::Index i)
{
  const SampleScene& scene = data.scene;
  const auto sample = static_cast<std::size_t>(i);
  const auto part = [i](const char* name, const Eigen::VectorXd& all, int parts)
  { return GapPart(all[i], all.minCoeff(), all.maxCoeff(), parts).text(name); };
  return axis == "medium" ? scene.media()[static_cast<std::size_t>(scene.medium()[sample])]
    : axis == "scene"     ? scene.scenes()[static_cast<std::size_t>(scene.scene()[sample])]
    : axis == "position"  ? part("x", scene.samples().x, 3) + ", " + part("y", scene.samples().y, 3)
    : axis == "order"     ? part("order", scene.samples().order, 5)
                          : "sample " + std::to_string(i + 1);
}

// The cells of an axis with the largest shares of the gap's energy: those of samples, channels, fifths of the level.
std::vector<GapCell> worstCells(
  const GapData& data, const Eigen::MatrixXd& gap, const std::string& axis)
{
  const Eigen::MatrixXd level = data.measured().select(data.simulated, 0.0);
  const double low = std::fmin(level.minCoeff(), 0.0);
  const double high = std::fmax(level.maxCoeff(), 0.0);
  GapCells cells;
  for (Eigen::Index i = 0; i < gap.cols(); ++i)
  {
    const std::string sample = sampleCell(data, axis, i);
    for (Eigen::Index k = 0; k < gap.rows(); ++k)
    {
      cells.add(axis == "channel" || axis == "spectral_shape"
          ? data.camera.channels()[static_cast<std::size_t>(k)]
          : axis == "level" ? GapPart(data.simulated(k, i), low, high, 5).text("level")
                            : sample,
        gap(k, i) * gap(k, i));
    }
  }
  return cells.worst();
}

// What the mean over one half of a sample's channels predicts of the other half.
double sampleEnergy(const GapData& data, const Eigen::MatrixXd& residual)
{
  const Eigen::ArrayXXd measured = data.measured().cast<double>();
  const Eigen::ArrayXXd left = measured * residual.array();
  const auto half = [](const Eigen::ArrayXXd& values, Eigen::Index first)
  {
    const Elements own = values(Eigen::seq(first, values.rows() - 1, 2), Eigen::all);
    return OfSamples(own.colwise().sum());
  };
  const OfSamples even = half(measured, 0);
  const OfSamples odd = half(measured, 1);
  const OfSamples products = (half(left, 0) / even) * (half(left, 1) / odd);
  const double energy = (even > 0.0 && odd > 0.0).select((even + odd) * products, 0.0).sum();
  return std::fmax(energy, 0.0);
}

}

AxisShares shareOverAxes(const GapData& data, const Eigen::MatrixXd& gap)
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
  const double noise = (data.measured().cast<double>() * data.variance.array()).sum();
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
  for (GapAxis& axis : shares.axes)
  {
    axis.worst = worstCells(data, gap, axis.axis);
  }
  return shares;
}

} // namespace msi
