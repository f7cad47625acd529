#include "RealFaults.h"

#include <algorithm>
#include <cmath>

namespace withheld
{

namespace
{
constexpr double Width = 20.0;

double passband(double nm, double center, double width = Width)
{
  return std::exp2(-std::pow(2.0 * (nm - center) / width, 2));
}

Eigen::ArrayXd centered(const Eigen::VectorXd& place, double half)
{
  return (place.array() - 0.5 * (place.minCoeff() + place.maxCoeff())) / half;
}

double sign(Random& random)
{
  return chance(random, 0.5) ? 1.0 : -1.0;
}

Eigen::ArrayXd drawn(Random& random, Eigen::Index count, double spread)
{
  Eigen::ArrayXd values(count);
  for (double& value : values)
  {
    value = normal(random, spread);
  }
  return values;
}

using Answers = Eigen::MatrixXd;

RealFault eachSample(
  int stage, const std::string& kind, const std::function<Eigen::ArrayXd(double size)>& factor)
{
  return { stage, kind, [factor](const Answers& u, double size) -> Answers {
            return u.array().rowwise() * factor(size).transpose();
          } };
}

RealFault eachChannel(
  int stage, const std::string& kind, const std::function<Eigen::ArrayXd(double size)>& factor)
{
  return { stage, kind, [factor](const Answers& u, double size) -> Answers {
            return u.array().colwise() * factor(size);
          } };
}

RealFault onLight(const std::string& kind, const RealSite& site, bool rewhitened,
  const std::function<double(double nm, double center, double size)>& weight)
{
  return { 0, kind,
    [&site, rewhitened, weight](const Answers& u, double size) -> Answers
    {
      return u.array() *
        site.ratio([&weight, size](double nm, double center) { return weight(nm, center, size); },
          rewhitened);
    } };
}

RealFault onSurface(const std::string& kind, const RealSite& site, const std::string& medium,
  const std::function<Eigen::ArrayXd(
    const Eigen::ArrayXd& nm, const Eigen::ArrayXd& r, double size)>& surface)
{
  return { 0, kind,
    [&site, medium, surface](const Answers& u, double size) -> Answers
    {
      return u.array() *
        site.ratio(medium,
          [&surface, size](const Eigen::ArrayXd& nm, const Eigen::ArrayXd& r)
          { return surface(nm, r, size); });
    } };
}

RealFault eachValue(
  int stage, const std::string& kind, const std::function<double(double u, double size)>& curve)
{
  return { stage, kind, [curve](const Answers& u, double size) -> Answers {
            return u.unaryExpr([&curve, size](double value) { return curve(value, size); });
          } };
}

RealFault surfaceFault(const std::string& name, Random& random, const RealSite& site)
{
  const double s = sign(random);
  const double shape = uniform(random, 0.0, 1.0);
  const std::string medium =
    site
      .medium()[static_cast<std::size_t>(integer(random, 0, static_cast<int>(site.samples()) - 1))];
  using Array = Eigen::ArrayXd;
  if (name == "medium_gain")
  {
    return onSurface("geometry", site, medium,
      [s](const Array&, const Array& r, double size) -> Array
      { return r * std::exp2(0.08 * s * size); });
  }
  if (name == "specular_component")
  {
    return onSurface("gloss", site, medium,
      [s](const Array&, const Array& r, double size) -> Array
      { return r + 0.02 * s * size * (1.0 - 0.5 * r); });
  }
  if (name == "interreflection")
  {
    return onSurface("cavity", site, medium,
      [](const Array&, const Array& r, double size) -> Array
      {
        const double p = 1.0 - std::exp2(-0.2 * size);
        return r * (1.0 - p) / (1.0 - p * r);
      });
  }
  if (name == "translucency")
  {
    return onSurface("lateral loss", site, medium,
      [shape](const Array& nm, const Array& r, double size) -> Array
      {
        return r *
          (1.0 - 0.1 * size * r.pow(0.7 + 0.6 * shape) * (nm / 600.0).pow(1.0 + 2.0 * shape))
            .max(0.05);
      });
  }
  return onSurface("brightener", site, medium,
    [shape](const Array& nm, const Array& r, double size) -> Array
    {
      const Array z = (nm - 435.0 - 10.0 * shape) / 20.0;
      return r + 0.06 * size * r[10] * (-0.5 * z.square()).exp();
    });
}

RealFault opticsFault(const std::string& name, Random& random, const RealSite& site)
{
  const double s = sign(random);
  const bool again = chance(random, 0.6);
  if (name == "illuminant_drift")
  {
    const bool bent = chance(random, 0.4);
    return onLight(bent ? "broad band" : "color temperature", site, false,
      [s, bent](double nm, double center, double size)
      {
        const double x = (nm - 560.0) / 150.0;
        const double change = bent ? std::exp(-4.0 * x * x) : 560.0 / nm - 1.0;
        return passband(nm, center) * std::exp(0.15 * s * size * change);
      });
  }
  if (name == "filter_shift")
  {
    const double growth = chance(random, 0.5) ? uniform(random, 0.3, 1.0) : 0.0;
    return onLight(growth > 0.0 ? "oblique" : "constant", site, again,
      [s, growth](double nm, double center, double size)
      { return passband(nm, center + 2.0 * s * size * (1.0 - growth + growth * center / 550.0)); });
  }
  if (name == "filter_bandwidth")
  {
    return onLight("width", site, true,
      [s](double nm, double center, double size)
      { return passband(nm, center, Width * std::exp(1.2 * s * std::tanh(0.25 * size))); });
  }
  return onLight("blocking", site, again,
    [](double nm, double center, double size) { return passband(nm, center) + 0.001 * size; });
}

RealFault geometryFault(const std::string& name, Random& random, const RealSite& site)
{
  const double s = sign(random);
  if (name == "vignetting")
  {
    const double cx = normal(random, 0.1);
    const double cy = normal(random, 0.1);
    const double power = uniform(random, 1.0, 1.6);
    return eachSample(1, "falloff",
      [&site, cx, cy, power](double size) -> Eigen::ArrayXd
      {
        const Eigen::ArrayXd r2 = (site.x() - cx).square() + (site.y() - cy).square();
        return (-0.06 * size * r2.pow(power)).exp();
      });
  }
  if (name == "illumination_gradient")
  {
    const double angle = uniform(random, 0.0, 6.2832);
    return eachSample(1, "lamp to one side",
      [&site, angle](double size) -> Eigen::ArrayXd
      {
        const Eigen::ArrayXd along = site.x() * std::cos(angle) + site.y() * std::sin(angle);
        return (1.0 + 0.05 * size * (along + 0.06 * along.square())).max(0.05);
      });
  }
  if (name == "session_drift")
  {
    const int kind = integer(random, 0, 2);
    const double place = uniform(random, 0.25, 0.75);
    const char* kinds[] = { "slope", "step", "warming up" };
    return eachSample(2, kinds[kind],
      [&site, s, kind, place](double size) -> Eigen::ArrayXd
      {
        const Eigen::ArrayXd& t = site.time();
        Eigen::ArrayXd shape = t;
        if (kind == 1)
        {
          shape = (t > place).cast<double>();
        }
        else if (kind == 2)
        {
          shape = 1.0 - (-t / (0.6 * place)).exp();
        }
        return (0.06 * s * size * shape).exp();
      });
  }
  if (name == "veiling_glare")
  {
    return { 1, "haze", [](const Answers& u, double size) -> Answers {
              return u.colwise() + 0.03 * size * u.rowwise().mean();
            } };
  }
  return { 1, "inverse square of the distance",
    [&site](const Answers& u, double size) -> Answers
    {
      Answers mixed = u;
      for (Eigen::Index i = 0; i < u.cols(); ++i)
      {
        const Eigen::ArrayXd d2 =
          (site.x() - site.x()[i]).square() + (site.y() - site.y()[i]).square();
        Eigen::ArrayXd weight = 1.0 / d2.max(1e-12);
        weight[i] = 0.0;
        const double nearest = weight.maxCoeff();
        weight = (weight * 9.0 < nearest).select(0.0, weight);
        mixed.col(i) += 0.04 * size * (u * (weight / weight.sum()).matrix() - u.col(i));
      }
      return mixed;
    } };
}

RealFault detectorFault(const std::string& name, Random& random, const RealSite& site)
{
  const double s = sign(random);
  const Eigen::Index K = site.channels();
  if (name == "dark_offset")
  {
    const Eigen::ArrayXd spread = drawn(random, K, chance(random, 0.5) ? 0.4 : 0.0);
    return { 4, "dark", [s, spread](const Answers& u, double size) -> Answers {
              return u.colwise() + (0.01 * s * size * spread.exp()).matrix();
            } };
  }
  if (name == "exposure_gain")
  {
    return eachChannel(2, "shutter",
      [s, K](double size) -> Eigen::ArrayXd
      { return Eigen::ArrayXd::Constant(K, std::exp(0.05 * s * size)); });
  }
  if (name == "channel_gain")
  {
    const Eigen::ArrayXd spread = drawn(random, K, 1.0);
    return eachChannel(2, "independent",
      [spread](double size) -> Eigen::ArrayXd { return (0.05 * size * spread).exp(); });
  }
  if (name == "detector_nonlinearity")
  {
    const int kind = integer(random, 0, 2);
    const char* kinds[] = { "power", "parabola", "compression" };
    return eachValue(3, kinds[kind],
      [s, kind](double u, double size)
      {
        const double a = 0.1 * s * size;
        return kind == 0 ? std::copysign(std::pow(std::fabs(u), 1.0 + std::clamp(a, -0.9, 5.0)), u)
          : kind == 1    ? u + a * u * (0.9 - u)
                         : u * (1.0 + a) / std::max(1.0 + a * u, 0.1);
      });
  }
  if (name == "saturation")
  {
    return eachValue(
      5, "clip", [](double u, double size) { return std::min(u, 0.8 * std::exp(-0.1 * size)); });
  }
  if (name == "channel_crosstalk")
  {
    const double back = uniform(random, 0.0, 1.0);
    return { 2, "neighbours",
      [back](const Answers& u, double size) -> Answers
      {
        Answers mixed = u;
        const Eigen::Index last = u.rows() - 1;
        mixed.bottomRows(last) += 0.04 * size * (u.topRows(last) - u.bottomRows(last));
        mixed.topRows(last) += 0.04 * size * back * (u.bottomRows(last) - u.topRows(last));
        return mixed;
      } };
  }
  return { 6, "noise", [](const Answers& u, double) -> Answers { return u; } };
}
}

RealSite::RealSite(const RealSamples& real, std::vector<double> order)
  : Centers(real.channels)
  , Medium(real.medium)
{
  const double first = real.wavelengths.front();
  const double last = real.wavelengths.back();
  const double step = real.wavelengths[1] - first;
  Wavelengths = Eigen::ArrayXd::LinSpaced(static_cast<Eigen::Index>(last - first) + 1, first, last);
  Fine.resize(Wavelengths.size(), real.reflectance.cols());
  for (Eigen::Index j = 0; j < Wavelengths.size(); ++j)
  {
    const double place = (Wavelengths[j] - first) / step;
    const Eigen::Index low =
      std::min(static_cast<Eigen::Index>(place), real.reflectance.rows() - 2);
    const double part = place - static_cast<double>(low);
    Fine.row(j) = (1.0 - part) * real.reflectance.row(low) + part * real.reflectance.row(low + 1);
  }
  Seen = weights([](double nm, double center) { return passband(nm, center); }).matrix() * Fine;
  const double half =
    0.5 * std::max(real.x.maxCoeff() - real.x.minCoeff(), real.y.maxCoeff() - real.y.minCoeff());
  X = centered(real.x, half);
  Y = centered(real.y, half);
  Time = Eigen::Map<const Eigen::ArrayXd>(order.data(), static_cast<Eigen::Index>(order.size())) /
    static_cast<double>(order.size());
}

Eigen::ArrayXXd RealSite::weights(const Weight& weight) const
{
  Eigen::ArrayXXd rows(channels(), Wavelengths.size());
  for (Eigen::Index k = 0; k < rows.rows(); ++k)
  {
    for (Eigen::Index j = 0; j < rows.cols(); ++j)
    {
      rows(k, j) = weight(Wavelengths[j], Centers[static_cast<std::size_t>(k)]);
    }
  }
  return rows;
}

Eigen::ArrayXXd RealSite::ratio(const Weight& weight, bool rewhitened) const
{
  const Eigen::ArrayXXd changed = weights(weight);
  Eigen::ArrayXXd ratio = (changed.matrix() * Fine).array() / Seen.array();
  if (rewhitened)
  {
    const Eigen::ArrayXd before =
      weights([](double nm, double center) { return passband(nm, center); }).rowwise().sum();
    ratio.colwise() *= before / changed.rowwise().sum();
  }
  return ratio;
}

Eigen::ArrayXXd RealSite::ratio(const std::string& medium, const Surface& surface) const
{
  const Eigen::MatrixXd ideal =
    weights([](double nm, double center) { return passband(nm, center); }).matrix();
  Eigen::ArrayXXd ratio = Eigen::ArrayXXd::Ones(channels(), samples());
  for (Eigen::Index i = 0; i < samples(); ++i)
  {
    if (Medium[static_cast<std::size_t>(i)] == medium)
    {
      const Eigen::ArrayXd changed = surface(Wavelengths, Fine.col(i).array());
      ratio.col(i) = (ideal * changed.matrix()).array() / Seen.col(i).array();
    }
  }
  return ratio;
}

const std::vector<std::string>& realFaultNames()
{
  static const std::vector<std::string> names{ "dark_offset", "exposure_gain", "channel_gain",
    "illuminant_drift", "detector_nonlinearity", "saturation", "channel_crosstalk", "filter_shift",
    "filter_bandwidth", "filter_leak", "veiling_glare", "local_stray_light", "vignetting",
    "illumination_gradient", "session_drift", "medium_gain", "specular_component",
    "interreflection", "translucency", "fluorescence", "excess_noise" };
  return names;
}

const std::vector<std::string>& realStrangerNames()
{
  static const std::vector<std::string> names{ "filters that shift off the axis", "flicker",
    "couplings of each channel", "gains that come and go", "tilted samples" };
  return names;
}

RealFault drawRealFault(const std::string& name, Random& random, const RealSite& site)
{
  const auto among = [&name](std::initializer_list<const char*> names)
  { return std::find(names.begin(), names.end(), name) != names.end(); };
  if (among(
        { "medium_gain", "specular_component", "interreflection", "translucency", "fluorescence" }))
  {
    return surfaceFault(name, random, site);
  }
  if (among({ "illuminant_drift", "filter_shift", "filter_bandwidth", "filter_leak" }))
  {
    return opticsFault(name, random, site);
  }
  if (among({ "vignetting", "illumination_gradient", "session_drift", "veiling_glare",
        "local_stray_light" }))
  {
    return geometryFault(name, random, site);
  }
  return detectorFault(name, random, site);
}

RealFault drawRealStranger(const std::string& name, Random& random, const RealSite& site)
{
  const Eigen::Index K = site.channels();
  const Eigen::Index S = site.samples();
  if (name == "filters that shift off the axis")
  {
    // Interference filters let shorter waves pass under an angle.
    return { 0, name,
      [&site](const Answers& u, double size) -> Answers
      {
        const Eigen::ArrayXXd moved = site.ratio(
          [size](double nm, double center) { return passband(nm, center - 4.0 * size); }, true);
        const Eigen::ArrayXd r2 = site.x().square() + site.y().square();
        return u.array() * (1.0 + (moved - 1.0).rowwise() * r2.transpose());
      } };
  }
  if (name == "flicker")
  {
    const double cycles = uniform(random, 6.0, 12.0);
    return eachSample(2, name,
      [&site, cycles](double size) -> Eigen::ArrayXd
      { return 1.0 + 0.05 * size * (6.2832 * cycles * site.time()).sin(); });
  }
  if (name == "couplings of each channel")
  {
    // Each has a part of the next one in it, of either sign.
    const Eigen::ArrayXd part = drawn(random, K, 0.05);
    return { 3, name,
      [part](const Answers& u, double size) -> Answers
      {
        Answers changed = u;
        for (Eigen::Index k = 0; k < u.rows(); ++k)
        {
          changed.row(k) += size * part[k] * (u.row((k + 1) % u.rows()) - u.row(k));
        }
        return changed;
      } };
  }
  if (name == "tilted samples")
  {
    const Eigen::ArrayXd tilt = drawn(random, S, 0.05);
    return eachSample(
      1, name, [tilt](double size) -> Eigen::ArrayXd { return (size * tilt).exp(); });
  }
  // Channels of gains that change to and fro over the session.
  const Eigen::ArrayXd first = drawn(random, K, 0.05);
  const Eigen::ArrayXd second = drawn(random, K, 0.05);
  return { 2, name,
    [&site, first, second](const Answers& u, double size) -> Answers
    {
      Answers changed = u;
      for (Eigen::Index i = 0; i < u.cols(); ++i)
      {
        const bool early = std::fmod(site.time()[i] * 8.0, 2.0) < 1.0;
        changed.col(i).array() *= (size * (early ? first : second)).exp();
      }
      return changed;
    } };
}

} // namespace withheld
