#include "Kernels/Gap/Samples/GapAxes.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr std::size_t ManyGroups = 6;

// Builds columns over the elements k + K i.
class Columns
{
public:
  explicit Columns(const GapData& data)
    : Data(data)
    , Channels(data.channels())
    , Samples(data.samples())
  {
  }
  template <typename Value> // Value(k, i)
  void add(const Value& value)
  {
    Eigen::VectorXd column = Eigen::VectorXd::Zero(Channels * Samples);
    for (Eigen::Index i = 0; i < Samples; ++i)
    {
      if (Data.usable[static_cast<std::size_t>(i)] != 0)
      {
        for (Eigen::Index k = 0; k < Channels; ++k)
        {
          column[k + Channels * i] = value(k, i);
        }
      }
    }
    List.push_back(std::move(column));
  }
  // One column a channel: value in that channel, less the mean over the channels if centered.
  template <typename Value>
  void addEachChannel(const Value& value, bool centered)
  {
    const double mean = centered ? 1.0 / static_cast<double>(Channels) : 0.0;
    for (Eigen::Index c = 0; c < Channels; ++c)
    {
      add([&](Eigen::Index k, Eigen::Index i)
        { return ((k == c ? 1.0 : 0.0) - mean) * value(k, i); });
    }
  }
  AxisBasis finish(const char* axis)
  {
    AxisBasis basis{ axis,
      Eigen::MatrixXd(Channels * Samples, static_cast<Eigen::Index>(List.size())) };
    for (std::size_t c = 0; c < List.size(); ++c)
    {
      basis.columns.col(static_cast<Eigen::Index>(c)) = List[c];
    }
    List.clear();
    return basis;
  }

private:
  const GapData& Data;
  Eigen::Index Channels;
  Eigen::Index Samples;
  std::vector<Eigen::VectorXd> List;
};

