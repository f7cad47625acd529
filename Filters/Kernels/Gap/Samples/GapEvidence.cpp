#include "Kernels/Gap/Samples/GapEvidence.h"

#include "Kernels/Doubts/OddOnes.h"
#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/Diagnosis/GapRegression.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Numerics/OrderStatistic.h"

#include <algorithm>
#include <cmath>
#include <functional>
#include <limits>

namespace msi
{

namespace
{
constexpr std::size_t ManyGroups = 6;
constexpr int Gain = 1; // the number of its column

using Elements = Eigen::ArrayXXd;                          // K x S
using OfSamples = Eigen::Array<double, 1, Eigen::Dynamic>; // S

// The columns of the axes, K x S each, and last the gap; 0 where nothing was measured.
class AxisColumns
{
public:
  explicit AxisColumns(const GapData& data)
    : Data(data)
  {
  }
  void axis(const char* name) { Bases.push_back({ name, {}, {}, {} }); }
  // With a coefficient for all channels. Values of one row are those of every channel.
  void common(const Elements& values) { Bases.back().common.push_back(add(values)); }
  void commonAgain(int column) { Bases.back().common.push_back(column); }
  // With one for each channel.
  void own(const Elements& values) { Bases.back().own.push_back(add(values)); }
  // All of the axis up to here.
  void areOfCells()
  {
    AxisBasis& axis = Bases.back();
    axis.cells = axis.common;
    axis.cells.insert(axis.cells.end(), axis.own.begin(), axis.own.end());
  }
  int add(const Elements& values)
  {
    const Elements all = values.replicate(Data.channels() / values.rows(), 1);
    List.emplace_back(Data.measured().select(all, 0.0));
    return static_cast<int>(List.size()) - 1;
  }

