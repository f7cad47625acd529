#include "Kernels/Gap/Field/FieldScene.h"

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

SceneCells::SceneCells(const FieldPair& pair)
{
  const auto K = static_cast<Eigen::Index>(pair.channels.size());
  Part = X = Y = Eigen::ArrayXXd::Zero(Eigen::Index{ CellsPerSide } * CellsPerSide, K);
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
          Part(cell, k) += u;
          X(cell, k) += u * pair.fieldX(x);
          Y(cell, k) += u * pair.fieldY(y);
          count[k] += 1.0;
        }
      }
    }
  }
  const auto light = Part.abs() > 1e-12;
  X = light.select(X / Part, 0.0);
  Y = light.select(Y / Part, 0.0);
  Part.rowwise() /= count.max(1.0).transpose();
}

Eigen::ArrayXd SceneCells::mean(const FieldModel& model) const
{
  const FieldFactor factor(model);
  const Eigen::ArrayXXd factors =
    X.binaryExpr(Y, [&factor](double x, double y) { return factor(x, y); });
  return (Part * factors).colwise().sum().transpose();
}

std::vector<float> filledScene(const FieldPair& pair)
{
  const std::size_t K = pair.channels.size();
  if (!hasGaps(pair))
  {
    return {};
  }
  std::vector<float> filled(pair.simulated, pair.simulated + pair.pixels() * K);
  const Eigen::ArrayXd mean = SceneCells(pair).mean(FieldModel(static_cast<Eigen::Index>(K)));
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
