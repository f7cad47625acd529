#include "Kernels/Gap/Field/FieldWhere.h"

#include "Kernels/Gap/Field/FieldFit.h"
#include "Kernels/Gap/GapCells.h"
#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Gap/Shrink.h"

#include <algorithm>
#include <array>
#include <cmath>
#include <functional>
#include <map>

namespace msi
{

namespace
{
constexpr std::size_t ChannelBit = 1;
constexpr std::size_t LevelBit = 2;

constexpr double Ridge = 1e-6;

struct FieldAxis
{
  const char* name;
  std::vector<int> common, own; // columns: one coefficient for all channels, or one for each
};

// channel and level first. Where the surround is partly not simulated (gaps) it is no part of the edges.
std::vector<FieldAxis> fieldAxisBases(const FieldModel& model, bool gaps)
{
  std::vector<FieldAxis> axes = {
    { "channel", {}, FieldColumn::of(ImageAxis::Channel) },
    { "level", FieldColumn::of(ImageAxis::Level), {} },
    { "position", {}, FieldColumn::of(ImageAxis::Position) },
    { "edges", {}, FieldColumn::of(ImageAxis::Edges) },
  };
  for (const PlacedStep& step : imageSteps())
  {
    std::vector<int>& edges = axes.back().own;
    if (gaps && step.step->stage == ImageStage::Surround)
    {
      const auto first = static_cast<int>(step.column);
      const auto end = static_cast<int>(step.column + step.step->width());
      edges.erase(
        std::remove_if(edges.begin(), edges.end(), [&](int c) { return c >= first && c < end; }),
        edges.end());
    }
  }
  if (model.rowPeriod > 0.0 || model.rows != nullptr)
  {
    axes.push_back({ "rows", {}, FieldColumn::of(ImageAxis::Rows) });
  }
  if (model.columnPeriod > 0.0 || model.columns != nullptr)
  {
    axes.push_back({ "columns", {}, FieldColumn::of(ImageAxis::Columns) });
  }
  return axes;
}

// The normal matrices of one part of the blocks, K.
std::vector<Eigen::MatrixXd> sumOfNormals(
  const FieldData& data, const FieldStatistics& statistics, bool training)
{
  std::vector<Eigen::MatrixXd> sum(static_cast<std::size_t>(data.channels()),
    Eigen::MatrixXd::Zero(FieldColumn::count(), FieldColumn::count()));
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    for (std::size_t k = 0; (data.blocks[b].fold >= 0) == training && k < sum.size(); ++k)
    {
      sum[k] += statistics.at(b, static_cast<Eigen::Index>(k)).normal();
    }
  }
  return sum;
}

// Least squares of the common and the channels' own columns; change of the columns, K.
std::vector<Eigen::VectorXd> regress(const std::vector<Eigen::MatrixXd>& normal,
  const std::vector<int>& common, const std::vector<int>& own)
{
  const auto ridged = [](Eigen::MatrixXd matrix)
  {
    matrix.diagonal() *= 1.0 + Ridge;
    matrix.diagonal().array() += 1e-12;
    return matrix;
  };
  const auto C = static_cast<Eigen::Index>(common.size());
  ArrowEquations equations{ Eigen::MatrixXd::Zero(C, C), Eigen::VectorXd::Zero(C), {}, {}, {} };
  for (const Eigen::MatrixXd& N : normal)
  {
    const Eigen::VectorXd residual = N.col(FieldColumn::residual());
    equations.common += N(common, common);
    equations.gradient += residual(common);
    equations.own.push_back(ridged(N(own, own)));
    equations.ownGradient.emplace_back(residual(own));
    equations.across.emplace_back(N(own, common));
  }
  equations.common = ridged(equations.common);
  const ArrowSolution solution = solved(std::move(equations));
  std::vector<Eigen::VectorXd> change;
  for (const Eigen::VectorXd& mine : solution.own)
  {
    change.emplace_back(Eigen::VectorXd::Zero(FieldColumn::residual()));
    change.back()(own) += mine;
    change.back()(common) += solution.common;
  }
  return change;
}

// The common gain is the level's: takes it off the channels' and solves for the others again.
void takeCommonGain(
  std::vector<Eigen::MatrixXd> normal, std::vector<int> own, std::vector<Eigen::VectorXd>& change)
{
  double mean = 0.0;
  for (const Eigen::VectorXd& columns : change)
  {
    mean += columns[FieldColumn::gain()] / static_cast<double>(change.size());
  }
  std::vector<double> gain;
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    gain.push_back(change[k][FieldColumn::gain()] - mean);
    const Eigen::VectorXd along = normal[k].col(FieldColumn::gain());
    normal[k].col(FieldColumn::residual()) -= gain[k] * along;
  }
  own.erase(std::remove(own.begin(), own.end(), FieldColumn::gain()), own.end());
  change = regress(normal, {}, own);
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    change[k][FieldColumn::gain()] = gain[k];
  }
}

