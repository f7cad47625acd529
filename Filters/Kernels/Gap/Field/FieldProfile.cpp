#include "Kernels/Gap/Field/FieldProfile.h"

#include "Kernels/Gap/Field/FieldColumns.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr Eigen::Index DefectPart = 50; // one line of so many may be defect

void join(LineValues& lines, const LineValues& part, Eigen::Index first)
{
  lines.value.middleRows(first, part.value.rows()) += part.value;
  lines.weight.middleRows(first, part.value.rows()) += part.weight;
}

LineValues noLines(Eigen::Index lines, Eigen::Index channels)
{
  return { Eigen::ArrayXXd::Zero(lines, channels), Eigen::ArrayXXd::Zero(lines, channels) };
}

LineSums sumsOf(const FieldData& data, const FieldModel& model, const Eigen::ArrayXd& glare,
  const FieldBlock& block, bool alongRows, const Eigen::ArrayXd& limit)
{
  LineSums sums{ noLines(data.blockSize, data.channels()),
    noLines(data.blockSize, data.channels()) };
  FieldScratch scratch;
  for (Eigen::Index k = 0; k < data.channels(); ++k)
  {
    fieldColumns(data, model, glare, block, k, scratch);
    const auto u = scratch.columns.col(FieldColumn::of(ImageParameter::Gain));
    const auto r = scratch.columns.col(FieldColumn::residual());
    for (Eigen::Index n = 0; n < u.size(); ++n)
    {
      const int pixel = scratch.pixel[static_cast<std::size_t>(n)];
      const int line = alongRows ? pixel / data.blockSize : pixel % data.blockSize;
      const double size = std::fabs(r[n]);
      const double weight = limit.size() > 0 && size > limit[k] ? limit[k] / size : 1.0;
      sums.gain.value(line, k) += weight * u[n] * r[n];
      sums.gain.weight(line, k) += weight * u[n] * u[n];
      sums.offset.value(line, k) += weight * r[n];
      sums.offset.weight(line, k) += weight;
    }
  }
  return sums;
}

void cutDefects(Eigen::ArrayXXd& values)
{
  const Eigen::Index cut = values.rows() / DefectPart + 1;
  for (Eigen::Index k = 0; k < values.cols(); ++k)
  {
    std::vector<double> sizes;
    for (Eigen::Index line = 0; line < values.rows(); ++line)
    {
      sizes.push_back(std::fabs(values(line, k)));
    }
    const auto next = sizes.end() - 1 - std::min(cut, values.rows() - 1);
    std::nth_element(sizes.begin(), next, sizes.end());
    values.col(k) = values.col(k).max(-*next).min(*next);
  }
}

Eigen::ArrayXXd profileWithout(const std::vector<LineSums>& folds, std::size_t without,
  LineValues LineSums::*kind, bool keepTrend)
{
  LineValues lines = noLines((folds[0].*kind).value.rows(), (folds[0].*kind).value.cols());
  for (std::size_t fold = 0; fold < folds.size(); ++fold)
  {
    if (fold != without)
    {
      join(lines, folds[fold].*kind, 0);
    }
  }
  lines.value /= lines.weight.max(1e-12);
  detrend(lines, keepTrend ? 1 : 3);
  lines.value = (lines.weight > 0.0).select(lines.value, 0.0);
  cutDefects(lines.value);
  return lines.value;
}
}

std::vector<LineSums> lineSums(const FieldData& data, const FieldModel& model, bool alongRows,
  const Eigen::ArrayXd& limit, const FieldLoop& loop)
{
  const Eigen::Index lines = alongRows ? data.pair.extent.height : data.pair.extent.width;
  const Eigen::ArrayXd glare = sceneMean(data, model);
  std::vector<LineSums> parts(data.blocks.size());
  loop(static_cast<int>(data.blocks.size()),
    [&](int b)
    {
      const FieldBlock& block = data.blocks[static_cast<std::size_t>(b)];
      if (block.fold >= 0)
      {
        parts[static_cast<std::size_t>(b)] = sumsOf(data, model, glare, block, alongRows, limit);
      }
    });
  std::vector<LineSums> folds(
    FieldFolds, { noLines(lines, data.channels()), noLines(lines, data.channels()) });
  for (std::size_t b = 0; b < parts.size(); ++b)
  {
    const FieldBlock& block = data.blocks[b];
    if (block.fold >= 0)
    {
      const int first = alongRows ? block.window.y : block.window.x;
      LineSums& fold = folds[static_cast<std::size_t>(block.fold)];
      join(fold.gain, parts[b].gain, first);
      join(fold.offset, parts[b].offset, first);
    }
  }
  return folds;
}

void detrend(LineValues& lines, Eigen::Index terms)
{
  const Eigen::Index count = lines.value.rows();
  const Eigen::ArrayXd t = Eigen::ArrayXd::LinSpaced(count, -1.0, 1.0);
  Eigen::MatrixXd basis = Eigen::MatrixXd::Ones(count, terms);
  for (Eigen::Index power = 1; power < terms; ++power)
  {
    basis.col(power) = basis.col(power - 1).array() * t;
  }
  for (Eigen::Index k = 0; k < lines.value.cols(); ++k)
  {
    const Eigen::MatrixXd weighted = lines.weight.col(k).matrix().asDiagonal() * basis;
    const Eigen::MatrixXd normal = weighted.transpose() * basis;
    const Eigen::VectorXd right = weighted.transpose() * lines.value.col(k).matrix();
    lines.value.col(k) -= (basis * normal.ldlt().solve(right)).array();
  }
}

FieldProfile findProfile(const FieldData& data, const FieldModel& model, bool alongRows,
  bool keepTrend, const Eigen::ArrayXd& limit, const FieldLoop& loop)
{
  const std::vector<LineSums> folds = lineSums(data, model, alongRows, limit, loop);
  FieldProfile profile;
  for (std::size_t without = 0; without <= folds.size(); ++without)
  {
    profile.gain.push_back(profileWithout(folds, without, &LineSums::gain, keepTrend));
    profile.offset.push_back(profileWithout(folds, without, &LineSums::offset, keepTrend));
  }
  return profile;
}

} // namespace msi
