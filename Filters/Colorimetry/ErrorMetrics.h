// The errors of estimated spectra: as spectra, and as colors under each illuminant.
#ifndef ErrorMetrics_h
#define ErrorMetrics_h

#include "NameList.h"
#include "SpectralAxis.h"
#include "ViewingConditions.h"

#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"
#include "Kernels/Difference/ColorDifference.h"
#include "Kernels/Difference/MetamerismIndex.h"
#include "Kernels/Difference/SpectralMetric.h"

#include <Eigen/Core>

#include <string>
#include <vector>

namespace msi
{

// Immutable. The constructor throws std::invalid_argument where the bands have no wavelengths, a name is not
// known, or a factor is not positive.
class ErrorMetrics
{
public:
  // metrics: names of color differences (Kernels/Difference/ColorDifference.h) and of spectral metrics
  // (SpectralMetric.h), and "metamerism": from the first illuminant to each other one. rms always comes first.
  // 'factors' are those of CIEDE2000 where its name has none.
  ErrorMetrics(const SpectralAxis& bands, const std::vector<std::string>& metrics,
    const std::vector<std::string>& illuminants, const ViewingConditions& conditions,
    const ColorDifferenceFactors& factors);

  // What metrics and illuminants ask for, in order: rms, the spectral metrics, the color differences under each
  // illuminant, metamerism. Throws as the constructor does.
  static std::vector<ErrorName> namesOf(
    const std::vector<std::string>& metrics, const std::vector<std::string>& illuminants);

  // bands x samples each; the errors in the order of namesOf().
  std::vector<Eigen::VectorXd> operator()(
    const Eigen::MatrixXd& estimate, const Eigen::MatrixXd& reference) const;

  // A block of pixels, one after the other; errors[i] has room for 'pixels' values.
  void apply(const float* estimate, const float* reference, Eigen::Index pixels,
    const std::vector<float*>& errors) const noexcept;

private:
  struct Color
  {
    TristimulusTransform tristimulus;
    CIELAB lab;
  };

  Eigen::Index Bands;
  std::vector<ErrorName> Names;
  std::vector<const SpectralMetric*> Spectral;
  std::vector<ColorDifference> Differences;
  std::vector<Color> Colors;
  std::vector<MetamerismIndex> Metamerism;
};

} // namespace msi

#endif
