#include "Kernels/Gap/Field/FieldWhere.h"

#include "Kernels/Gap/Shapley.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <array>
#include <cmath>
#include <map>
#include <sstream>

namespace msi
{

namespace
{
constexpr int Columns = FieldColumn::Residual;
constexpr std::size_t CellsNamed = 5;
constexpr double LeastShare = 0.005;
constexpr double Ridge = 1e-6;
// Where channel and level alone predict this part of what all axes predict, position is asked only for contrasts.
constexpr double ContrastPart = 0.9;
constexpr std::size_t ChannelBit = 1;
constexpr std::size_t LevelBit = 2;

struct Axis
{
  const char* name;
  std::vector<int> common, own;
};

// Where the surround is partly not simulated it is no part of the edges.
std::vector<Axis> axesOf(const FieldModel& model, bool gaps)
{
  std::vector<Axis> axes = {
    { "channel", {}, { FieldColumn::Gain, FieldColumn::One } },
    { "level", { FieldColumn::Gain, FieldColumn::Square }, {} },
    { "position", {},
      { FieldColumn::GradientRight, FieldColumn::GradientDown, FieldColumn::RadiusSquared,
        FieldColumn::Diagonal, FieldColumn::Saddle } },
    { "edges", {}, { FieldColumn::Right, FieldColumn::Down, FieldColumn::BlurVariance } },
  };
  for (int pass = 0; !gaps && pass < TailPasses; ++pass)
  {
    axes[3].own.push_back(FieldColumn::Tail + pass);
  }
  if (model.rowPeriod > 0.0)
  {
    axes.push_back({ "rows", {}, { FieldColumn::RowSine, FieldColumn::RowCosine } });
  }
  if (model.columnPeriod > 0.0)
  {
    axes.push_back({ "columns", {}, { FieldColumn::ColumnSine, FieldColumn::ColumnCosine } });
  }
  return axes;
}

// The normal matrices of one part of the blocks, K.
std::vector<Eigen::MatrixXd> normals(
  const FieldData& data, const FieldStatistics& statistics, bool training)
{
  std::vector<Eigen::MatrixXd> sum(static_cast<std::size_t>(data.channels()),
    Eigen::MatrixXd::Zero(FieldColumn::Count, FieldColumn::Count));
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    for (std::size_t k = 0; (data.blocks[b].fold >= 0) == training && k < sum.size(); ++k)
    {
      sum[k] += statistics.at(b, static_cast<Eigen::Index>(k)).normal;
    }
  }
  return sum;
}

// Least squares of the common and the channels' own columns; change of the columns, K.
std::vector<Eigen::VectorXd> regress(const std::vector<Eigen::MatrixXd>& normal,
  const std::vector<int>& common, const std::vector<int>& own)
{
  const auto part = [](const Eigen::MatrixXd& matrix, const std::vector<int>& at)
  { return Eigen::MatrixXd(matrix(at, at)); };
  const auto ridged = [](Eigen::MatrixXd matrix)
  {
    matrix.diagonal() *= 1.0 + Ridge;
    matrix.diagonal().array() += 1e-12;
    return matrix;
  };
  std::vector<Eigen::VectorXd> change(normal.size(), Eigen::VectorXd::Zero(Columns));
  // Eliminate the own columns, as in FieldFitter.
  const auto C = static_cast<Eigen::Index>(common.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(C, C);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(C);
  for (const Eigen::MatrixXd& N : normal)
  {
    H += part(N, common);
    g += Eigen::VectorXd(N.col(Columns))(common);
  }
  H = ridged(H);
  std::vector<Eigen::MatrixXd> toCommon;
  std::vector<Eigen::VectorXd> alone;
  for (const Eigen::MatrixXd& N : normal)
  {
    Eigen::MatrixXd E = N(own, common);
    Eigen::VectorXd h = Eigen::VectorXd(N.col(Columns))(own);
    if (!own.empty())
    {
      const Eigen::LDLT<Eigen::MatrixXd> factor(ridged(part(N, own)));
      const Eigen::MatrixXd across = E;
      if (C > 0)
      {
        E = factor.solve(across);
      }
      h = factor.solve(h).eval();
      H -= across.transpose() * E;
      g -= across.transpose() * h;
    }
    toCommon.push_back(std::move(E));
    alone.push_back(std::move(h));
  }
  // Where the own columns hold the common ones nothing is left for these.
  Eigen::VectorXd together = g;
  if (C > 0)
  {
    H.diagonal().array() += 1e-9 * (1.0 + H.diagonal().array().abs().maxCoeff());
    together = H.ldlt().solve(g);
  }
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    const Eigen::VectorXd mine = alone[k] - toCommon[k] * together;
    for (std::size_t i = 0; i < own.size(); ++i)
    {
      change[k][own[i]] += mine[static_cast<Eigen::Index>(i)];
    }
    for (std::size_t i = 0; i < common.size(); ++i)
    {
      change[k][common[i]] += together[static_cast<Eigen::Index>(i)];
    }
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
    mean += columns[FieldColumn::Gain] / static_cast<double>(change.size());
  }
  std::vector<double> gain;
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    gain.push_back(change[k][FieldColumn::Gain] - mean);
    const Eigen::VectorXd along = normal[k].col(FieldColumn::Gain);
    normal[k].col(Columns) -= gain[k] * along;
  }
  own.erase(std::remove(own.begin(), own.end(), int(FieldColumn::Gain)), own.end());
  change = regress(normal, {}, own);
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    change[k][FieldColumn::Gain] = gain[k];
  }
}

