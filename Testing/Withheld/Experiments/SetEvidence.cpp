#include "SetEvidence.h"

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Gap/ColumnProducts.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>

namespace withheld
{

namespace
{
constexpr double SmallGain = 0.003, SmallDark = 0.0003, SmallCenter = 0.3; // of every camera, nm
constexpr double Confidence = 20.0; // samples that the prior of Sigma counts for
constexpr double UsualWeight = 2.0; // numbers that the usual size of a learned variance counts for
constexpr int Rounds = 3;

double logDeterminant(const Eigen::LLT<Eigen::MatrixXd>& cholesky)
{
  return 2.0 * cholesky.matrixLLT().diagonal().array().log().sum();
}

bool hasEachChannel(const msi::EffectSet& set, const char* effect)
{
  return std::any_of(set.choices.begin(), set.choices.end(),
    [effect](const msi::EffectChoice& choice)
    { return choice.effect->name == effect && choice.form->name == "per_channel"; });
}
}

SetEvidence::SetEvidence(const msi::EffectFitter& fitter)
  : Fitter(fitter)
  , Root(Eigen::Map<const Eigen::ArrayXd>(fitter.weight().data(), fitter.weight().size()).sqrt())
{
  const msi::GapData& data = fitter.data();
  const msi::EffectDefinition& shift = msi::requireEffect("filter_shift");
  msi::EffectChoice choice;
  choice.effect = &shift;
  choice.form = &msi::requireForm(shift, "per_channel");
  msi::EffectSet set;
  set.add(choice, data.camera);
  CenterColumns = msi::jacobian(
    *msi::stagedResponse(data.camera, data.scene, set), set, set.freeParameters(data.camera));
}

Eigen::MatrixXd SetEvidence::whitened(const Eigen::MatrixXd& columns) const
{
  return Root.matrix().asDiagonal() * columns;
}

double SetEvidence::logOf(const msi::EffectFit& fit) const
{
  const msi::GapData& data = Fitter.data();
  const Eigen::Index K = data.channels();
  const Eigen::Index S = data.samples();
  const auto P = static_cast<Eigen::Index>(fit.free.size());

  // Columns, their priors and groups.
  std::vector<Group> groups;
  std::vector<double> spread;
  std::vector<double> offset; // of the prior's middle from the fit
  for (Eigen::Index p = 0; p < P; ++p)
  {
    const msi::FreeParameter& free = fit.free[static_cast<std::size_t>(p)];
    const bool learned = free.channel >= 0;
    if (p > 0 && learned && fit.free[static_cast<std::size_t>(p - 1)].group == free.group)
    {
      ++groups.back().count;
    }
    else
    {
      groups.push_back({ p, 1, learned ? free.scale : 0.0 });
    }
    spread.push_back(learned ? free.scale : free.spread);
    offset.push_back(free.neutral - msi::valueOf(fit.set, free));
  }
  Eigen::MatrixXd columns(data.observed.size(), P + 3 * K);
  columns.leftCols(P) = whitened(fit.jacobian);
  Eigen::Index next = P;
  const auto addChannels = [&](double usual, const Eigen::MatrixXd& values)
  {
    columns.middleCols(next, K) = whitened(values);
    groups.push_back({ next, K, usual });
    spread.insert(spread.end(), static_cast<std::size_t>(K), usual);
    offset.insert(offset.end(), static_cast<std::size_t>(K), 0.0);
    next += K;
  };
  Eigen::MatrixXd gains = Eigen::MatrixXd::Zero(data.observed.size(), K);
  Eigen::MatrixXd darks = gains;
  for (Eigen::Index i = 0; i < S; ++i)
  {
    for (Eigen::Index k = 0; k < K; ++k)
    {
      gains(i * K + k, k) = fit.predicted(k, i);
      darks(i * K + k, k) = 1.0;
    }
  }
  if (!hasEachChannel(fit.set, "channel_gain"))
  {
    addChannels(SmallGain, gains);
  }
  if (!hasEachChannel(fit.set, "dark_offset"))
  {
    addChannels(SmallDark, darks);
  }
  if (!hasEachChannel(fit.set, "filter_shift"))
  {
    addChannels(SmallCenter, CenterColumns);
  }
  columns.conservativeResize(Eigen::NoChange, next);
  const Eigen::VectorXd residual =
    (Root > 0.0)
      .select(Root *
          (Eigen::Map<const Eigen::ArrayXd>(data.observed.data(), data.observed.size()) -
            Eigen::Map<const Eigen::ArrayXd>(fit.predicted.data(), fit.predicted.size())),
        0.0);
  const Eigen::Map<const Eigen::VectorXd> middle(offset.data(), next);
  Eigen::ArrayXd precision =
    Eigen::Map<const Eigen::ArrayXd>(spread.data(), next).square().inverse();

  const double samples = Fitter.trainingSamples();
  Eigen::MatrixXd sigma = Eigen::MatrixXd::Identity(K, K);
  {
    const Eigen::Map<const Eigen::MatrixXd> left(residual.data(), K, S);
    sigma *= (Confidence + left.squaredNorm() / static_cast<double>(K)) / (Confidence + samples);
  }
  double log = 0.0;
  for (int round = 0; round < Rounds; ++round)
  {
    const Eigen::LLT<Eigen::MatrixXd> channel(sigma);
    Eigen::MatrixXd white = columns;
    Eigen::VectorXd left = residual;
    for (Eigen::Index i = 0; i < S; ++i)
    {
      channel.matrixL().solveInPlace(white.middleRows(i * K, K));
      channel.matrixL().solveInPlace(left.segment(i * K, K));
    }
    Eigen::MatrixXd normal = msi::columnProducts(white);
    normal.diagonal().array() += precision;
    const Eigen::LLT<Eigen::MatrixXd> solver(normal);
    const Eigen::VectorXd values =
      solver.solve(white.transpose() * left + (precision * middle.array()).matrix());
    const Eigen::VectorXd rest = residual - columns * values;
    const Eigen::Map<const Eigen::MatrixXd> errors(rest.data(), K, S);
    const Eigen::MatrixXd scatter = errors * errors.transpose();
    const Eigen::LLT<Eigen::MatrixXd> whole(Eigen::MatrixXd::Identity(K, K) + scatter / Confidence);
    const Eigen::ArrayXd departure = values - middle;
    log = -0.5 * (Confidence + samples) * logDeterminant(whole) -
      0.5 * (precision * departure.square()).sum() + 0.5 * precision.log().sum() -
      0.5 * logDeterminant(solver);
    for (const Group& group : groups)
    {
      if (group.usual > 0.0)
      {
        // Inverse gamma about the usual size.
        const double variance = 1.0 / precision[group.first];
        const double ratio = group.usual * group.usual / variance;
        log += 0.5 * UsualWeight * (std::log(ratio) + 1.0 - ratio);
      }
    }
    if (round + 1 == Rounds)
    {
      break;
    }
    sigma = (Confidence * Eigen::MatrixXd::Identity(K, K) + scatter) / (Confidence + samples);
    const Eigen::ArrayXd uncertainty =
      solver.solve(Eigen::MatrixXd::Identity(next, next)).diagonal().array();
    for (const Group& group : groups)
    {
      if (group.usual > 0.0)
      {
        const double energy = departure.segment(group.first, group.count).square().sum() +
          uncertainty.segment(group.first, group.count).sum();
        precision.segment(group.first, group.count) =
          (static_cast<double>(group.count) + UsualWeight) /
          (energy + UsualWeight * group.usual * group.usual);
      }
    }
  }
  return log;
}

} // namespace withheld
