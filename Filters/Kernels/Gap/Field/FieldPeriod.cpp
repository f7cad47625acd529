#include "Kernels/Gap/Field/FieldPeriod.h"

#include "Kernels/Camera/Angle.h"
#include "Kernels/Gap/Field/FieldProfile.h"

#include <algorithm>
#include <cmath>
#include <complex>

namespace msi
{

namespace
{
constexpr double FalseAlarm = 1e-3;
constexpr double PeriodOversampling = 6.0;
constexpr int Refinements = 40;
constexpr Eigen::Index FewestLines = 24;
const double ExponentialMedian = std::log(2.0);

// Weighted energy that a sine takes away, of each channel.
Eigen::ArrayXd powerAt(const LineValues& profile, double frequency)
{
  const Eigen::Index K = profile.value.cols();
  Eigen::ArrayXd cc = Eigen::ArrayXd::Zero(K);
  Eigen::ArrayXd cs = cc;
  Eigen::ArrayXd ss = cc;
  Eigen::ArrayXd cz = cc;
  Eigen::ArrayXd sz = cc;
  const std::complex<double> turn = std::polar(1.0, TwoPi * frequency);
  std::complex<double> now = 1.0;
  for (Eigen::Index line = 0; line < profile.value.rows(); ++line, now *= turn)
  {
    const double c = now.real();
    const double s = now.imag();
    for (Eigen::Index k = 0; k < K; ++k)
    {
      const double w = profile.weight(line, k);
      const double z = w * profile.value(line, k);
      cc[k] += w * c * c;
      cs[k] += w * c * s;
      ss[k] += w * s * s;
      cz[k] += z * c;
      sz[k] += z * s;
    }
  }
  const Eigen::ArrayXd determinant = (cc * ss - cs * cs).max(1e-300);
  return (ss * cz * cz - 2.0 * cs * cz * sz + cc * sz * sz) / determinant;
}

// Probability that the sum of `channels` exponential deviates of mean one exceeds x.
double gammaSurvival(double x, Eigen::Index channels)
{
  double logTerm = -x;
  double sum = 0.0;
  for (Eigen::Index i = 0; i < channels; ++i)
  {
    sum += std::exp(logTerm);
    logTerm += std::log(x) - std::log(static_cast<double>(i + 1));
  }
  return std::fmin(sum, 1.0);
}
}

FieldPeriod findPeriod(
  const FieldData& data, const FieldModel& model, bool alongRows, const FieldLoop& loop)
{
  LineValues profile;
  for (const LineSums& fold : lineSums(data, model, alongRows, Eigen::ArrayXd(), loop))
  {
    if (profile.value.size() == 0)
    {
      profile = fold.gain;
      continue;
    }
    profile.value += fold.gain.value;
    profile.weight += fold.gain.weight;
  }
  profile.value /= profile.weight.max(1e-12);
  const Eigen::Index lines = profile.value.rows();
  const Eigen::Index K = profile.value.cols();
  if (lines < FewestLines)
  {
    return {};
  }
  detrend(profile, 3);
  const double span = static_cast<double>(lines);
  const auto count = static_cast<int>(PeriodOversampling * (0.5 * span - 2.0)) + 1;
  const auto frequencyOf = [&](int i) { return (2.0 + i / PeriodOversampling) / span; };
  Eigen::ArrayXXd power(count, K);
  constexpr int Batch = 64;
  loop((count + Batch - 1) / Batch,
    [&](int batch)
    {
      for (int i = batch * Batch; i < std::min((batch + 1) * Batch, count); ++i)
      {
        power.row(i) = powerAt(profile, frequencyOf(i)).transpose();
      }
    });
  Eigen::ArrayXd scale(K);
  for (Eigen::Index k = 0; k < K; ++k)
  {
    std::vector<double> values(power.col(k).begin(), power.col(k).end());
    const auto middle = values.begin() + static_cast<std::ptrdiff_t>(values.size() / 2);
    std::nth_element(values.begin(), middle, values.end());
    scale[k] = std::fmax(*middle / ExponentialMedian, 1e-300);
  }
  const auto total = [&](double frequency) { return (powerAt(profile, frequency) / scale).sum(); };
  int best = 0;
  double most = -1.0;
  for (int i = 0; i < count; ++i)
  {
    const double value = (power.row(i).transpose() / scale).sum();
    if (value > most)
    {
      most = value;
      best = i;
    }
  }
  if (gammaSurvival(most, K) * span > FalseAlarm)
  {
    return {};
  }
  double low = frequencyOf(best) - 1.0 / (PeriodOversampling * span);
  double high = std::fmin(frequencyOf(best) + 1.0 / (PeriodOversampling * span), 0.5);
  for (int i = 0; i < Refinements; ++i)
  {
    const double a = low + (high - low) / 3.0;
    const double b = high - (high - low) / 3.0;
    (total(a) < total(b) ? low : high) = total(a) < total(b) ? a : b;
  }
  const double frequency = 0.5 * (low + high);
  // Cramer-Rao for a sine of this power in white noise: var f = 6 / (power (2 pi span)^2) x 2.
  const double error = std::sqrt(6.0 / std::fmax(total(frequency), 1e-9)) / (TwoPi * span);
  return { 1.0 / frequency, error / (frequency * frequency) };
}

} // namespace msi
