#include "Kernels/Gap/Diagnosis/Decisions.h"
#include "Kernels/Gap/GapCells.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Gap/Samples/GapAxes.h"
#include "Kernels/Gap/Shrink.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <functional>
#include <sstream>

namespace msi
{

namespace
{
constexpr double Ridge = 1e-4; // of the mean square of a column

// Ridge regressions on any subset of columns, trained without one fold and tried on it.
class FoldedRegression
{
public:
  FoldedRegression(const GapData& data, const Eigen::MatrixXd& gap, const Eigen::MatrixXd& columns)
    : Data(data)
  {
    const Eigen::Index channels = data.channels();
    const auto folds = static_cast<std::size_t>(data.folds);
    Normal.resize(folds);
    Gradient.resize(folds);
    Energy.resize(folds);
    Rows.resize(folds);
    Target.resize(folds);
    Members.resize(folds);
    for (Eigen::Index i = 0; i < data.samples(); ++i)
    {
      const int fold = data.fold[static_cast<std::size_t>(i)];
      if (fold >= 0)
      {
        Members[static_cast<std::size_t>(fold)].push_back(i);
      }
    }
    for (std::size_t f = 0; f < folds; ++f)
    {
      const auto count = static_cast<Eigen::Index>(Members[f].size());
      Rows[f].resize(channels * count, columns.cols());
      Target[f].resize(channels * count);
      for (Eigen::Index m = 0; m < count; ++m)
      {
        const Eigen::Index i = Members[f][static_cast<std::size_t>(m)];
        const Eigen::ArrayXd measured = (data.count.col(i).array() > 0.0).cast<double>();
        Rows[f].middleRows(m * channels, channels) =
          measured.matrix().asDiagonal() * columns.middleRows(i * channels, channels);
        Target[f].segment(m * channels, channels) = measured * gap.col(i).array();
      }
      Normal[f] = Rows[f].transpose() * Rows[f];
      Gradient[f] = Rows[f].transpose() * Target[f];
      Energy[f] = Target[f].squaredNorm();
    }
    AllNormal = Eigen::MatrixXd::Zero(columns.cols(), columns.cols());
    AllGradient = Eigen::VectorXd::Zero(columns.cols());
    for (std::size_t f = 0; f < folds; ++f)
    {
      AllNormal += Normal[f];
      AllGradient += Gradient[f];
      AllEnergy += Energy[f];
    }
  }

  double energy() const noexcept { return AllEnergy; }

  // Held-out squared error with these columns.
  double heldOut(const std::vector<Eigen::Index>& chosen, Eigen::MatrixXd* residual = nullptr) const
  {
    double error = 0.0;
    const auto count = static_cast<Eigen::Index>(chosen.size());
    Eigen::MatrixXd normal(count, count);
    Eigen::MatrixXd left(count, count);
    Eigen::VectorXd gradient(count);
    Eigen::VectorXd leftGradient(count);
    for (std::size_t f = 0; f < Normal.size(); ++f)
    {
      for (Eigen::Index b = 0; b < count; ++b)
      {
        const Eigen::Index cb = chosen[static_cast<std::size_t>(b)];
        for (Eigen::Index a = 0; a < count; ++a)
        {
          const Eigen::Index ca = chosen[static_cast<std::size_t>(a)];
          left(a, b) = Normal[f](ca, cb);
          normal(a, b) = AllNormal(ca, cb) - left(a, b);
        }
        leftGradient[b] = Gradient[f][cb];
        gradient[b] = AllGradient[cb] - leftGradient[b];
        normal(b, b) += Ridge * AllNormal(cb, cb) + 1e-12;
      }
      const Eigen::VectorXd beta = normal.llt().solve(gradient);
      error += Energy[f] - 2.0 * beta.dot(leftGradient) + beta.dot(left * beta);
      if (residual != nullptr)
      {
        Eigen::VectorXd all = Eigen::VectorXd::Zero(AllGradient.size());
        for (Eigen::Index b = 0; b < count; ++b)
        {
          all[chosen[static_cast<std::size_t>(b)]] = beta[b];
        }
        const Eigen::VectorXd rest = Target[f] - Rows[f] * all;
        const Eigen::Index channels = Data.channels();
        for (std::size_t m = 0; m < Members[f].size(); ++m)
        {
          residual->col(Members[f][m]) =
            rest.segment(static_cast<Eigen::Index>(m) * channels, channels);
        }
      }
    }
    return error;
  }

private:
  const GapData& Data;
  std::vector<Eigen::MatrixXd> Normal, Rows;
  std::vector<Eigen::VectorXd> Gradient, Target;
  std::vector<double> Energy;
  std::vector<std::vector<Eigen::Index>> Members;
  Eigen::MatrixXd AllNormal;
  Eigen::VectorXd AllGradient;
  double AllEnergy = 0.0;
};

std::string part(const char* what, double value, double low, double high, int parts)
{
  const double width = (high - low) / parts;
  const double at = width > 0.0 ? std::floor((value - low) / width) : 0.0;
  const double cell = std::fmin(std::fmax(at, 0.0), parts - 1.0);
  return rangeText(what, low + cell * width, low + (cell + 1.0) * width);
}

using CellOf = std::function<std::string(Eigen::Index, Eigen::Index)>;

CellOf sampleCell()
{
  return [](Eigen::Index, Eigen::Index i)
  {
    std::ostringstream name;
    name << "sample " << i + 1;
    return name.str();
  };
}

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
      return part("x", x[i], x.minCoeff(), x.maxCoeff(), 3) + ", " +
        part("y", y[i], y.minCoeff(), y.maxCoeff(), 3);
    };
  }
  if (axis == "order")
  {
    const Eigen::VectorXd& order = scene.samples().order;
    return [&order](Eigen::Index, Eigen::Index i)
    { return part("order", order[i], order.minCoeff(), order.maxCoeff(), 5); };
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
    { return part("level", data.simulated(k, i), low, high, 5); };
  }
  return sampleCell();
}