  const std::vector<AxisBasis>& axes() const noexcept { return Bases; }
  // A fold held out each.
  std::vector<AxisSplit> splits() const
  {
    const Eigen::Index count = List.size();
    const std::size_t channels = Data.channels();
    ChannelNormals all(channels, Eigen::MatrixXd::Zero(count, count));
    std::vector<AxisSplit> splits;
    for (const SampleList& samples : Data.folds)
    {
      ChannelNormals test;
      for (std::size_t k = 0; k < channels; ++k)
      {
        Eigen::MatrixXd rows(samples.size(), count);
        for (Eigen::Index c = 0; c < count; ++c)
        {
          rows.col(c) = List[c](k, samples).transpose();
        }
        test.emplace_back(rows.transpose() * rows);
        all[k] += test.back();
      }
      splits.push_back({ {}, std::move(test) });
    }
    for (AxisSplit& split : splits)
    {
      for (std::size_t k = 0; k < channels; ++k)
      {
        split.training.emplace_back(all[k] - split.test[k]);
      }
    }
    return splits;
  }
  // What coefficients leave of the folds that were held out.
  Eigen::MatrixXd left(const PredictedEnergies& energies) const
  {
    Eigen::MatrixXd left = Eigen::MatrixXd::Zero(Data.channels(), Data.samples());
    for (std::size_t f = 0; f < Data.folds.size(); ++f)
    {
      const std::vector<Eigen::VectorXd>& coefficients = energies.coefficients[f];
      const SampleList& samples = Data.folds[f];
      left(Eigen::all, samples) = List.back()(Eigen::all, samples);
      for (Eigen::Index k = 0; k < Data.channels(); ++k)
      {
        for (std::size_t c = 0; c + 1 < List.size(); ++c)
        {
          left(k, samples) -= coefficients[k][c] * List[c](k, samples);
        }
      }
    }
    return left;
  }

private:
  const GapData& Data;
  std::vector<AxisBasis> Bases;
  std::vector<Eigen::MatrixXd> List;
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

// A group of one sample cannot predict it.
void addGroups(
  AxisColumns& columns, const std::vector<int>& group, std::size_t count, const Elements& u)
{
  const Eigen::Map<const Eigen::Array<int, 1, Eigen::Dynamic>> number(group.data(), u.cols());
  for (int g = 0; g < static_cast<int>(count); ++g)
  {
    const OfSamples member = (number == g).cast<double>();
    if (member.sum() < 2.0)
    {
      continue;
    }
    if (count <= ManyGroups)
    {
      columns.own(member);
      columns.common(u.square().rowwise() * member);
    }
    else
    {
      columns.common(member);
    }
    columns.common(u.rowwise() * member);
  }
  columns.areOfCells();
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
    std::vector<int> near = data.scene.neighbours()[i];
    near.erase(
      std::remove_if(near.begin(), near.end(), [&](int other) { return !data.anyMeasured(other); }),
      near.end());
    if (!near.empty())
    {
      difference.col(i) = data.simulated(Eigen::all, near).rowwise().mean() - data.simulated.col(i);
    }
  }
  return difference;
}

void addPosition(AxisColumns& columns, const GapData& data, const Elements& u)
{
  const OfSamples x = data.scene.fieldX().transpose();
  const OfSamples y = data.scene.fieldY().transpose();
  for (const OfSamples& factor : { x, y, OfSamples(x.square() + y.square()),
         OfSamples(x.square() - y.square()), OfSamples(x * y) })
  {
    columns.common(u.rowwise() * factor);
  }
  columns.common(x);
  columns.common(y);
  columns.areOfCells();
  columns.common(surroundMinusSelf(data));
}

void addOrder(AxisColumns& columns, const GapData& data, const Elements& u)
{
  const OfSamples t = data.scene.time().transpose();
  columns.own(u.rowwise() * t);
  columns.common(u.rowwise() * OfSamples(t.square()));
  columns.common(t);
  for (const double place : { 0.2, 0.4, 0.6, 0.8 })
  {
    columns.common(u.rowwise() * (t > place).cast<double>());
  }
  columns.areOfCells();
}

void addShape(AxisColumns& columns, const GapData& data, const Elements& u)
{
  columns.own(derivativeUnder(data, 1));
  columns.common(derivativeUnder(data, 2));
  const OfSamples mean = data.scene.reflectance().colwise().mean();
  columns.common(mean.replicate(u.rows(), 1) - u);
  Elements neighbours = Elements::Zero(u.rows(), u.cols());
  const Elements step = u.bottomRows(u.rows() - 1) - u.topRows(u.rows() - 1);
  neighbours.topRows(step.rows()) += step;
  neighbours.bottomRows(step.rows()) -= step;
  columns.common(neighbours);
}

AxisColumns axisColumns(const GapData& data, const Eigen::MatrixXd& gap)
{
  const Elements u = data.simulated;
  const SampleScene& scene = data.scene;
  AxisColumns columns(data);
  columns.axis("channel");
  columns.own(OfSamples::Ones(u.cols()));
  columns.own(u);
  columns.axis("level");
  columns.commonAgain(Gain);
  columns.common(u.square());
  columns.common(u.cube());
  columns.common((u - upperLevel(data)).cwiseMax(0.0));
  if (scene.media().size() > 1)
  {
    columns.axis("medium");
    addGroups(columns, scene.medium(), scene.media().size(), u);
  }
  if (scene.scenes().size() > 1)
  {
    columns.axis("scene");
    addGroups(columns, scene.scene(), scene.scenes().size(), u);
  }
  if (scene.hasPositions())
  {
    columns.axis("position");
    addPosition(columns, data, u);
  }
  if (scene.hasOrder())
  {
    columns.axis("order");
    addOrder(columns, data, u);
  }
  columns.axis("spectral_shape");
  addShape(columns, data, u);
  columns.add(gap);
  return columns;
}

// The medium, scene, third of the field or fifth of the order of a sample, or itself.
std::string sampleCell(const GapData& data, const std::string& axis, Eigen::Index i)
{
  const SampleScene& scene = data.scene;
  const auto part = [i](const char* name, const Eigen::VectorXd& all, int parts)
  { return GapPart(all[i], all.minCoeff(), all.maxCoeff(), parts).text(name); };
  return axis == "medium" ? scene.media()[scene.medium()[i]]
    : axis == "scene"     ? scene.scenes()[scene.scene()[i]]
    : axis == "position"  ? part("x", scene.samples().x, 3) + ", " + part("y", scene.samples().y, 3)
    : axis == "order"     ? part("order", scene.samples().order, 5)
                          : data.names[i];
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
      cells.add(axis == "channel" || axis == "spectral_shape" ? data.camera.channels()[k]
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

constexpr Eigen::Index FewSamples = 3;

// Energy explained over energy left where the gap shrinks by Decision::SmallPart.
double leastOverLeft()
{
  return std::pow(1.0 - Decision::SmallPart, -2) - 1.0;
}
}

AxisShares shareOverAxes(const GapData& data, const Eigen::MatrixXd& gap)
{
  const AxisColumns columns = axisColumns(data, gap);
  const PredictedEnergies energies = predictedEnergies(columns.axes(), columns.splits(), Gain);
  AxisShares shares;
  shares.predictable = std::fmax(energies.all, 0.0);
  shares.heldOutResidual = columns.left(energies);
  const double noise = (data.measured().cast<double>() * data.variance.array()).sum();
  const double beyond = std::fmax(energies.before - noise, 1e-300);
  for (std::size_t a = 0; a < energies.axis.size(); ++a)
  {
    shares.axes.push_back({ columns.axes()[a].axis, energies.axis[a] / beyond, {} });
  }
  shares.axes.push_back({ "sample", sampleEnergy(data, shares.heldOutResidual) / beyond, {} });
  shares.axes = worthNaming(std::move(shares.axes));
  for (GapAxis& axis : shares.axes)
  {
    axis.worst = worstCells(data, gap, axis.axis);
  }
  return shares;
}

double limitIntegration(GapData& data, const Eigen::MatrixXd& integration, double unpredicted)
{
  const double allowed = measuredOnly(data, integration).sum();
  const double other = measuredOnly(data, data.variance).sum() - allowed;
  double kept = 1.0;
  if (allowed > 0.0)
  {
    kept = std::fmin(std::fmax((unpredicted - other) / allowed, 0.0), 1.0);
    data.variance -= (1.0 - kept) * integration;
  }
  return (1.0 - kept) * allowed / static_cast<double>(data.elements);
}

bool predictable(const GapData& data, const Eigen::MatrixXd& gap, const AxisShares& shares)
{
  const Eigen::ArrayXd gain =
    gap.colwise().squaredNorm() - shares.heldOutResidual.colwise().squaredNorm();
  const double sum = gain.sum();
  const double square = gain.square().sum();
  const auto samples = static_cast<double>(data.usable.size());
  const double error = std::sqrt(std::fmax(square - sum * sum / samples, 0.0));
  const double noise = measuredOnly(data, data.variance).sum();
  return sum > Decision::SureDeviations * error && sum > Decision::SmallPart * noise;
}

double negligibleEnergy(
  const GapData& data, const Eigen::MatrixXd& after, const Eigen::MatrixXd& integration)
{
  return std::fmax(Decision::EstimateFactor * measuredOnly(data, integration).sum(),
    leastOverLeft() * after.squaredNorm());
}

double noticed(const GapData& data, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after,
  const Eigen::MatrixXd& integration)
{
  const Eigen::ArrayXd taken = before.colwise().squaredNorm() - after.colwise().squaredNorm();
  const Eigen::ArrayXd allowed =
    Decision::EstimateFactor * measuredOnly(data, integration).colwise().sum();
  const double explained = taken.sum();
  if (!(explained > 0.0))
  {
    return 0.0;
  }
  const double beyond = (taken - allowed).max(0.0).sum();
  return std::fmin(explained / (leastOverLeft() * after.squaredNorm()),
    std::fmax(explained / allowed.sum(), 2.0 * beyond / explained));
}

IndexList oddElements(
  const GapData& data, const Eigen::MatrixXd& before, const Eigen::MatrixXd& after)
{
  // Causes that odd samples have led astray leave more of the others.
  const Eigen::MatrixXd least = before.cwiseAbs2().cwiseMin(after.cwiseAbs2());
  const double none = std::numeric_limits<double>::quiet_NaN();
  const Eigen::VectorXi channel = Eigen::VectorXi::LinSpaced(
    static_cast<int>(data.channels()), 0, static_cast<int>(data.channels()) - 1);
  return oddElements(data.measured().select(data.weight.cwiseProduct(least), none),
    channel.replicate(1, data.samples()), data.leftOut.size());
}

bool inFewSamples(const GapData& data, const Eigen::MatrixXd& change)
{
  Eigen::VectorXd energy = measuredOnly(data, change).colwise().squaredNorm();
  std::sort(energy.begin(), energy.end(), std::greater<>());
  return energy.head(std::min(energy.size(), FewSamples)).sum() >
    (1.0 - Decision::SmallPart) * energy.sum();
}

} // namespace msi