// Leaves to the columns of the position only what differs over the field: takes off their part along u.
void centerPosition(std::vector<Eigen::MatrixXd>& training, std::vector<Eigen::MatrixXd>& test)
{
  for (std::size_t k = 0; k < training.size(); ++k)
  {
    Eigen::MatrixXd mix = Eigen::MatrixXd::Identity(FieldColumn::Count, FieldColumn::Count);
    const double square = training[k](FieldColumn::Gain, FieldColumn::Gain);
    for (const int column : { FieldColumn::GradientRight, FieldColumn::GradientDown,
           FieldColumn::RadiusSquared, FieldColumn::Diagonal, FieldColumn::Saddle })
    {
      mix(FieldColumn::Gain, column) =
        -training[k](FieldColumn::Gain, column) / std::fmax(square, 1e-12);
    }
    training[k] = mix.transpose() * training[k] * mix;
    test[k] = mix.transpose() * test[k] * mix;
  }
}

double energyLeft(
  const std::vector<Eigen::MatrixXd>& normal, const std::vector<Eigen::VectorXd>& change)
{
  double energy = 0.0;
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    const Eigen::MatrixXd& N = normal[k];
    energy += N(Columns, Columns) - 2.0 * change[k].dot(N.col(Columns).head(Columns)) +
      change[k].dot(N.topLeftCorner(Columns, Columns) * change[k]);
  }
  return energy;
}

// Energies of the residual, beyond noise, sorted into cells.
class Cells
{
public:
  void add(const std::string& cell, double energy)
  {
    Energy[cell] += energy;
    Total += energy;
  }
  std::vector<GapCell> worst() const
  {
    std::vector<GapCell> cells;
    for (const auto& [name, energy] : Energy)
    {
      if (energy > 0.0 && Total > 0.0)
      {
        cells.push_back({ name, std::fmin(energy / Total, 1.0) });
      }
    }
    std::stable_sort(cells.begin(), cells.end(),
      [](const GapCell& a, const GapCell& b) { return a.share > b.share; });
    cells.resize(std::min(cells.size(), CellsNamed));
    return cells;
  }

private:
  std::map<std::string, double> Energy;
  double Total = 0.0;
};

std::string third(double value, const char* axis)
{
  const char* range = value < -1.0 / 3.0 ? " -1..-0.33"
    : value < 1.0 / 3.0                  ? " -0.33..0.33"
                                         : " 0.33..1";
  return std::string(axis) + range;
}

std::string rounded(double value)
{
  std::ostringstream text;
  text.precision(2);
  text << value;
  return text.str();
}

// The block energies of the given numbers in five parts of equal size, from small to large.
Cells fifths(std::vector<std::pair<double, double>> valueAndEnergy, const std::string& name)
{
  Cells cells;
  std::stable_sort(valueAndEnergy.begin(), valueAndEnergy.end(),
    [](const auto& a, const auto& b) { return a.first < b.first; });
  const std::size_t n = valueAndEnergy.size();
  const bool alike = n < 5 || !(valueAndEnergy.front().first < valueAndEnergy.back().first);
  for (std::size_t part = 0; part < 5 && !alike; ++part)
  {
    const std::size_t first = part * n / 5;
    const std::size_t last = (part + 1) * n / 5;
    const std::string cell = name + " " + rounded(valueAndEnergy[first].first) + ".." +
      rounded(valueAndEnergy[last - 1].first);
    for (std::size_t i = first; i < last; ++i)
    {
      cells.add(cell, valueAndEnergy[i].second);
    }
  }
  return cells;
}

// Mean residual and pixels of each label and channel.
using LabelMeans = std::map<int, std::vector<std::array<double, 3>>>; // sum, pixels, energy

