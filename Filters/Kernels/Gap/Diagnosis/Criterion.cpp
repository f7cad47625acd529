#include "Kernels/Gap/Diagnosis/Criterion.h"

#include "Kernels/Gap/Diagnosis/Decisions.h"

#include <algorithm>
#include <cmath>
#include <limits>

namespace msi
{

namespace
{
// Whether every medium that its effect could have been blamed on has it.
bool isEverywhere(const GapOption& option, const std::vector<GapOption>& options,
  const std::vector<std::size_t>& set)
{
  return !option.medium.empty() &&
    std::all_of(options.begin(), options.end(),
      [&](const GapOption& other)
      {
        return other.effect != option.effect ||
          std::any_of(set.begin(), set.end(),
            [&](std::size_t mine) { return options[mine].sameCause(other); });
      });
}

bool isOfOnlyMedium(const GapOption& option, const std::vector<GapOption>& options)
{
  return std::all_of(options.begin(), options.end(),
    [&](const GapOption& other) { return other.medium.empty() || other.medium == option.medium; });
}
}

int signsOfStandIns(const std::vector<GapOption>& options, const std::vector<std::size_t>& set)
{
  int signs = 0;
  for (const std::size_t number : set)
  {
    signs +=
      (options[number].inDisguise ? 1 : 0) + (isEverywhere(options[number], options, set) ? 1 : 0);
  }
  return signs;
}

Eigen::ArrayXd energiesBesideGain(const Eigen::ArrayXd& response, const Eigen::ArrayXd& product,
  const Eigen::ArrayXd& gap, bool ofChannels)
{
  const auto large = [](double square, double both)
  {
    const double gain = both / std::fmax(square, 1e-30);
    const double beyond = std::fmax(std::fabs(gain) / Decision::SmallPart, 1.0);
    return gain * (1.0 - 1.0 / (beyond * beyond));
  };
  const Eigen::ArrayXd gain = ofChannels
    ? Eigen::ArrayXd(response.binaryExpr(product, large))
    : Eigen::ArrayXd::Constant(gap.size(), large(response.sum(), product.sum()));
  return gap - gain * (2.0 * product - gain * response);
}

double independentNumbers(double numbers, std::size_t groups, Eigen::Index channelNumbers)
{
  return std::fmax(std::fmin(static_cast<double>(groups), numbers),
    Decision::DiscrepancyPerChannel * static_cast<double>(channelNumbers));
}

Criterion::Criterion(
  const Observation& data, const ObservedFit& nominal, double numbers, double inexact)
  : Data(data)
  , Gap(std::fmax(nominal.energy - data.noiseEnergy(), 0.0))
  , Noise(std::fmin(data.noiseEnergy(), nominal.energy))
  // Above zero, so that two equal data sets give numbers, too.
  , Floor(std::fmax(Decision::FormPart * std::fmin(std::fmax(inexact - Noise, 0.0), Gap),
      std::numeric_limits<double>::epsilon() * std::fmax(data.noiseEnergy(), 1.0)))
  , Discrepancy(
      independentNumbers(numbers, data.energies(nominal).before.size(), data.channelNumbers()))
  , Reference(std::numeric_limits<double>::infinity())
{
  refer(nominal.energy, nominal.coherence);
}

void Criterion::refer(double energy, double coherence)
{
  if (!(energy < Reference))
  {
    return;
  }
  Reference = energy;
  const double noise = std::fmin(Noise, Reference) / std::fmax(Data.elements(), 1.0);
  const double left = std::fmax(Reference - Noise, 0.0) + Floor;
  Dispersion = coherence * noise + left / Discrepancy;
  Numbers = (Reference + Floor) / Dispersion;
}

double Criterion::operator()(const ObservedFit& fit) const
{
  if (!std::isfinite(fit.energy))
  {
    return -std::numeric_limits<double>::infinity();
  }
  const double likelihood = -0.5 * Numbers * std::log((fit.energy + Floor) / (Reference + Floor));
  return likelihood - occam(fit) - improbability(fit.set) - (fit.atBound ? Decision::StandIn : 0.0);
}

double Criterion::occam(const ObservedFit& fit) const
{
  return fit.prior.gain(fit.information / Dispersion) + fit.surprise;
}

double Criterion::improbability(const std::vector<std::size_t>& set) const
{
  const std::vector<GapOption>& options = Data.options();
  double sum = 0.0;
  for (const std::size_t number : set)
  {
    const GapOption& option = options[number];
    sum += option.improbability + (option.inDisguise ? Decision::StandIn : 0.0);
    if (isEverywhere(option, options, set))
    {
      // That the only medium has it is no coincidence of several.
      sum += isOfOnlyMedium(option, options) ? Decision::FormImprobability : Decision::StandIn;
    }
  }
  return sum;
}

} // namespace msi
