#include "Kernels/Difference/ColorDifference.h"

#include "Kernels/Difference/CIE76.h"
#include "Kernels/Difference/CIEDE2000.h"
#include "Kernels/Spectra/Reject.h"

#include <algorithm>
#include <charconv>
#include <cmath>
#include <sstream>
#include <stdexcept>
#include <utility>

namespace msi
{

namespace
{
constexpr double Pi = 3.14159265358979323846;

double ciede2000Of(const ColorDifferenceFactors& factors, const double* lab1, const double* lab2)
{
  const CIEDE2000 formula({ factors.lightness, factors.chroma, factors.hue });
  return formula(Eigen::Map<const Eigen::Vector3d>(lab1), Eigen::Map<const Eigen::Vector3d>(lab2));
}

double cie76Of(const ColorDifferenceFactors& /*factors*/, const double* lab1, const double* lab2)
{
  return deltaE76(Eigen::Map<const Eigen::Vector3d>(lab1), Eigen::Map<const Eigen::Vector3d>(lab2));
}

struct PolarDifference
{
  double lightness;
  double chroma;
  double hueSquared;
};

PolarDifference polarDifference(const double* lab1, const double* lab2)
{
  const double chroma1 = std::hypot(lab1[1], lab1[2]);
  const double chroma2 = std::hypot(lab2[1], lab2[2]);
  // 2 (C1 C2 - a1 a2 - b1 b2) without cancellation: (a1 b2 - a2 b1)^2 over half of the sum of both.
  const double dot = lab1[1] * lab2[1] + lab1[2] * lab2[2];
  const double cross = lab1[1] * lab2[2] - lab2[1] * lab1[2];
  const double product = chroma1 * chroma2;
  const double hueSquared =
    dot > 0.0 ? 2.0 * cross * cross / (product + dot) : 2.0 * (product - dot);
  return { lab2[0] - lab1[0], chroma2 - chroma1, hueSquared };
}

// k1, k2: 0.045, 0.015 for graphic arts, 0.048, 0.014 for textiles. The first color is the standard.
double cie94With(double k1, double k2, const ColorDifferenceFactors& factors, const double* lab1,
  const double* lab2)
{
  const PolarDifference d = polarDifference(lab1, lab2);
  const double chroma = std::hypot(lab1[1], lab1[2]);
  const double l = d.lightness / factors.lightness;
  const double c = d.chroma / (factors.chroma * (1.0 + k1 * chroma));
  const double weightH = factors.hue * (1.0 + k2 * chroma);
  return std::sqrt(l * l + c * c + d.hueSquared / (weightH * weightH));
}

double cie94Of(const ColorDifferenceFactors& factors, const double* lab1, const double* lab2)
{
  return cie94With(0.045, 0.015, factors, lab1, lab2);
}

double cie94TextilesOf(
  const ColorDifferenceFactors& factors, const double* lab1, const double* lab2)
{
  return cie94With(0.048, 0.014, factors, lab1, lab2);
}

double cmcOf(const ColorDifferenceFactors& factors, const double* lab1, const double* lab2)
{
  const PolarDifference d = polarDifference(lab1, lab2);
  const double lightness = lab1[0];
  const double chroma = std::hypot(lab1[1], lab1[2]);
  double hue = std::atan2(lab1[2], lab1[1]) * 180.0 / Pi;
  hue = hue < 0.0 ? hue + 360.0 : hue;
  const auto cosine = [](double degrees) { return std::cos(degrees * Pi / 180.0); };
  const double t = hue >= 164.0 && hue <= 345.0 ? 0.56 + std::abs(0.2 * cosine(hue + 168.0))
                                                : 0.36 + std::abs(0.4 * cosine(hue + 35.0));
  const double fourth = chroma * chroma * chroma * chroma;
  const double f = std::sqrt(fourth / (fourth + 1900.0));
  const double weightL =
    lightness < 16.0 ? 0.511 : 0.040975 * lightness / (1.0 + 0.01765 * lightness);
  const double weightC = 0.0638 * chroma / (1.0 + 0.0131 * chroma) + 0.638;
  const double weightH = factors.hue * weightC * (f * t + 1.0 - f);
  const double l = d.lightness / (factors.lightness * weightL);
  const double c = d.chroma / (factors.chroma * weightC);
  return std::sqrt(l * l + c * c + d.hueSquared / (weightH * weightH));
}

// DIN99 is defined from black upwards. Below, where estimates lie that are darker than black, its mirror image goes on.
double din99Lightness(double l1, double l2)
{
  constexpr double Scale = 105.509;
  constexpr double Step = 0.0158;
  const double a = std::abs(l1);
  const double b = std::abs(l2);
  if ((l1 < 0.0) != (l2 < 0.0))
  {
    return Scale * (std::log1p(Step * a) + std::log1p(Step * b));
  }
  return Scale * std::log1p(Step * std::abs(b - a) / (1.0 + Step * std::min(a, b)));
}

Eigen::Vector2d din99Chroma(const double* lab)
{
  constexpr double Turn = 16.0 * Pi / 180.0;
  const double e = lab[1] * std::cos(Turn) + lab[2] * std::sin(Turn);
  const double f = 0.7 * (lab[2] * std::cos(Turn) - lab[1] * std::sin(Turn));
  const double g = std::hypot(e, f);
  const double scale = g > 0.0 ? std::log1p(0.045 * g) / (0.045 * g) : 1.0;
  return { scale * e, scale * f };
}

double din99Of(const ColorDifferenceFactors& /*factors*/, const double* lab1, const double* lab2)
{
  const double lightness = din99Lightness(lab1[0], lab2[0]);
  const Eigen::Vector2d apart = din99Chroma(lab2) - din99Chroma(lab1);
  return std::sqrt(lightness * lightness + apart.squaredNorm());
}

double hyabOf(const ColorDifferenceFactors& /*factors*/, const double* lab1, const double* lab2)
{
  return std::abs(lab2[0] - lab1[0]) + std::hypot(lab2[1] - lab1[1], lab2[2] - lab1[2]);
}

void requireFactor(const ColorDifferenceFormula& formula, double factor, const char* name)
{
  if (!std::isfinite(factor) || !(factor > 0.0))
  {
    reject("the ", name, " factor of ", formula.label, " is ", factor,
      "; expected a finite value above zero");
  }
  if (!formula.hasFactors && factor != 1.0)
  {
    reject("the ", name, " factor of ", formula.label, " is ", factor,
      "; this formula has no factors, expected 1");
  }
}

// "1:1" or "2:1:1"; the hue's factor is 1 where it is left out.
ColorDifferenceFactors factorsIn(std::string_view text, std::string_view whole)
{
  std::vector<double> numbers;
  bool good = !text.empty();
  while (good && !text.empty())
  {
    const std::string_view word = text.substr(0, text.find(':'));
    double value = 0.0;
    const auto [end, error] = std::from_chars(word.data(), word.data() + word.size(), value);
    good = error == std::errc() && end == word.data() + word.size();
    numbers.push_back(value);
    good = good && (word.size() == text.size() || word.size() + 1 < text.size());
    text.remove_prefix(std::min(word.size() + 1, text.size()));
  }
  if (!good || numbers.size() < 2 || numbers.size() > 3)
  {
    throw std::invalid_argument("the color difference '" + std::string(whole) +
      "' has no readable factors; expected lightness : chroma or lightness : chroma : hue, like "
      "cmc(1:1) or ciede2000(2:1:1)");
  }
  return { numbers[0], numbers[1], numbers.size() == 3 ? numbers[2] : 1.0 };
}

template <typename Scalar>
void applyFormula(const ColorDifferenceFormula& formula, const ColorDifferenceFactors& factors,
  const CIEDE2000& blocks, const Eigen::Ref<const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>& lab1,
  const Eigen::Ref<const Eigen::Matrix<Scalar, 3, Eigen::Dynamic>>& lab2,
  Eigen::Ref<Eigen::Matrix<Scalar, Eigen::Dynamic, 1>>& difference) noexcept
{
  if (formula.difference == ciede2000Of)
  {
    blocks.apply(lab1, lab2, difference);
    return;
  }
  for (Eigen::Index i = 0; i < difference.size(); ++i)
  {
    const Eigen::Vector3d first = lab1.col(i).template cast<double>();
    const Eigen::Vector3d second = lab2.col(i).template cast<double>();
    difference(i) = static_cast<Scalar>(formula.difference(factors, first.data(), second.data()));
  }
}
}

const std::vector<ColorDifferenceFormula>& colorDifferences()
{
  static const std::vector<ColorDifferenceFormula> formulas{
    { "ciede2000", "dE00", "CIEDE2000", "ISO/CIE 11664-6:2014", {}, true, true, ciede2000Of },
    { "cie94", "dE94", "CIE94", "CIE 116-1995", {}, true, false, cie94Of },
    { "cie94-textiles", "dE94t", "CIE94, textiles", "CIE 116-1995", { 2.0, 1.0, 1.0 }, true, false,
      cie94TextilesOf },
    { "cmc", "dECMC", "CMC(l:c)", "ISO 105-J03:2009", { 2.0, 1.0, 1.0 }, true, false, cmcOf },
    { "din99", "dE99", "DIN99", "ASTM D2244-07", {}, false, true, din99Of },
    { "cie76", "dEab", "CIELAB 1976", "ISO/CIE 11664-4:2019", {}, false, true, cie76Of },
    { "hyab", "dEHyAB", "HyAB", "Abasi, Amani Tehran and Fairchild, 2020, doi 10.1002/col.22451",
      {}, false, true, hyabOf }
  };
  return formulas;
}

const ColorDifferenceFormula& colorDifferenceNamed(std::string_view name)
{
  std::ostringstream message;
  message << "there is no color difference '" << name << "'; expected one of";
  const char* separator = " ";
  for (const ColorDifferenceFormula& formula : colorDifferences())
  {
    if (formula.name == name)
    {
      return formula;
    }
    message << std::exchange(separator, ", ") << formula.name;
  }
  throw std::invalid_argument(message.str());
}

ColorDifference ColorDifference::named(std::string_view text)
{
  const auto bracket = text.find('(');
  if (bracket == std::string_view::npos || text.back() != ')')
  {
    return ColorDifference(colorDifferenceNamed(text));
  }
  const auto inner = text.substr(bracket + 1, text.size() - bracket - 2);
  return ColorDifference(colorDifferenceNamed(text.substr(0, bracket)), factorsIn(inner, text));
}

std::string ColorDifference::metric() const
{
  const ColorDifferenceFactors& usual = Formula->factors;
  std::ostringstream text;
  text << Formula->metric;
  if (Factors.lightness != usual.lightness || Factors.chroma != usual.chroma ||
    Factors.hue != usual.hue)
  {
    text << '(' << Factors.lightness << ':' << Factors.chroma;
    if (Factors.hue != 1.0)
    {
      text << ':' << Factors.hue;
    }
    text << ')';
  }
  return text.str();
}

ColorDifference::ColorDifference(const ColorDifferenceFormula& formula)
  : ColorDifference(formula, formula.factors)
{
}

ColorDifference::ColorDifference(
  const ColorDifferenceFormula& formula, const ColorDifferenceFactors& factors)
  : Formula(&formula)
  , Factors(factors)
{
  requireFactor(formula, factors.lightness, "lightness");
  requireFactor(formula, factors.chroma, "chroma");
  requireFactor(formula, factors.hue, "hue");
  Blocks = CIEDE2000({ factors.lightness, factors.chroma, factors.hue });
}

double ColorDifference::operator()(
  const Eigen::Vector3d& lab1, const Eigen::Vector3d& lab2) const noexcept
{
  return Formula->difference(Factors, lab1.data(), lab2.data());
}

void ColorDifference::apply(const Eigen::Ref<const Eigen::Matrix3Xd>& lab1,
  const Eigen::Ref<const Eigen::Matrix3Xd>& lab2,
  Eigen::Ref<Eigen::VectorXd> difference) const noexcept
{
  applyFormula<double>(*Formula, Factors, Blocks, lab1, lab2, difference);
}

void ColorDifference::apply(const Eigen::Ref<const Eigen::Matrix3Xf>& lab1,
  const Eigen::Ref<const Eigen::Matrix3Xf>& lab2,
  Eigen::Ref<Eigen::VectorXf> difference) const noexcept
{
  applyFormula<float>(*Formula, Factors, Blocks, lab1, lab2, difference);
}

} // namespace msi
