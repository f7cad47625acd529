#include "Kernels/Gap/Field/FieldStatistics.h"

#include "Kernels/Gap/ReportParts.h"
#include "Kernels/Numerics/LeastSquares.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <map>

namespace msi
{

namespace
{
constexpr std::size_t ChannelAndLevel = 3; // their bits
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
  const auto ofSurround = [](int column)
  { return FieldColumn::stepOf(column).step->stage == ImageStage::Surround; };
  if (gaps)
  {
    std::vector<int>& edges = axes.back().own;
    edges.erase(std::remove_if(edges.begin(), edges.end(), ofSurround), edges.end());
  }
  for (const bool rows : { true, false })
  {
    if (model.stripes(rows).period > 0.0 || model.stripes(rows).profile != nullptr)
    {
      axes.push_back({ rows ? "rows" : "columns", {},
        FieldColumn::of(rows ? ImageAxis::Rows : ImageAxis::Columns) });
    }
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

// Least squares of columns common to all channels and of each channel's own; change of the columns, K. The numbers of a
// channel meet only each other and the common ones: they are eliminated channel by channel.
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
  std::vector<int> others = common;
  others.push_back(FieldColumn::residual());
  Eigen::MatrixXd reduced = Eigen::MatrixXd::Zero(C + 1, C + 1);
  for (const Eigen::MatrixXd& N : normal)
  {
    reduced += N(others, others);
  }
  reduced.topLeftCorner(C, C) = ridged(reduced.topLeftCorner(C, C));
  std::vector<Eigen::MatrixXd>
    byOthers; // the channel's numbers that go with the common ones, and the residual's
  for (const Eigen::MatrixXd& N : normal)
  {
    const Eigen::MatrixXd across = N(own, others);
    byOthers.emplace_back(ridged(N(own, own)).ldlt().solve(across));
    reduced -= across.transpose() * byOthers.back();
  }
  const Eigen::VectorXd shared = reduced.topLeftCorner(C, C).ldlt().solve(reduced.col(C).head(C));
  std::vector<Eigen::VectorXd> change;
  for (const Eigen::MatrixXd& mine : byOthers)
  {
    change.emplace_back(Eigen::VectorXd::Zero(FieldColumn::residual()));
    change.back()(own) = mine.col(C) - mine.leftCols(C) * shared;
    change.back()(common) = shared;
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

// Of each label, a row a channel: sum of what the columns leave, pixels, squared residual.
using LabelSums = std::map<int, Eigen::ArrayX3d>;

void add(LabelSums& all, int label, const Eigen::ArrayX3d& sums)
{
  all.try_emplace(label, Eigen::ArrayX3d::Zero(sums.rows(), 3)).first->second += sums;
}

LabelSums labelSums(const FieldData& data, const FieldBlock& block, const FieldModel& model,
  const Eigen::ArrayXd& glare, const std::vector<Eigen::VectorXd>& change)
{
  LabelSums all;
  const auto sum = [&](Eigen::Index k, const ChannelColumns& found)
  {
    const Eigen::VectorXd residual = found.columns.col(FieldColumn::residual());
    const Eigen::VectorXd left = residual -
      found.columns.leftCols(FieldColumn::residual()) * change[static_cast<std::size_t>(k)];
    for (Eigen::Index n = 0; n < left.size(); ++n)
    {
      const int pixel = found.pixel[static_cast<std::size_t>(n)];
      const int label = data.pair.labels[data.pair.index(
        block.window.x + pixel % block.window.width, block.window.y + pixel / block.window.width)];
      if (label != 0)
      {
        Eigen::ArrayX3d sums = Eigen::ArrayX3d::Zero(data.channels(), 3);
        sums.row(k) << left[n], 1.0, residual[n] * residual[n];
        add(all, label, sums);
      }
    }
  };
  forColumns(data, model, glare, block, everyStep(), sum);
  return all;
}

// What the means of labels in the training blocks predict of the test blocks, and where.
GapAxis sampleAxis(const FieldData& data, const FieldModel& model,
  const std::vector<Eigen::VectorXd>& change, double beyond, const FieldLoop& loop)
{
  const Eigen::ArrayXd glare = data.cells.mean(model);
  std::vector<LabelSums> ofBlock(data.blocks.size());
  loop(static_cast<int>(ofBlock.size()),
    [&](int b)
    {
      const auto block = static_cast<std::size_t>(b);
      ofBlock[block] = labelSums(data, data.blocks[block], model, glare, change);
    });
  LabelSums training;
  LabelSums test;
  for (std::size_t b = 0; b < ofBlock.size(); ++b)
  {
    for (const auto& [label, sums] : ofBlock[b])
    {
      add(data.blocks[b].fold >= 0 ? training : test, label, sums);
    }
  }
  double gained = 0.0;
  GapCells cells;
  for (const auto& [label, sums] : test)
  {
    cells.add(std::to_string(label), sums.col(2).sum());
    const auto known = training.find(label);
    if (known != training.end())
    {
      const Eigen::ArrayXd mean = known->second.col(0) / known->second.col(1).max(1.0);
      gained += (2.0 * mean * sums.col(0) - mean.square() * sums.col(1)).sum();
    }
  }
  return { "sample", gained / beyond, cells.worst() };
}

// What the means of the test blocks have beyond noise.
double regionEnergy(const FieldData& data, const FieldStatistics& statistics,
  const FieldStatistics& plain, const std::vector<Eigen::VectorXd>& change)
{
  double energy = 0.0;
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    for (std::size_t k = 0; data.blocks[b].fold < 0 && k < change.size(); ++k)
    {
      const auto channel = static_cast<Eigen::Index>(k);
      const Eigen::MatrixXd normal = plain.at(b, channel).normal();
      const double pixels = normal(FieldColumn::offset(), FieldColumn::offset());
      const double sum = normal(FieldColumn::offset(), FieldColumn::residual()) -
        normal.row(FieldColumn::offset()).head(FieldColumn::residual()).dot(change[k]);
      energy += pixels > 0.0 ? sum * sum / pixels - statistics.at(b, channel).noise / pixels : 0.0;
    }
  }
  return energy;
}

std::vector<GapCell> stripeCells(double period, const std::string& lines)
{
  return { { period > 0.0 ? textOf(2, "period ", period, ' ', lines) : lines + " without period",
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
  const double before = energyAfter(
    test, std::vector<Eigen::VectorXd>(K, Eigen::VectorXd::Zero(FieldColumn::residual())));
  double noise = 0.0;
  std::vector<std::pair<double, double>> level;
  std::vector<std::pair<double, double>> gradient;
  GapCells channel;
  GapCells position;
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    const ImageWindow& window = data.blocks[b].window;
    const double x = data.pair.fieldX(window.x + 0.5 * window.width);
    const double y = data.pair.fieldY(window.y + 0.5 * window.height);
    const std::string place =
      GapPart(x, -1.0, 1.0, 3).text("x", 2) + ", " + GapPart(y, -1.0, 1.0, 3).text("y", 2);
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
  std::vector<Eigen::VectorXd> change;
  const auto explained = [&](std::size_t subset)
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
    if ((subset & ChannelAndLevel) == 1)
    {
      takeCommonGain(training, own, change);
    }
    return (before - energyAfter(test, change)) / beyond;
  };
  const std::vector<double> share =
    shapleyOfAxes(axes.size(), explained, [&] { centerPosition(training, test); });
  // What the bases leave for labels and blocks, in the plain columns.
  training = sumOfNormals(data, plain, true);
  explained((std::size_t(1) << axes.size()) - 1);
  std::vector<GapAxis> found;
  for (std::size_t a = 0; a < axes.size(); ++a)
  {
    const std::string name = axes[a].name;
    const std::vector<GapCell> cells = name == "channel" ? channel.worst()
      : name == "level"                                  ? fifths(level, "level").worst()
      : name == "position"                               ? position.worst()
      : name == "edges" ? fifths(gradient, "change over two pixels").worst()
                        : stripeCells(plain.model.stripes(name == "rows").period, name);
    found.push_back({ name, share[a], cells });
  }
  // What goes with labels, or with blocks, of what is left.
  found.push_back(data.pair.labels != nullptr
      ? sampleAxis(data, statistics.model, change, beyond, loop)
      : GapAxis{
          "region", regionEnergy(data, statistics, plain, change) / beyond, position.worst() });
  found = worthNaming(std::move(found));
  for (GapAxis& axis : found)
  {
    axis.share = std::fmin(axis.share, 1.0);
  }
  return found;
}

} // namespace msi
