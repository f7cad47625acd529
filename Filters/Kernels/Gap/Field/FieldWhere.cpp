#include "Kernels/Gap/Field/FieldStatistics.h"

#include "Kernels/Gap/Diagnosis/GapRegression.h"
#include "Kernels/Gap/ReportParts.h"

#include <algorithm>
#include <cmath>
#include <map>

namespace msi
{

namespace
{
AxisBasis basis(const char* name, unsigned axis)
{
  return { name, {}, fieldColumns().of(axis), fieldColumns().of(axis) };
}

// channel and level first, edges last. Where the surround is partly not simulated (gaps) it is no part of the edges.
std::vector<AxisBasis> fieldAxisBases(const FieldModel& model, bool gaps)
{
  std::vector<AxisBasis> axes = {
    { "channel", {}, fieldColumns().of(ImageAxis::Channel) },
    { "level", fieldColumns().of(ImageAxis::Level), {} },
    basis("position", ImageAxis::Position),
  };
  for (const bool rows : { true, false })
  {
    if (model.stripes(rows).period > 0.0 || model.stripes(rows).profile != nullptr)
    {
      axes.push_back(basis(rows ? "rows" : "columns", rows ? ImageAxis::Rows : ImageAxis::Columns));
    }
  }
  axes.push_back(basis("edges", ImageAxis::Edges));
  const auto ofSurround = [](int column)
  { return fieldColumns().step[column]->step->stage == ImageStage::Surround; };
  if (gaps)
  {
    std::vector<int>& edges = axes.back().own;
    edges.erase(std::remove_if(edges.begin(), edges.end(), ofSurround), edges.end());
    axes.back().cells = edges;
  }
  return axes;
}

std::vector<AxisSplit> splitOf(const FieldData& data, const FieldStatistics& statistics)
{
  const auto part = [&](bool training)
  {
    return statistics.normals(
      [&](std::size_t b) { return (data.blocks[b].fold >= 0) == training; });
  };
  return { { part(true), part(false) } };
}

// What the means of labels in the training blocks predict of the test blocks, and where.
GapAxis sampleAxis(const FieldData& data, const FieldModel& model,
  const std::vector<Eigen::VectorXd>& change, double beyond)
{
  // Of each label, a row a channel: sum of what the columns leave, pixels, squared residual.
  using LabelSums = std::map<int, Eigen::ArrayX3d>;
  const Eigen::ArrayX3d none = Eigen::ArrayX3d::Zero(data.channels(), 3);
  const Eigen::ArrayXd glare = data.cells.mean(model);
  std::vector<LabelSums> ofBlock(data.blocks.size());
  const auto measure = [&](int b)
  {
    const FieldBlock& block = data.blocks[b];
    const auto sum = [&](Eigen::Index k, const ChannelColumns& found)
    {
      const Eigen::VectorXd residual = found.residual();
      Eigen::VectorXd weight = Eigen::VectorXd::Zero(fieldColumns().count);
      weight.head(fieldColumns().residual) = change[k];
      const Eigen::VectorXd left = residual - found.columns * weight(found.there);
      for (Eigen::Index n = 0; n < left.size(); ++n)
      {
        const ImagePlace place = block.place(found.pixel[n]);
        if (const int label = data.pair.labels[data.pair.index(place.x, place.y)]; label != 0)
        {
          ofBlock[b].try_emplace(label, none).first->second.row(k) +=
            Eigen::Array3d(left[n], 1.0, residual[n] * residual[n]).transpose();
        }
      }
    };
    forColumns(data, model, glare, block, everyStep(), sum);
  };
  data.forBlocks(measure);
  LabelSums training;
  LabelSums test;
  for (std::size_t b = 0; b < ofBlock.size(); ++b)
  {
    for (const auto& [label, sums] : ofBlock[b])
    {
      (data.blocks[b].fold >= 0 ? training : test).try_emplace(label, none).first->second += sums;
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
      const Eigen::MatrixXd normal = plain.at(b, k).normal();
      const double pixels = normal(fieldColumns().offset, fieldColumns().offset);
      const double sum = normal(fieldColumns().offset, fieldColumns().residual) -
        normal.row(fieldColumns().offset).head(fieldColumns().residual).dot(change[k]);
      energy += pixels > 0.0 ? sum * sum / pixels - statistics.at(b, k).noise / pixels : 0.0;
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
  const FieldData& data, const FieldStatistics& statistics, const FieldModel* after)
{
  // Plain energies, so that shares are of the gap in response units.
  FieldStatistics plain = fieldStatistics(data, statistics.model, nullptr);
  std::vector<AxisBasis> axes = fieldAxisBases(statistics.model, !data.filled.empty());
  const std::vector<AxisSplit> splits = splitOf(data, plain);
  FieldModel moved = statistics.model;
  const auto isOfScene = [](ImageParameter parameter)
  { return stepOf(parameter).step->stage == ImageStage::Scene; };
  if (after != nullptr && moved.take(*after, isOfScene))
  {
    plain = fieldStatistics(data, moved, nullptr);
    axes.back().behind = splitOf(data, plain);
  }
  const PredictedEnergies energies = predictedEnergies(axes, splits, fieldColumns().gain);
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
    for (std::size_t k = 0; k < data.pair.channels.size(); ++k)
    {
      const BlockSums& sums = statistics.at(b, k);
      const double excess = sums.energy - sums.noise;
      noise += data.blocks[b].fold < 0 ? sums.noise : 0.0;
      channel.add(data.pair.channels[k], excess);
      position.add(place, excess);
      level.emplace_back(sums.level, excess);
      gradient.emplace_back(std::sqrt(sums.gradient), excess);
    }
  }
  const double beyond = energies.before - noise;
  if (!(beyond > 0.0))
  {
    return {};
  }
  const std::vector<Eigen::VectorXd>& change = energies.coefficients.front();
  std::vector<GapAxis> found;
  for (std::size_t a = 0; a < axes.size(); ++a)
  {
    const std::string& name = axes[a].axis;
    const std::vector<GapCell> cells = name == "channel" ? channel.worst()
      : name == "level"                                  ? fifths(level, "level").worst()
      : name == "position"                               ? position.worst()
      : name == "edges" ? fifths(gradient, "change over two pixels").worst()
                        : stripeCells(plain.model.stripes(name == "rows").period, name);
    found.push_back({ name, energies.axis[a] / beyond, cells });
  }
  // What goes with labels, or with blocks, of what is left.
  found.push_back(data.pair.labels != nullptr
      ? sampleAxis(data, moved, change, beyond)
      : GapAxis{
          "region", regionEnergy(data, statistics, plain, change) / beyond, position.worst() });
  return worthNaming(std::move(found));
}

} // namespace msi
