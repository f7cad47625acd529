// The color differences that users quote: one record each, in one registry.
#pragma once

#include "Kernels/Difference/CIEDE2000.h"

#include <Eigen/Core>

#include <string>
#include <string_view>
#include <vector>

namespace msi
{

// The parametric factors of lightness, chroma and hue: kL, kC, kH of CIEDE2000 and CIE94, l and c of
// CMC(l:c). A difference is divided by them. Formulas without factors expect 1.
struct ColorDifferenceFactors
{
  double lightness = 1.0;
  double chroma = 1.0;
  double hue = 1.0;
};

// An immutable record.
struct ColorDifferenceFormula
{
  std::string_view name;   // "ciede2000": command line and properties
  std::string_view metric; // "dE00": columns and arrays
  std::string_view label;  // "CIEDE2000": menus and reports
  // Where the formula is published.
  std::string_view source;
  ColorDifferenceFactors factors; // the usual ones
  bool hasFactors;
  bool symmetric; // if not, the first color is the standard
  double (*difference)(
    const ColorDifferenceFactors& factors, const double* lab1, const double* lab2);
};

// ciede2000, cie94, cie94-textiles, cmc (2 : 1), din99, cie76, hyab. New ones are added at the end.
const std::vector<ColorDifferenceFormula>& colorDifferences();

// Throws std::invalid_argument, listing the known names, for any other name.
const ColorDifferenceFormula& colorDifferenceNamed(std::string_view name);

// One of the formulas, run on blocks of CIELAB colors, L* on 0..100.
//
// Shape:    3 x pairs; a color is a column.
// NaN:      a pair with a NaN gives NaN for itself and for no other.
// Bytes:    a pair's value does not depend on which other pairs stand in the block.
// Accuracy: CIEDE2000 as in CIEDE2000.h; the others relative error below 1e-11, float blocks computed in
//           double and rounded once.
// Range:    any finite color, also darker than black: what is estimated may be (DIN99, which has no value there, goes
//           on as its mirror image).
// Errors:   the constructor throws std::invalid_argument unless all factors are finite and positive, and
//           for a factor other than 1 of a formula that has none.
class ColorDifference
{
public:
  explicit ColorDifference(const ColorDifferenceFormula& formula);
  ColorDifference(const ColorDifferenceFormula& formula, const ColorDifferenceFactors& factors);

  // By name, where it has factors with or without them: "cie94", "cmc(1:1)" (lightness : chroma),
  // "ciede2000(2:1:1)" (lightness : chroma : hue). Throws std::invalid_argument.
  static ColorDifference named(std::string_view text);

  const ColorDifferenceFormula& formula() const noexcept { return *Formula; }
  const ColorDifferenceFactors& factors() const noexcept { return Factors; }
  // What a column of such differences is called: the formula's metric, with the factors where they are
  // not the usual ones: "dE00", "dECMC(1:1)".
  std::string metric() const;

  double operator()(const Eigen::Vector3d& lab1, const Eigen::Vector3d& lab2) const noexcept;

  // Block calls, for shapes already checked: three blocks of as many columns.
  void apply(const Eigen::Ref<const Eigen::Matrix3Xd>& lab1,
    const Eigen::Ref<const Eigen::Matrix3Xd>& lab2,
    Eigen::Ref<Eigen::VectorXd> difference) const noexcept;
  void apply(const Eigen::Ref<const Eigen::Matrix3Xf>& lab1,
    const Eigen::Ref<const Eigen::Matrix3Xf>& lab2,
    Eigen::Ref<Eigen::VectorXf> difference) const noexcept;

private:
  const ColorDifferenceFormula* Formula; // in the registry
  ColorDifferenceFactors Factors;
  CIEDE2000 Blocks; // with these factors; the other formulas take pair after pair
};

} // namespace msi
