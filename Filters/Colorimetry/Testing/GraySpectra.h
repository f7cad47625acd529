// Gray samples, whose color and color difference are known in closed form.
#pragma once

#include "Support/vtk/Images.h"
#include "Support/vtk/Tables.h"

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <cmath>
#include <vector>

namespace msi::testing
{

inline const WavelengthGrid GrayGrid = WavelengthGrid::uniform(400, 700, 10);

// One column a reflectance factor, the same at every wavelength.
inline Eigen::MatrixXd grays(const std::vector<double>& factors)
{
  return Eigen::VectorXd::Ones(GrayGrid.size()) *
    Eigen::Map<const Eigen::RowVectorXd>(factors.data(), static_cast<Eigen::Index>(factors.size()));
}

template <typename ArrayType = vtkFloatArray>
vtkSmartPointer<vtkImageData> grayImage(const std::vector<double>& factors)
{
  return newImage<ArrayType>(
    static_cast<int>(factors.size()), 1, ReflectanceArray, grays(factors), GrayGrid);
}

// CIE 15: L* of a gray of reflectance factor Y / Yn, for Y / Yn > (6/29)^3.
inline double lightnessOf(double factor)
{
  return 116.0 * std::cbrt(factor) - 16.0;
}

// CIEDE2000 of two grays: a* and b* vanish, what is left is the lightness term (Sharma et al. 2005).
inline double grayDifference(double factor1, double factor2, double kL = 1.0)
{
  const double l1 = lightnessOf(factor1);
  const double l2 = lightnessOf(factor2);
  const double square = std::pow((l1 + l2) / 2.0 - 50.0, 2.0);
  const double sL = 1.0 + 0.015 * square / std::sqrt(20.0 + square);
  return std::abs(l1 - l2) / (kL * sL);
}

// IEC 61966-2-1, for linear values above 0.0031308.
inline double encodedSRGB(double linear)
{
  return 1.055 * std::pow(linear, 1.0 / 2.4) - 0.055;
}

} // namespace msi::testing