// First and second derivative under every passband, per 100 nm.
Eigen::MatrixXd derivativeUnder(const GapData& data, int order)
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
  const Eigen::MatrixXd& u, bool contrasts)
{
  const int groups = static_cast<int>(count);
  const double common = contrasts ? 1.0 / groups : 0.0;
  for (int g = 0; g + (contrasts ? 1 : 0) < groups; ++g)
  {
    const auto member = [&group, g, common](Eigen::Index i)
    { return (group[static_cast<std::size_t>(i)] == g ? 1.0 : 0.0) - common; };
    if (count <= ManyGroups)
    {
      columns.addEachChannel([&](Eigen::Index, Eigen::Index i) { return member(i); }, false);
      columns.add([&](Eigen::Index k, Eigen::Index i) { return member(i) * u(k, i) * u(k, i); });
    }
    else
    {
      columns.add([&](Eigen::Index, Eigen::Index i) { return member(i); });
    }
    columns.add([&](Eigen::Index k, Eigen::Index i) { return member(i) * u(k, i); });
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
  const auto place =
    levels.begin() + static_cast<std::ptrdiff_t>(0.9 * static_cast<double>(levels.size() - 1));
  std::nth_element(levels.begin(), place, levels.end());
  return *place;
}

AxisBasis positionBasis(const GapData& data, Columns& columns, bool contrasts)
{
  const Eigen::MatrixXd& u = data.simulated;
  const Eigen::VectorXd& x = data.scene.fieldX();
  const Eigen::VectorXd& y = data.scene.fieldY();
  columns.add([&](Eigen::Index k, Eigen::Index i) { return u(k, i) * x[i]; });
  columns.add([&](Eigen::Index k, Eigen::Index i) { return u(k, i) * y[i]; });
  const double middle = contrasts ? (x.array().square() + y.array().square()).mean() : 0.0;
  columns.add(
    [&](Eigen::Index k, Eigen::Index i) { return u(k, i) * (x[i] * x[i] + y[i] * y[i] - middle); });
  columns.add(
    [&](Eigen::Index k, Eigen::Index i) { return u(k, i) * (x[i] * x[i] - y[i] * y[i]); });
  columns.add([&](Eigen::Index k, Eigen::Index i) { return u(k, i) * x[i] * y[i]; });
  columns.add([&](Eigen::Index, Eigen::Index i) { return x[i]; });
  columns.add([&](Eigen::Index, Eigen::Index i) { return y[i]; });
  columns.add(
    [&](Eigen::Index k, Eigen::Index i)
    {
      double sum = 0.0;
      int count = 0;
      for (const int neighbour : data.scene.neighbours()[static_cast<std::size_t>(i)])
      {
        if (data.usable[static_cast<std::size_t>(neighbour)] != 0)
        {
          sum += u(k, neighbour);
          ++count;
        }
      }
      return count > 0 ? sum / count - u(k, i) : 0.0;
    });
  return columns.finish("position");
}

AxisBasis orderBasis(const GapData& data, Columns& columns, bool contrasts)
{
  const Eigen::MatrixXd& u = data.simulated;
  const double common = contrasts ? 1.0 : 0.0;
  const Eigen::ArrayXd t = data.scene.time().array() - 0.5 * common;
  const double square = t.square().mean() * common;
  columns.add([&](Eigen::Index k, Eigen::Index i) { return u(k, i) * t[i]; });
  columns.add([&](Eigen::Index k, Eigen::Index i) { return u(k, i) * (t[i] * t[i] - square); });
  columns.add([&](Eigen::Index, Eigen::Index i) { return t[i]; });
  for (int step = 1; step <= 4; ++step)
  {
    const double place = 0.2 * step;
    columns.add([&](Eigen::Index k, Eigen::Index i)
      { return u(k, i) * ((data.scene.time()[i] > place ? 1.0 : 0.0) - common * (1.0 - place)); });
  }
  columns.addEachChannel([&](Eigen::Index k, Eigen::Index i) { return u(k, i) * t[i]; }, true);
  return columns.finish("order");
}

AxisBasis shapeBasis(const GapData& data, Columns& columns)
{
  const Eigen::MatrixXd& u = data.simulated;
  const Eigen::MatrixXd slope = derivativeUnder(data, 1);
  const Eigen::MatrixXd curvature = derivativeUnder(data, 2);
  const Eigen::VectorXd mean = data.scene.reflectance().colwise().mean();
  const Eigen::Index last = data.channels() - 1;
  columns.addEachChannel([&](Eigen::Index k, Eigen::Index i) { return slope(k, i); }, false);
  columns.add([&](Eigen::Index k, Eigen::Index i) { return curvature(k, i); });
  columns.add([&](Eigen::Index k, Eigen::Index i) { return mean[i] - u(k, i); });
  columns.add([&](Eigen::Index k, Eigen::Index i)
    { return (k > 0 ? u(k - 1, i) - u(k, i) : 0.0) + (k < last ? u(k + 1, i) - u(k, i) : 0.0); });
  return columns.finish("spectral_shape");
}
}

std::vector<AxisBasis> axisBases(const GapData& data, bool contrasts)
{
  const Eigen::MatrixXd& u = data.simulated;
  Columns columns(data);
  std::vector<AxisBasis> bases;
  columns.addEachChannel([](Eigen::Index, Eigen::Index) { return 1.0; }, false);
  columns.addEachChannel([&](Eigen::Index k, Eigen::Index i) { return u(k, i); }, true);
  bases.push_back(columns.finish("channel"));
  const double upper = upperLevel(data);
  columns.add([&](Eigen::Index k, Eigen::Index i) { return u(k, i); });
  columns.add([&](Eigen::Index k, Eigen::Index i) { return u(k, i) * u(k, i); });
  columns.add([&](Eigen::Index k, Eigen::Index i) { return u(k, i) * u(k, i) * u(k, i); });
  columns.add([&](Eigen::Index k, Eigen::Index i) { return std::fmax(u(k, i) - upper, 0.0); });
  bases.push_back(columns.finish("level"));
  if (data.scene.media().size() > 1)
  {
    addGroups(columns, data.scene.medium(), data.scene.media().size(), u, contrasts);
    bases.push_back(columns.finish("medium"));
  }
  if (data.scene.scenes().size() > 1)
  {
    addGroups(columns, data.scene.scene(), data.scene.scenes().size(), u, contrasts);
    bases.push_back(columns.finish("scene"));
  }
  if (data.scene.hasPositions())
  {
    bases.push_back(positionBasis(data, columns, contrasts));
  }
  if (data.scene.hasOrder())
  {
    bases.push_back(orderBasis(data, columns, contrasts));
  }
  bases.push_back(shapeBasis(data, columns));
  return bases;
}

} // namespace msi