// Leaves to the columns of the position only what differs over the field: takes off their part along u.
void centerPosition(std::vector<Eigen::MatrixXd>& training, std::vector<Eigen::MatrixXd>& test)
{
  for (std::size_t k = 0; k < training.size(); ++k)
  {
    Eigen::MatrixXd mix = Eigen::MatrixXd::Identity(FieldColumn::count(), FieldColumn::count());
    const double square = training[k](FieldColumn::gain(), FieldColumn::gain());
    for (const int column : FieldColumn::of(ImageAxis::Position))
    {
      mix(FieldColumn::gain(), column) =
        -training[k](FieldColumn::gain(), column) / std::fmax(square, 1e-12);
    }
    training[k] = mix.transpose() * training[k] * mix;
    test[k] = mix.transpose() * test[k] * mix;
  }
}

double energyAfter(
  const std::vector<Eigen::MatrixXd>& normal, const std::vector<Eigen::VectorXd>& change)
{
  double energy = 0.0;
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    energy += energyLeft(normal[k], change[k]);
  }
  return energy;
}

// Mean residual and pixels of each label and channel.
using LabelMeans = std::map<int, std::vector<std::array<double, 3>>>; // sum, pixels, energy

LabelMeans labelMeans(const FieldData& data, const FieldModel& model,
  const std::vector<Eigen::VectorXd>& change, bool training, const FieldLoop& loop)
{
  const auto K = static_cast<std::size_t>(data.channels());
  const Eigen::ArrayXd glare = sceneMean(data, model);
  std::vector<LabelMeans> ofBlocks(data.blocks.size());
  const auto measure = [&](int b)
  {
    const FieldBlock& block = data.blocks[static_cast<std::size_t>(b)];
    if ((block.fold >= 0) != training)
    {
      return;
    }
    LabelMeans& means = ofBlocks[static_cast<std::size_t>(b)];
    const auto add = [&](Eigen::Index channel, const ChannelColumns& found)
    {
      const auto k = static_cast<std::size_t>(channel);
      const Eigen::VectorXd left = found.columns.col(FieldColumn::residual()) -
        found.columns.leftCols(FieldColumn::residual()) * change[k];
      for (Eigen::Index n = 0; n < left.size(); ++n)
      {
        const int pixel = found.pixel[static_cast<std::size_t>(n)];
        const int label =
          data.pair.labels[data.pair.index(block.window.x + pixel % block.window.width,
            block.window.y + pixel / block.window.width)];
        if (label == 0)
        {
          continue;
        }
        auto& sums = means[label];
        sums.resize(K, { 0.0, 0.0, 0.0 });
        sums[k][0] += left[n];
        sums[k][1] += 1.0;
        sums[k][2] +=
          found.columns(n, FieldColumn::residual()) * found.columns(n, FieldColumn::residual());
      }
    };
    forColumns(data, model, glare, block, everyStep(), add);
  };
  loop(static_cast<int>(data.blocks.size()), measure);
  LabelMeans all;
  for (const LabelMeans& means : ofBlocks)
  {
    for (const auto& [label, sums] : means)
    {
      auto& sum = all[label];
      sum.resize(K, { 0.0, 0.0, 0.0 });
      for (std::size_t k = 0; k < K; ++k)
      {
        std::transform(
          sums[k].begin(), sums[k].end(), sum[k].begin(), sum[k].begin(), std::plus<>());
      }
    }
  }
  return all;
}

std::vector<GapCell> stripeCells(double period, const std::string& lines)
{
  return { { period > 0.0 ? "period " + rounded(period) + " " + lines : lines + " without period",
    1.0 } };
}
}

