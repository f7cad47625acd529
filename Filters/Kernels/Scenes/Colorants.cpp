#include "Kernels/Scenes/Colorants.h"

#include <cmath>

namespace msi::scenes
{

Eigen::ArrayXd absorption(const Colorant& colorant, const WavelengthGrid& wavelengths)
{
  return wavelengths.vector().array().unaryExpr(
    [&colorant](double wavelength)
    {
      double sum = colorant.ground;
      for (const AbsorptionBand& band : colorant.bands)
      {
        // Distance on the wavenumber axis, scaled so that near the center it counts nanometres.
        const double distance = band.center * (1.0 - band.center / wavelength);
        const double t = distance / (distance < 0.0 ? band.shortSide : band.longSide);
        sum += band.height * std::exp(-0.5 * t * t);
      }
      return sum;
    });
}

const std::vector<Colorant>& paperInks()
{
  static const std::vector<Colorant> inks = {
    { "cyan", { { 1.00, 617, 34, 16 }, { 0.72, 690, 28, 30 }, { 0.35, 345, 30, 32 } }, 0.010 },
    { "magenta", { { 1.00, 565, 14, 12 }, { 0.90, 532, 22, 16 }, { 0.30, 385, 40, 40 } }, 0.008 },
    { "yellow", { { 1.00, 432, 45, 26 }, { 0.45, 380, 40, 30 } }, 0.004 },
    { "black", { { 0.20, 400, 60, 160 } }, 0.900 },
    { "orange", { { 1.00, 478, 48, 30 }, { 0.50, 400, 45, 40 } }, 0.006 },
    { "green", { { 1.00, 642, 40, 26 }, { 0.55, 700, 28, 30 }, { 0.55, 425, 45, 26 } }, 0.015 },
    { "violet", { { 1.00, 583, 20, 22 }, { 0.75, 543, 26, 18 }, { 0.15, 390, 30, 30 } }, 0.010 },
    { "red", { { 1.00, 535, 46, 24 }, { 0.55, 440, 55, 50 } }, 0.006 },
    { "ultramarine", { { 1.00, 598, 48, 40 }, { 0.10, 700, 40, 40 } }, 0.012 },
    { "earth", { { 1.00, 390, 60, 75 }, { 0.28, 530, 40, 45 } }, 0.060 },
  };
  return inks;
}

const std::vector<Colorant>& fabricDyes()
{
  static const std::vector<Colorant> dyes = {
    { "lemon", { { 1.00, 404, 34, 28 } }, 0.001 },
    { "golden yellow", { { 1.00, 421, 38, 34 }, { 0.20, 470, 20, 18 } }, 0.001 },
    { "orange", { { 1.00, 489, 38, 22 }, { 0.25, 390, 30, 28 } }, 0.001 },
    { "scarlet", { { 1.00, 506, 34, 24 }, { 0.35, 540, 14, 14 }, { 0.18, 375, 30, 30 } }, 0.001 },
    { "red", { { 1.00, 543, 15, 13 }, { 0.95, 514, 28, 15 }, { 0.15, 365, 30, 30 } }, 0.001 },
    { "bordeaux", { { 1.00, 553, 40, 26 }, { 0.20, 400, 40, 40 } }, 0.002 },
    { "violet", { { 1.00, 571, 30, 22 }, { 0.45, 535, 22, 18 } }, 0.002 },
    { "royal blue", { { 1.00, 594, 34, 22 }, { 0.80, 632, 22, 14 }, { 0.10, 365, 25, 25 } },
      0.001 },
    { "navy", { { 1.00, 601, 50, 34 }, { 0.12, 400, 40, 40 } }, 0.004 },
    { "turquoise", { { 1.00, 667, 18, 13 }, { 0.75, 624, 30, 18 }, { 0.32, 345, 30, 28 } }, 0.001 },
    { "olive", { { 0.80, 418, 45, 40 }, { 0.60, 612, 50, 36 } }, 0.004 },
  };
  return dyes;
}

Eigen::ArrayXd paperStock(const WavelengthGrid& wavelengths)
{
  // Coated paper without brightener: about 0.86 from 460 nm on, falling towards the violet.
  return 0.0055 + 0.12 * ((380.0 - wavelengths.vector().array()) / 22.0).exp();
}

Eigen::ArrayXd bleachedCotton(const WavelengthGrid& wavelengths)
{
  // Slightly yellow: the ground falls slowly with the wavelength.
  return 0.004 + 0.060 * ((380.0 - wavelengths.vector().array()) / 75.0).exp();
}

} // namespace msi::scenes
