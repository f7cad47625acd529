// The special metamerism index: change in illuminant.
#pragma once

#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"

#include <Eigen/Core>

namespace msi
{

// How far two spectra that match under the reference illuminant differ under the test illuminant, in
// CIELAB 1976 units.
//
// Source: CIE 15:2018, 9.2, with its multiplicative correction: the second spectrum's X, Y and Z under the
//         test illuminant are multiplied by the ratio of the first's to the second's under the reference
//         illuminant, so that what does not match there is left out of account.
// Shape:  bands x samples, one column a pair; the first spectrum is the standard.
// NaN:    a pair with a NaN, or whose second spectrum is black under the reference illuminant, gives NaN
//         for itself and for no other.
// Errors: those of TristimulusTransform.
class MetamerismIndex
{
public:
  MetamerismIndex(const WavelengthGrid& wavelengths, const Illuminant& reference,
    const Illuminant& test,
    const StandardObserver& observer = StandardObserver::cie1931TwoDegree());

  // For shapes already checked: as many bands as the grid has wavelengths, three blocks of as many columns.
  void apply(const Eigen::Ref<const Eigen::MatrixXd>& standard,
    const Eigen::Ref<const Eigen::MatrixXd>& sample, Eigen::Ref<Eigen::VectorXd> index) const;

private:
  TristimulusTransform Reference;
  TristimulusTransform Test;
  CIELAB Lab;
};

} // namespace msi
