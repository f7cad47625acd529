#include "ErrorMetrics.h"

#include "Kernels/Difference/SpectralRms.h"

#include <algorithm>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
std::string knownMetrics()
{
  std::string known;
  for (const ColorDifferenceFormula& formula : colorDifferences())
  {
    known += std::string(formula.name) + ", ";
  }
  for (const SpectralMetric& metric : spectralMetrics())
  {
    known += std::string(metric.name) + ", ";
  }
  return known + MetamerismMetric;
}

// The metrics that were asked for, by kind.
struct AskedMetrics
{
  std::vector<const SpectralMetric*> spectral;
  std::vector<std::string> differences;
  bool metamerism = false;
};

AskedMetrics sorted(const std::vector<std::string>& metrics)
{
  AskedMetrics asked;
  const auto& formulas = colorDifferences();
  for (const auto& name : metrics)
  {
    const std::string plain = name.substr(0, name.find('('));
    if (const auto* metric = findSpectralMetric(name))
    {
      asked.spectral.push_back(metric);
    }
    else if (name == MetamerismMetric)
    {
      asked.metamerism = true;
    }
    else if (std::any_of(formulas.begin(), formulas.end(),
               [&plain](const auto& formula) { return formula.name == plain; }))
    {
      asked.differences.push_back(name);
    }
    else if (name != "rms")
    {
      throw std::invalid_argument(
        "there is no metric '" + name + "'; expected some of rms, " + knownMetrics());
    }
  }
  return asked;
}
}

std::vector<ErrorName> AskedErrors::names() const
{
  const AskedMetrics asked = sorted(metrics);
  std::vector<ErrorName> names;
  if (rms)
  {
    names.push_back({ "rms", "" });
  }
  for (const auto* metric : asked.spectral)
  {
    names.push_back({ std::string(metric->name), "" });
  }
  for (const auto& difference : asked.differences)
  {
    const std::string metric = ColorDifference::named(difference).metric();
    for (const auto& illuminant : illuminants)
    {
      names.push_back({ metric, illuminant });
    }
  }
  if (asked.metamerism && illuminants.size() < 2)
  {
    throw std::invalid_argument("the metric metamerism compares illuminants, and there is " +
      std::to_string(illuminants.size()) +
      "; expected the reference illuminant and at least one other one, like D65, A");
  }
  for (std::size_t i = 1; asked.metamerism && i < illuminants.size(); ++i)
  {
    names.push_back({ MetamerismMetric, illuminants[i] });
  }
  if (names.empty())
  {
    throw std::invalid_argument(
      "no error is asked for; expected rms, or a metric and an illuminant");
  }
  return names;
}

ErrorMetrics::ErrorMetrics(const SpectralAxis& bands, const AskedErrors& asked,
  const ViewingConditions& conditions, std::shared_ptr<const ReflectanceEstimator> estimator)
  : Bands(static_cast<Eigen::Index>(bands.size()))
  , Errors(asked.names().size())
  , Rms(asked.rms)
  , Estimator(std::move(estimator))
{
  if (!bands.wavelengths)
  {
    throw std::invalid_argument("the estimate has no wavelengths (field data 'Wavelength'); color "
                                "difference needs reflectance whose wavelengths are known");
  }
  AskedMetrics metrics = sorted(asked.metrics);
  Spectral = std::move(metrics.spectral);
  const ColorDifferenceFormula& ciede2000 = colorDifferences().front();
  for (const auto& name : metrics.differences)
  {
    Differences.push_back(name == ciede2000.name ? ColorDifference(ciede2000, asked.factors)
                                                 : ColorDifference::named(name));
  }
  for (const auto& name : asked.illuminants)
  {
    TristimulusTransform tristimulus(
      *bands.wavelengths, conditions.illuminant(name), conditions.observer());
    const CIELAB lab(tristimulus.whitePoint());
    Colors.push_back({ std::move(tristimulus), lab });
  }
  for (std::size_t i = 1; metrics.metamerism && i < asked.illuminants.size(); ++i)
  {
    Metamerism.emplace_back(*bands.wavelengths, conditions.illuminant(asked.illuminants[0]),
      conditions.illuminant(asked.illuminants[i]), conditions.observer());
  }
  const auto* affine = dynamic_cast<const AffineEstimator*>(Estimator.get());
  if (affine && !Rms && Spectral.empty() && Metamerism.empty())
  {
    for (const Color& color : Colors)
    {
      Direct.emplace_back(affine->transform(), color.tristimulus);
    }
    if (Differences.size() == 1 && Differences.front().formula().name == ciede2000.name)
    {
      const ColorDifferenceFactors& factors = Differences.front().factors();
      OneStep = CIEDE2000Factors{ factors.lightness, factors.chroma, factors.hue };
    }
  }
}

