#include "Kernels/Gap/Field/FieldScene.h"

#include "Kernels/Gap/Field/FieldData.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr std::size_t MomentPixels = std::size_t(1) << 20;

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

Eigen::MatrixXd sceneMoments(const FieldPair& pair)
{
  const auto K = static_cast<Eigen::Index>(pair.channels.size());
  Eigen::MatrixXd sums = Eigen::MatrixXd::Zero(K, 6);
  Eigen::ArrayXd count = Eigen::ArrayXd::Zero(K);
  int step = 1;
  while (pair.pixels() / static_cast<std::size_t>(step * step) > MomentPixels)
  {
    ++step;
  }
  for (int y = 0; y < pair.extent.height; y += step)
  {
    for (int x = 0; x < pair.extent.width; x += step)
    {
      const double X = pair.fieldX(x);
      const double Y = pair.fieldY(y);
      const double R = X * X + Y * Y;
      Eigen::RowVectorXd basis(6);
      basis << 1.0, X, Y, R, X * R, Y * R;
      const float* u = pair.simulated + pair.index(x, y) * static_cast<std::size_t>(K);
      for (Eigen::Index k = 0; k < K; ++k)
      {
        if (std::isfinite(u[k]))
        {
          sums.row(k) += static_cast<double>(u[k]) * basis;
          count[k] += 1.0;
        }
      }
    }
  }
  return sums.array().colwise() / count.max(1.0);
}

namespace
{
Eigen::ArrayXd meanOf(const Eigen::MatrixXd& moments, const FieldModel& model)
{
  const double right = model.at(FieldParameter::GradientRight, 0);
  const double down = model.at(FieldParameter::GradientDown, 0);
  const double falloff = model.at(FieldParameter::Falloff, 0);
  Eigen::VectorXd factor(6);
  factor << 1.0, right, down, -falloff, -falloff * right, -falloff * down;
  return (moments * factor).array();
}
}

Eigen::ArrayXd sceneMean(const FieldPair& pair, const FieldModel& model)
{
  return meanOf(sceneMoments(pair), model);
}

Eigen::ArrayXd sceneMean(const FieldData& data, const FieldModel& model)
{
  return meanOf(data.moments, model);
}

std::vector<float> filledScene(const FieldPair& pair)
{
  const std::size_t K = pair.channels.size();
  if (!hasGaps(pair))
  {
    return {};
  }
  std::vector<float> filled(pair.simulated, pair.simulated + pair.pixels() * K);
  const Eigen::MatrixXd moments = sceneMoments(pair);
  for (int y = 0; y < pair.extent.height; ++y)
  {
    for (std::size_t k = 0; k < K; ++k)
    {
      fillRow(filled.data() + pair.index(0, y) * K + k, pair.extent.width, K,
        static_cast<float>(moments(static_cast<Eigen::Index>(k), 0)));
    }
  }
  return filled;
}

} // namespace msi