LabelMeans labelMeans(const FieldData& data, const FieldStatistics& statistics,
  const std::vector<Eigen::VectorXd>& change, bool training)
{
  LabelMeans means;
  const auto K = static_cast<std::size_t>(data.channels());
  const Eigen::ArrayXd glare = sceneMean(data, statistics.model);
  FieldScratch scratch;
  for (const FieldBlock& block : data.blocks)
  {
    for (std::size_t k = 0; (block.fold >= 0) == training && k < K; ++k)
    {
      fieldColumns(data, statistics.model, glare, block, static_cast<Eigen::Index>(k), scratch);
      const Eigen::VectorXd left =
        scratch.columns.col(Columns) - scratch.columns.leftCols(Columns) * change[k];
      for (Eigen::Index n = 0; n < left.size(); ++n)
      {
        const int pixel = scratch.pixel[static_cast<std::size_t>(n)];
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
        sums[k][2] += scratch.columns(n, Columns) * scratch.columns(n, Columns);
      }
    }
  }
  return means;
}
}

std::vector<GapAxis> fieldAxes(
  const FieldData& data, const FieldStatistics& statistics, const FieldLoop& loop)
{
  // Plain energies, so that shares are of the gap in response units.
  const FieldStatistics plain = fieldStatistics(data, statistics.model, nullptr, loop);
  auto training = normals(data, plain, true);
  auto test = normals(data, plain, false);
  const std::vector<Axis> axes = axesOf(statistics.model, !data.filled.empty());
  const auto K = static_cast<std::size_t>(data.channels());
  double before = 0.0;
  double noise = 0.0;
  for (std::size_t k = 0; k < K; ++k)
  {
    before += test[k](Columns, Columns);
  }
  std::vector<std::pair<double, double>> level;
  std::vector<std::pair<double, double>> gradient;
  Cells channel;
  Cells position;
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    const ImageWindow& window = data.blocks[b].window;
    const std::string place = third(data.pair.fieldX(window.x + 0.5 * window.width), "x") + ", " +
      third(data.pair.fieldY(window.y + 0.5 * window.height), "y");
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
  std::vector<Eigen::VectorXd> change(K, Eigen::VectorXd::Zero(Columns));
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
    explained[subset] = (before - energyLeft(test, change)) / beyond;
  };
  explain(ChannelBit | LevelBit);
  explain(subsets - 1);
  if (explained[ChannelBit | LevelBit] > ContrastPart * explained[subsets - 1])
  {
    centerPosition(training, test);
  }
  for (std::size_t subset = 1; subset < subsets; ++subset)
  {
    explain(subset);
  }
  const std::vector<double> share = shapleyValues(explained, axes.size());
  // What the bases leave for labels and blocks, in the plain columns.
  training = normals(data, plain, true);
  test = normals(data, plain, false);
  explain(subsets - 1);
  std::vector<GapAxis> found;
  for (std::size_t a = 0; a < axes.size(); ++a)
  {
    const std::string name = axes[a].name;
    const std::vector<GapCell> cells = name == "channel" ? channel.worst()
      : name == "level"                                  ? fifths(level, "level").worst()
      : name == "position"                               ? position.worst()
      : name == "edges" ? fifths(gradient, "change over two pixels").worst()
      : name == "rows"
      ? std::vector<GapCell>{ { "period " + rounded(plain.model.rowPeriod) + " rows", 1.0 } }
      : std::vector<GapCell>{ { "period " + rounded(plain.model.columnPeriod) + " columns", 1.0 } };
    found.push_back({ name, share[a], cells });
  }
  // What goes with labels, or with blocks, of what is left.
  if (data.pair.labels != nullptr)
  {
    const LabelMeans means = labelMeans(data, statistics, change, true);
    const LabelMeans others = labelMeans(data, statistics, change, false);
    double gained = 0.0;
    Cells cells;
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
        const Eigen::MatrixXd& N = plain.at(b, static_cast<Eigen::Index>(k)).normal;
        const double pixels = N(FieldColumn::One, FieldColumn::One);
        const double sum =
          N(FieldColumn::One, Columns) - N.row(FieldColumn::One).head(Columns).dot(change[k]);
        const BlockSums& sums = statistics.at(b, static_cast<Eigen::Index>(k));
        if (pixels > 0.0)
        {
          gained += sum * sum / pixels - sums.noise / pixels;
        }
      }
    }
    found.push_back({ "region", gained / beyond, position.worst() });
  }
  found.erase(std::remove_if(found.begin(), found.end(),
                [](const GapAxis& axis) { return !(axis.share > LeastShare); }),
    found.end());
  std::stable_sort(found.begin(), found.end(),
    [](const GapAxis& a, const GapAxis& b) { return a.share > b.share; });
  for (GapAxis& axis : found)
  {
    axis.share = std::fmin(axis.share, 1.0);
  }
  return found;
}

} // namespace msi