// The cells of an axis with the largest shares of the gap's energy: channels, media, scenes, thirds of the field, fifths of
// level and order, samples.
std::vector<GapCell> worstCells(
  const GapData& data, const Eigen::MatrixXd& gap, const std::string& axis)
{
  const CellOf cell = cellOf(data, axis);
  const bool perElement = axis == "level" || axis == "channel" || axis == "spectral_shape";
  GapCells cells;
  for (Eigen::Index i = 0; i < data.samples(); ++i)
  {
    double sum = 0.0;
    for (Eigen::Index k = 0; data.usable[static_cast<std::size_t>(i)] != 0 && k < data.channels();
         ++k)
    {
      const double square = data.count(k, i) > 0.0 ? gap(k, i) * gap(k, i) : 0.0;
      sum += square;
      if (perElement)
      {
        cells.add(cell(k, i), square);
      }
    }
    if (!perElement && data.usable[static_cast<std::size_t>(i)] != 0)
    {
      cells.add(cell(0, i), sum);
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

// Energy that every subset of the axes predicts.
struct SubsetValues
{
  std::vector<std::string> names;
  std::vector<double> value;
  Eigen::MatrixXd residual; // of all axes together
  double energy = 0.0;
};

SubsetValues valuesOfSubsets(const GapData& data, const Eigen::MatrixXd& gap, bool contrasts)
{
  const std::vector<AxisBasis> bases = axisBases(data, contrasts);
  const std::size_t axes = bases.size();
  std::vector<Eigen::Index> first(axes + 1, 0);
  SubsetValues result;
  for (std::size_t a = 0; a < axes; ++a)
  {
    first[a + 1] = first[a] + bases[a].columns.cols();
    result.names.push_back(bases[a].axis);
  }
  Eigen::MatrixXd columns(gap.size(), first[axes]);
  for (std::size_t a = 0; a < axes; ++a)
  {
    columns.middleCols(first[a], bases[a].columns.cols()) = bases[a].columns;
  }
  const FoldedRegression regression(data, gap, columns);
  result.energy = regression.energy();
  result.residual = Eigen::MatrixXd::Zero(data.channels(), data.samples());
  const std::size_t subsets = std::size_t(1) << axes;
  result.value.push_back(0.0);
  for (std::size_t subset = 1; subset < subsets; ++subset)
  {
    std::vector<Eigen::Index> chosen;
    for (std::size_t a = 0; a < axes; ++a)
    {
      for (Eigen::Index c = first[a]; c < first[a + 1] && (subset >> a & 1U) != 0; ++c)
      {
        chosen.push_back(c);
      }
    }
    Eigen::MatrixXd* residual = subset + 1 == subsets ? &result.residual : nullptr;
    result.value.push_back(result.energy - regression.heldOut(chosen, residual));
  }
  return result;
}
}

AxisShares shareOverAxes(const GapData& data, const Eigen::MatrixXd& gap, bool withCells)
{
  SubsetValues found = valuesOfSubsets(data, gap, false);
  // The bits of channel and level, the first two axes.
  if (found.value[3] >= (1.0 - Decision::SmallPart) * found.value.back())
  {
    found = valuesOfSubsets(data, gap, true);
  }
  AxisShares shares;
  shares.heldOutResidual = std::move(found.residual);
  shares.predictable = std::fmax(found.value.back(), 0.0);
  const std::vector<double> shapley = shapleyValues(found.value, found.names.size());
  const double noise = ((data.count.array() > 0.0).cast<double>() * data.variance.array()).sum();
  const double beyond = std::fmax(found.energy - noise, 1e-300);
  double total = 0.0;
  for (std::size_t a = 0; a < found.names.size(); ++a)
  {
    shares.axes.push_back({ found.names[a], std::fmax(shapley[a] / beyond, 0.0), {} });
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
    if (withCells)
    {
      axis.worst = worstCells(data, gap, axis.axis);
    }
  }
  return shares;
}

} // namespace msi
