#include "Kernels/Gap/Field/FieldBanding.h"

#include "Kernels/Camera/Angle.h"

#include <Eigen/Cholesky>

#include <algorithm>
#include <cmath>
#include <complex>

namespace msi
{

namespace
{
constexpr double LargestAmplitude = 0.45;
constexpr Eigen::Index Oversampling = 6;

// Sine and cosine of every harmonic.
Eigen::MatrixXd basisOf(Eigen::Index lines, double period)
{
  Eigen::MatrixXd basis(lines, 2 * BandingHarmonics);
  const Eigen::ArrayXd line = Eigen::ArrayXd::LinSpaced(lines, 0.0, static_cast<double>(lines - 1));
  for (Eigen::Index n = 0; n < BandingHarmonics; ++n)
  {
    const Eigen::ArrayXd angle = TwoPi * static_cast<double>(n + 1) / period * line;
    basis.col(2 * n) = angle.sin();
    basis.col(2 * n + 1) = angle.cos();
  }
  return basis;
}

// Energy of all channels at i / (Oversampling lines) cycles a line.
Eigen::ArrayXd spectrumOf(const Eigen::ArrayXXd& profile)
{
  const Eigen::Index lines = profile.rows();
  Eigen::ArrayXd energy = Eigen::ArrayXd::Zero(Oversampling * lines / 2 + 1);
  for (Eigen::Index i = 0; i < energy.size(); ++i)
  {
    const std::complex<double> turn =
      std::polar(1.0, TwoPi * static_cast<double>(i) / static_cast<double>(Oversampling * lines));
    std::complex<double> now = 1.0;
    Eigen::ArrayXcd sum = Eigen::ArrayXcd::Zero(profile.cols());
    for (Eigen::Index line = 0; line < lines; ++line, now *= turn)
    {
      sum += now * profile.row(line).transpose();
    }
    energy[i] = sum.abs2().sum();
  }
  return energy;
}

void setSine(BandingSines& sines, Eigen::Index channel, Eigen::Index n, double sine, double cosine)
{
  sines.amplitude(channel, n) = std::fmin(std::hypot(sine, cosine), LargestAmplitude);
  const double start = std::atan2(cosine, sine) / TwoPi;
  sines.start(channel, n) = start - std::floor(start);
}

BandingSines noSines(Eigen::Index channels, Eigen::Index harmonics)
{
  BandingSines sines;
  sines.amplitude.setZero(channels, harmonics);
  sines.start.setZero(channels, harmonics);
  return sines;
}
}

BandingSines nearestSines(const Eigen::ArrayXXd& profile)
{
  const Eigen::Index lines = profile.rows();
  BandingSines sines = noSines(profile.cols(), BandingHarmonics);
  const Eigen::ArrayXd energy = spectrumOf(profile);
  // Two cycles at least; harmonics beyond two pixels a cycle are those of another period.
  Eigen::Index best = 2 * Oversampling;
  double most = -1.0;
  for (Eigen::Index i = 2 * Oversampling; i < energy.size(); ++i)
  {
    double sum = 0.0;
    for (Eigen::Index n = 1; n <= BandingHarmonics && n * i < energy.size(); ++n)
    {
      sum += energy[n * i];
    }
    if (sum > most)
    {
      most = sum;
      best = i;
    }
  }
  sines.period = static_cast<double>(Oversampling * lines) /
    static_cast<double>(std::max<Eigen::Index>(best, 1));
  sines.period = std::fmax(sines.period, 2.0);
  Eigen::MatrixXd basis = basisOf(lines, sines.period);
  Eigen::MatrixXd normal = basis.transpose() * basis;
  normal.diagonal().array() += 1e-6 * static_cast<double>(lines);
  double left = 0.0;
  for (Eigen::Index k = 0; k < profile.cols(); ++k)
  {
    const Eigen::VectorXd values = profile.col(k).matrix();
    const Eigen::VectorXd weight = normal.ldlt().solve(basis.transpose() * values);
    left += (values - basis * weight).squaredNorm();
    for (Eigen::Index n = 0; n < BandingHarmonics; ++n)
    {
      setSine(sines, k, n, weight[2 * n], weight[2 * n + 1]);
    }
  }
  sines.part = 1.0 - left / std::fmax(profile.square().sum(), 1e-30);
  return sines;
}

BandingSines bandingSines(const FieldChoice& choice, const FieldModel& model)
{
  using P = ImageParameter;
  const bool rows = isOfRows(choice);
  const Eigen::Index K = model[P::Gain].size();
  if (isProfile(choice))
  {
    const P strength = choice.terms.front().parameter;
    const FieldProfile& profile = *(rows ? model.rows : model.columns);
    const bool gain = strength == P::RowGain || strength == P::ColumnGain;
    return nearestSines(
      (gain ? profile.gain : profile.offset).back().rowwise() * model[strength].transpose());
  }
  BandingSines sines = noSines(K, 1);
  sines.period = rows ? model.rowPeriod : model.columnPeriod;
  for (Eigen::Index k = 0; k < K; ++k)
  {
    setSine(sines, k, 0, model.at(rows ? P::RowSine : P::ColumnSine, k),
      model.at(rows ? P::RowCosine : P::ColumnCosine, k));
  }
  return sines;
}

} // namespace msi
