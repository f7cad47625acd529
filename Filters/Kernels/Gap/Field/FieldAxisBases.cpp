#include "Kernels/Gap/Field/FieldAxisBases.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <utility>

namespace msi
{

namespace
{
constexpr double Ridge = 1e-6;
}

std::vector<FieldAxis> fieldAxisBases(const FieldModel& model, bool gaps)
{
  std::vector<FieldAxis> axes = {
    { "channel", {}, { FieldColumn::Gain, FieldColumn::One } },
    { "level", { FieldColumn::Gain, FieldColumn::Square }, {} },
    { "position", {},
      { FieldColumn::GradientRight, FieldColumn::GradientDown, FieldColumn::RadiusSquared,
        FieldColumn::RadiusFourth, FieldColumn::Diagonal, FieldColumn::Saddle } },
    { "edges", {}, { FieldColumn::Right, FieldColumn::Down, FieldColumn::BlurVariance } },
  };
  for (int pass = 0; !gaps && pass < TailPasses; ++pass)
  {
    axes[3].own.push_back(FieldColumn::Tail + pass);
  }
  const auto stripes = [&](const char* name, bool sines, bool profile, FieldColumn::Index sine,
                         FieldColumn::Index gain)
  {
    std::vector<int> own;
    if (sines)
    {
      own = { sine, sine + 1 };
    }
    if (profile)
    {
      own.insert(own.end(), { gain, gain + 1 });
    }
    if (!own.empty())
    {
      axes.push_back({ name, {}, own });
    }
  };
  stripes("rows", model.rowPeriod > 0.0, model.rows != nullptr, FieldColumn::RowSine,
    FieldColumn::RowGain);
  stripes("columns", model.columnPeriod > 0.0, model.columns != nullptr, FieldColumn::ColumnSine,
    FieldColumn::ColumnGain);
  return axes;
}

std::vector<Eigen::MatrixXd> sumOfNormals(
  const FieldData& data, const FieldStatistics& statistics, bool training)
{
  std::vector<Eigen::MatrixXd> sum(static_cast<std::size_t>(data.channels()),
    Eigen::MatrixXd::Zero(FieldColumn::count(), FieldColumn::count()));
  for (std::size_t b = 0; b < data.blocks.size(); ++b)
  {
    for (std::size_t k = 0; (data.blocks[b].fold >= 0) == training && k < sum.size(); ++k)
    {
      sum[k] += statistics.at(b, static_cast<Eigen::Index>(k)).normal;
    }
  }
  return sum;
}

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
  std::vector<Eigen::VectorXd> change(
    normal.size(), Eigen::VectorXd::Zero(FieldColumn::residual()));
  // Eliminate the own columns, as in FieldFitter.
  const auto C = static_cast<Eigen::Index>(common.size());
  Eigen::MatrixXd H = Eigen::MatrixXd::Zero(C, C);
  Eigen::VectorXd g = Eigen::VectorXd::Zero(C);
  for (const Eigen::MatrixXd& N : normal)
  {
    H += part(N, common);
    g += Eigen::VectorXd(N.col(FieldColumn::residual()))(common);
  }
  H = ridged(H);
  std::vector<Eigen::MatrixXd> toCommon;
  std::vector<Eigen::VectorXd> alone;
  for (const Eigen::MatrixXd& N : normal)
  {
    Eigen::MatrixXd E = N(own, common);
    Eigen::VectorXd h = Eigen::VectorXd(N.col(FieldColumn::residual()))(own);
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
    normal[k].col(FieldColumn::residual()) -= gain[k] * along;
  }
  own.erase(std::remove(own.begin(), own.end(), int(FieldColumn::Gain)), own.end());
  change = regress(normal, {}, own);
  for (std::size_t k = 0; k < normal.size(); ++k)
  {
    change[k][FieldColumn::Gain] = gain[k];
  }
}

void centerPosition(std::vector<Eigen::MatrixXd>& training, std::vector<Eigen::MatrixXd>& test)
{
  for (std::size_t k = 0; k < training.size(); ++k)
  {
    Eigen::MatrixXd mix = Eigen::MatrixXd::Identity(FieldColumn::count(), FieldColumn::count());
    const double square = training[k](FieldColumn::Gain, FieldColumn::Gain);
    for (const int column :
      { FieldColumn::GradientRight, FieldColumn::GradientDown, FieldColumn::RadiusSquared,
        FieldColumn::RadiusFourth, FieldColumn::Diagonal, FieldColumn::Saddle })
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
    energy += N(FieldColumn::residual(), FieldColumn::residual()) -
      2.0 * change[k].dot(N.col(FieldColumn::residual()).head(FieldColumn::residual())) +
      change[k].dot(N.topLeftCorner(FieldColumn::residual(), FieldColumn::residual()) * change[k]);
  }
  return energy;
}

} // namespace msi