std::vector<GapAxis> fieldAxes(
  const FieldData& data, const FieldStatistics& statistics, const FieldLoop& loop)
{
  // Plain energies, so that shares are of the gap in response units.
  const FieldStatistics plain = fieldStatistics(data, statistics.model, nullptr, loop);
  auto training = sumOfNormals(data, plain, true);
  auto test = sumOfNormals(data, plain, false);
  const std::vector<FieldAxis> axes = fieldAxisBases(statistics.model, !data.filled.empty());
  const auto K = static_cast<std::size_t>(data.channels());
  double before = 0.0;
  double noise = 0.0;
  for (std::size_t k = 0; k < K; ++k)
  {
    before += test[k](FieldColumn::residual(), FieldColumn::residual());
  }
  std::vector<std::pair<double, double>> level;
  std::vector<std::pair<double, double>> gradient;
  GapCells channel;
  GapCells position;
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    const ImageWindow& window = data.blocks[b].window;
    const std::string place = thirdOfField(data.pair.fieldX(window.x + 0.5 * window.width), "x") +
      ", " + thirdOfField(data.pair.fieldY(window.y + 0.5 * window.height), "y");
    for (std::size_t k = 0; k < K; ++k)
    {
      const BlockSums& sums = statistics.at(b, static_cast<Eigen::Index>(k));
      const double excess = sums.energy - sums.noise;
      noise += data.blocks[b].fold < 0 ? sums.noise : 0.0;
      channel.add(data.pair.channels[k], excess);
      position.add(place, excess);
      level.emplace_back(sums.level, excess);
      gradient.emplace_back(std::sqrt(sums.gradient), excess);
    }
  }
  const double beyond = before - noise;
  if (!(beyond > 0.0))
  {
    return {};
  }
  const std::size_t subsets = std::size_t(1) << axes.size();
  std::vector<double> explained(subsets, 0.0);
  std::vector<Eigen::VectorXd> change(K, Eigen::VectorXd::Zero(FieldColumn::residual()));
  const auto explain = [&](std::size_t subset)
  {
    std::vector<int> common;
    std::vector<int> own;
    for (std::size_t a = 0; a < axes.size(); ++a)
    {
      if ((subset >> a & 1U) != 0)
      {
        common.insert(common.end(), axes[a].common.begin(), axes[a].common.end());
        own.insert(own.end(), axes[a].own.begin(), axes[a].own.end());
      }
    }
    // What every channel has of its own needs no common one.
    common.erase(
      std::remove_if(common.begin(), common.end(),
        [&own](int column) { return std::find(own.begin(), own.end(), column) != own.end(); }),
      common.end());
    change = regress(training, common, own);
    if ((subset & (ChannelBit | LevelBit)) == ChannelBit)
    {
      takeCommonGain(training, own, change);
    }
    explained[subset] = (before - energyAfter(test, change)) / beyond;
  };
  explain(ChannelBit | LevelBit);
  explain(subsets - 1);
  if (explained[ChannelBit | LevelBit] > (1.0 - Decision::SmallPart) * explained[subsets - 1])
  {
    centerPosition(training, test);
  }
  for (std::size_t subset = 1; subset < subsets; ++subset)
  {
    explain(subset);
  }
  const std::vector<double> share = shapleyValues(explained, axes.size());
  // What the bases leave for labels and blocks, in the plain columns.
  training = sumOfNormals(data, plain, true);
  test = sumOfNormals(data, plain, false);
  explain(subsets - 1);
  std::vector<GapAxis> found;
  for (std::size_t a = 0; a < axes.size(); ++a)
  {
    const std::string name = axes[a].name;
    const std::vector<GapCell> cells = name == "channel" ? channel.worst()
      : name == "level"                                  ? fifths(level, "level").worst()
      : name == "position"                               ? position.worst()
      : name == "edges" ? fifths(gradient, "change over two pixels").worst()
      : name == "rows"  ? stripeCells(plain.model.rowPeriod, "rows")
                        : stripeCells(plain.model.columnPeriod, "columns");
    found.push_back({ name, share[a], cells });
  }
  // What goes with labels, or with blocks, of what is left.
  if (data.pair.labels != nullptr)
  {
    const LabelMeans means = labelMeans(data, statistics.model, change, true, loop);
    const LabelMeans others = labelMeans(data, statistics.model, change, false, loop);
    double gained = 0.0;
    GapCells cells;
    for (const auto& [label, sums] : others)
    {
      const auto mean = means.find(label);
      for (std::size_t k = 0; k < K; ++k)
      {
        const double n = sums[k][1];
        cells.add(std::to_string(label), sums[k][2]);
        if (mean != means.end() && mean->second[k][1] > 0.0)
        {
          const double m = mean->second[k][0] / mean->second[k][1];
          gained += 2.0 * m * sums[k][0] - m * m * n;
        }
      }
    }
    found.push_back({ "sample", gained / beyond, cells.worst() });
  }
  else
  {
    double gained = 0.0;
    for (std::size_t b = 0; b < data.blocks.size(); ++b)
    {
      for (std::size_t k = 0; data.blocks[b].fold < 0 && k < K; ++k)
      {
        const Eigen::MatrixXd& N = plain.at(b, static_cast<Eigen::Index>(k)).normal();
        const double pixels = N(FieldColumn::offset(), FieldColumn::offset());
        const double sum = N(FieldColumn::offset(), FieldColumn::residual()) -
          N.row(FieldColumn::offset()).head(FieldColumn::residual()).dot(change[k]);
        const BlockSums& sums = statistics.at(b, static_cast<Eigen::Index>(k));
        if (pixels > 0.0)
        {
          gained += sum * sum / pixels - sums.noise / pixels;
        }
      }
    }
    found.push_back({ "region", gained / beyond, position.worst() });
  }
  found = worthNaming(std::move(found));
  for (GapAxis& axis : found)
  {
    axis.share = std::fmin(axis.share, 1.0);
  }
  return found;
}

} // namespace msi
