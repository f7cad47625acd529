#include "Kernels/Gap/Samples/AxisShares.h"

#include "Kernels/Numerics/OrderStatistic.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr std::size_t ManyGroups = 6;

using Elements = Eigen::ArrayXXd;                          // K x S
using OfSamples = Eigen::Array<double, 1, Eigen::Dynamic>; // S

// Builds the columns of one axis after the other.
class Columns
{
public:
  explicit Columns(const GapData& data)
    : Channels(data.channels())
    , Usable((data.count.array() > 0.0).colwise().any())
  {
  }
  // One row for all channels, or one for each.
  void add(const Elements& values)
  {
    const Elements known = Usable.replicate(values.rows(), 1).select(values, 0.0);
    List.emplace_back(known.replicate(Channels / known.rows(), 1).reshaped());
  }
  // One column a channel: the values in that channel, less the mean over the channels if centered.
  void addEachChannel(const Elements& values, bool centered)
  {
    const double mean = centered ? 1.0 / static_cast<double>(Channels) : 0.0;
    for (Eigen::Index c = 0; c < Channels; ++c)
    {
      Eigen::ArrayXd factor = Eigen::ArrayXd::Constant(Channels, -mean);
      factor[c] += 1.0;
      add(values.colwise() * factor);
    }
  }
  void finish(const char* axis)
  {
    Names.emplace_back(axis);
    End.push_back(static_cast<Eigen::Index>(List.size()));
  }
  AxisBases bases() const
  {
    AxisBases bases{ Names, End, { List.front().size(), End.back() } };
    for (std::size_t c = 0; c < List.size(); ++c)
    {
      bases.columns.col(static_cast<Eigen::Index>(c)) = List[c];
    }
    return bases;
  }

private:
  Eigen::Index Channels;
  Eigen::Array<bool, 1, Eigen::Dynamic> Usable;
  std::vector<std::string> Names;
  std::vector<Eigen::Index> End;
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

void addGroups(Columns& columns, const std::vector<int>& group, std::size_t count,
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

void addPosition(Columns& columns, const GapData& data, const Elements& u, bool contrasts)
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

void addOrder(Columns& columns, const GapData& data, const Elements& u, bool contrasts)
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

void addShape(Columns& columns, const GapData& data, const Elements& u)
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
}

AxisBases axisBases(const GapData& data, bool contrasts)
{
  const Elements u = data.simulated;
  Columns columns(data);
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
  return columns.bases();
}

} // namespace msi
