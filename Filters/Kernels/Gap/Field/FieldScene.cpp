#include "Kernels/Gap/Field/FieldScene.h"

#include "Kernels/Gap/Field/FieldData.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr std::size_t MeanPixels = std::size_t(1) << 20;
constexpr int CellsPerSide = 64;

// A row of one channel: gaps become the mean of both sides, weighted by nearness.
void fillRow(float* row, int pixels, std::size_t step, float other)
{
  int last = -1;
  for (int x = 0; x <= pixels; ++x)
  {
    if (x < pixels && !std::isfinite(row[static_cast<std::size_t>(x) * step]))
    {
      continue;
    }
    for (int gap = last + 1; gap < x; ++gap)
    {
      const float left = last >= 0 ? row[static_cast<std::size_t>(last) * step] : 0.0F;
      const float right = x < pixels ? row[static_cast<std::size_t>(x) * step] : 0.0F;
      const auto part = static_cast<float>(gap - last) / static_cast<float>(x - last);
      row[static_cast<std::size_t>(gap) * step] = last < 0 && x == pixels ? other
        : last < 0                                                        ? right
        : x == pixels                                                     ? left
                      : left + part * (right - left);
    }
    last = x;
  }
}
}

bool hasGaps(const FieldPair& pair)
{
  const std::size_t count = pair.pixels() * pair.channels.size();
  return !std::all_of(
    pair.simulated, pair.simulated + count, [](float value) { return std::isfinite(value); });
}

SceneCells sceneCells(const FieldPair& pair)
{
  const auto K = static_cast<Eigen::Index>(pair.channels.size());
  constexpr Eigen::Index All = Eigen::Index{ CellsPerSide } * CellsPerSide;
  SceneCells cells{ Eigen::ArrayXXd::Zero(All, K), Eigen::ArrayXXd::Zero(All, K),
    Eigen::ArrayXXd::Zero(All, K) };
  Eigen::ArrayXd count = Eigen::ArrayXd::Zero(K);
  int step = 1;
  while (pair.pixels() / static_cast<std::size_t>(step * step) > MeanPixels)
  {
    ++step;
  }
  for (int y = 0; y < pair.extent.height; y += step)
  {
    const Eigen::Index row = Eigen::Index{ y } * CellsPerSide / pair.extent.height;
    for (int x = 0; x < pair.extent.width; x += step)
    {
      const Eigen::Index cell =
        row * CellsPerSide + Eigen::Index{ x } * CellsPerSide / pair.extent.width;
      const float* values = pair.simulated + pair.index(x, y) * static_cast<std::size_t>(K);
      for (Eigen::Index k = 0; k < K; ++k)
      {
        if (std::isfinite(values[k]))
        {
          const auto u = static_cast<double>(values[k]);
          cells.part(cell, k) += u;
          cells.x(cell, k) += u * pair.fieldX(x);
          cells.y(cell, k) += u * pair.fieldY(y);
          count[k] += 1.0;
        }
      }
    }
  }
  for (Eigen::Index k = 0; k < K; ++k)
  {
    for (Eigen::Index cell = 0; cell < All; ++cell)
    {
      double& part = cells.part(cell, k);
      const bool light = std::fabs(part) > 1e-12;
      cells.x(cell, k) = light ? cells.x(cell, k) / part : 0.0;
      cells.y(cell, k) = light ? cells.y(cell, k) / part : 0.0;
      part /= std::fmax(count[k], 1.0);
    }
  }
  return cells;
}

namespace
{
Eigen::ArrayXd meanOf(const SceneCells& cells, const FieldModel& model)
{
  const FieldFactor factor(model);
  Eigen::ArrayXd mean = Eigen::ArrayXd::Zero(cells.part.cols());
  for (Eigen::Index k = 0; k < mean.size(); ++k)
  {
    for (Eigen::Index cell = 0; cell < cells.part.rows(); ++cell)
    {
      mean[k] += cells.part(cell, k) * factor(cells.x(cell, k), cells.y(cell, k));
    }
  }
  return mean;
}
}

Eigen::ArrayXd sceneMean(const FieldPair& pair, const FieldModel& model)
{
  return meanOf(sceneCells(pair), model);
}

Eigen::ArrayXd sceneMean(const FieldData& data, const FieldModel& model)
{
  return meanOf(data.cells, model);
}

std::vector<float> filledScene(const FieldPair& pair)
{
  const std::size_t K = pair.channels.size();
  if (!hasGaps(pair))
  {
    return {};
  }
  std::vector<float> filled(pair.simulated, pair.simulated + pair.pixels() * K);
  const Eigen::ArrayXd mean = sceneMean(pair, FieldModel(static_cast<Eigen::Index>(K)));
  for (int y = 0; y < pair.extent.height; ++y)
  {
    for (std::size_t k = 0; k < K; ++k)
    {
      fillRow(filled.data() + pair.index(0, y) * K + k, pair.extent.width, K,
        static_cast<float>(mean[static_cast<Eigen::Index>(k)]));
    }
  }
  return filled;
}

} // namespace msi
