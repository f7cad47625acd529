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
#include "Kernels/Estimation/ReflectanceEstimator.h"
#include "Kernels/Estimation/ResponseColor.h"

#include <Eigen/Core>

#include <memory>
#include <optional>
#include <string>
#include <vector>

namespace msi
{

// Which errors are computed.
struct AskedErrors
{
  // Names of color differences (Kernels/Difference/ColorDifference.h) and of spectral metrics (SpectralMetric.h), and
  // "metamerism": from the first illuminant to each other one.
  std::vector<std::string> metrics;
  std::vector<std::string> illuminants;
  ColorDifferenceFactors factors; // of CIEDE2000 where its name has none
  bool rms = true;                // the spectral rms, then always the first

  // In order: rms, the spectral metrics, the color differences under each illuminant, metamerism. Throws
  // std::invalid_argument for an unknown name, and where nothing is asked for.
  std::vector<ErrorName> names() const;
};

// Immutable. The constructor throws std::invalid_argument where the bands have no wavelengths, a name is not
// known, or a factor is not positive.
class ErrorMetrics
{
public:
  // With an estimator the estimates come as camera responses, and their reflectance is not kept; an affine one goes from
  // responses to color directly where nothing else is asked for (ResponseColor).
  ErrorMetrics(const SpectralAxis& bands, const AskedErrors& asked,
    const ViewingConditions& conditions,
    std::shared_ptr<const ReflectanceEstimator> estimator = nullptr);

  // bands x samples (estimates: channels x samples with an estimator); the errors in the order of AskedErrors.
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
  std::size_t Errors;
  bool Rms;
  std::shared_ptr<const ReflectanceEstimator> Estimator; // may be null
  std::vector<ResponseColor> Direct; // one per color where no reflectance is needed, else empty
  std::optional<CIEDE2000Factors> OneStep; // where that is the one difference of Direct
  std::vector<const SpectralMetric*> Spectral;
  std::vector<ColorDifference> Differences;
  std::vector<Color> Colors;
  std::vector<MetamerismIndex> Metamerism;
};

} // namespace msi

#endif