std::vector<Eigen::VectorXd> ErrorMetrics::operator()(
  const Eigen::MatrixXd& estimateOrResponse, const Eigen::MatrixXd& reference) const
{
  const Eigen::MatrixXd estimate =
    Estimator ? (*Estimator)(estimateOrResponse) : estimateOrResponse;
  std::vector<Eigen::VectorXd> errors(Errors, Eigen::VectorXd(estimate.cols()));
  auto error = errors.begin();
  if (Rms)
  {
    spectralRms(reference, estimate, *error++);
  }
  for (const auto* metric : Spectral)
  {
    metric->apply(reference, estimate, *error++);
  }
  std::vector<Eigen::Matrix3Xd> labs[2];
  for (const Color& color : Colors)
  {
    for (int side = 0; side < 2; ++side)
    {
      auto& lab = labs[side].emplace_back(color.tristimulus(side == 0 ? reference : estimate));
      color.lab.fromXYZ(lab, lab);
    }
  }
  for (const ColorDifference& difference : Differences)
  {
    for (std::size_t i = 0; i < Colors.size(); ++i)
    {
      difference.apply(labs[0][i], labs[1][i], *error++);
    }
  }
  for (const MetamerismIndex& index : Metamerism)
  {
    index.apply(reference, estimate, *error++);
  }
  return errors;
}

void ErrorMetrics::apply(const float* estimate, const float* reference, Eigen::Index pixels,
  const std::vector<float*>& errors) const noexcept
{
  constexpr Eigen::Index Block = 256;
  Eigen::Matrix<float, 3, Block> labs[2];
  Eigen::MatrixXd doubles[2];
  Eigen::VectorXd values(Block);
  const Eigen::Index inputs = Estimator ? Estimator->channels() : Bands;
  Eigen::MatrixXf estimated(Bands, Estimator && Direct.empty() ? Block : 0);
  for (Eigen::Index at = 0; at < pixels; at += Block)
  {
    const auto count = std::min(Block, pixels - at);
    const float* input = estimate + at * inputs;
    if (estimated.size() > 0)
    {
      Estimator->apply(input, estimated.data(), nullptr, count);
      input = estimated.data();
    }
    // With Direct the estimate stays without spectra.
    using Spectra = Eigen::Map<const Eigen::MatrixXf>;
    const Spectra blocks[] = { Spectra(reference + at * Bands, Bands, count),
      Spectra(Direct.empty() ? input : nullptr, Bands, Direct.empty() ? count : 0) };
    const auto out = [&](std::size_t error)
    { return Eigen::Map<Eigen::VectorXf>(errors[error] + at, count); };
    std::size_t error = 0;
    if (Rms)
    {
      spectralRms(blocks[0], blocks[1], out(error++));
    }
    if (!Spectral.empty() || !Metamerism.empty())
    {
      for (int side = 0; side < 2; ++side)
      {
        doubles[side] = blocks[side].cast<double>();
      }
    }
    for (const auto* metric : Spectral)
    {
      metric->apply(doubles[0], doubles[1], values.head(count));
      out(error++) = values.head(count).cast<float>();
    }
    for (std::size_t i = 0; i < Colors.size(); ++i)
    {
      if (OneStep)
      {
        auto lab = labs[0].leftCols(count);
        Colors[i].tristimulus.apply(blocks[0], lab);
        Colors[i].lab.fromXYZ(lab, lab);
        Direct[i].differences(*OneStep, input, lab.data(), errors[error + i] + at, count);
        continue;
      }
      for (int side = 0; side < 2; ++side)
      {
        auto lab = labs[side].leftCols(count);
        if (side == 1 && !Direct.empty())
        {
          Direct[i].lab(input, lab.data(), count);
          continue;
        }
        Colors[i].tristimulus.apply(blocks[side], lab);
        Colors[i].lab.fromXYZ(lab, lab);
      }
      for (std::size_t d = 0; d < Differences.size(); ++d)
      {
        Differences[d].apply(
          labs[0].leftCols(count), labs[1].leftCols(count), out(error + d * Colors.size() + i));
      }
    }
    error += Differences.size() * Colors.size();
    for (const MetamerismIndex& index : Metamerism)
    {
      index.apply(doubles[0], doubles[1], values.head(count));
      out(error++) = values.head(count).cast<float>();
    }
  }
}

} // namespace msi
