// Reflectance of coloured layers from absorption and scattering.
#pragma once

#include <Eigen/Core>

namespace msi::scenes
{

// Reflectance of an opaque layer, R = 1 + q - sqrt(q^2 + 2 q) with q = K/S >= 0.
// Source: P. Kubelka, F. Munk, Z. Tech. Phys. 12 (1931) 593.
inline Eigen::ArrayXd opaqueReflectance(const Eigen::ArrayXd& absorptionToScattering)
{
  return 1.0 + absorptionToScattering -
    (absorptionToScattering.square() + 2.0 * absorptionToScattering).sqrt();
}

// K/S of an opaque layer of that reflectance, (1 - R)^2 / (2 R).
inline Eigen::ArrayXd absorptionOf(const Eigen::ArrayXd& reflectance)
{
  return (1.0 - reflectance).square() / (2.0 * reflectance);
}

// What leaves a layer with a smooth surface: `specular` of the surface's own reflection that the
// instrument collects, and the body's light after reflection from inside.
// Source: J. L. Saunderson, J. Opt. Soc. Am. 32 (1942) 727, doi:10.1364/JOSA.32.000727.
inline Eigen::ArrayXd throughSurface(
  const Eigen::ArrayXd& body, double outside, double inside, double specular)
{
  return specular * outside + (1.0 - outside) * (1.0 - inside) * body / (1.0 - inside * body);
}

} // namespace msi::scenes
