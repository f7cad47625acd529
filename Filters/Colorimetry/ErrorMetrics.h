// The errors of estimated spectra: spectral rms, then CIEDE2000 under each illuminant.
#ifndef ErrorMetrics_h
#define ErrorMetrics_h

#include "SpectralAxis.h"

#include "Kernels/Colorimetry/CIELAB.h"
#include "Kernels/Colorimetry/TristimulusTransform.h"
#include "Kernels/Difference/CIEDE2000.h"

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
  ErrorMetrics(const SpectralAxis& bands, const std::vector<std::string>& illuminants,
    const std::string& observer, const CIEDE2000Factors& factors);

  // bands x samples each; the errors in the order of errorNames().
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
  std::vector<Color> Colors;
  CIEDE2000 Difference;
};

} // namespace msi

#endif
