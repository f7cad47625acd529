// Small spectral images for tests.
#pragma once

#include "SpectralImage.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include "Kernels/Spectra/WavelengthGrid.h"

#include <Eigen/Core>

#include <functional>
#include <optional>
#include <string>
#include <vector>

namespace msi::testing
{

// values: components x pixels, pixel 0 at the bottom left, x fastest.
template <typename ArrayType = vtkFloatArray>
vtkSmartPointer<vtkImageData> newImage(int width, int height, const std::string& arrayName,
  const Eigen::MatrixXd& values, const std::optional<WavelengthGrid>& wavelengths = std::nullopt)
{
  auto image = vtkSmartPointer<vtkImageData>::New();
  image->SetDimensions(width, height, 1);
  auto array = vtkSmartPointer<ArrayType>::New();
  array->SetName(arrayName.c_str());
  array->SetNumberOfComponents(static_cast<int>(values.rows()));
  array->SetNumberOfTuples(values.cols());
  for (Eigen::Index pixel = 0; pixel < values.cols(); ++pixel)
  {
    for (Eigen::Index i = 0; i < values.rows(); ++i)
    {
      array->SetComponent(pixel, static_cast<int>(i), values(i, pixel));
    }
  }
  if (wavelengths)
  {
    setAxis(image, array, axisOf(*wavelengths));
  }
  image->GetPointData()->SetScalars(array);
  return image;
}

inline vtkSmartPointer<vtkImageData> newLabels(
  int width, int height, const std::vector<int>& labels)
{
  return newImage<vtkIntArray>(width, height, LabelArray,
    Eigen::Map<const Eigen::RowVectorXi>(labels.data(), static_cast<Eigen::Index>(labels.size()))
      .cast<double>());
}

// components x pixels.
inline Eigen::MatrixXd valuesOf(vtkImageData* image, const std::string& arrayName)
{
  auto* array = image->GetPointData()->GetArray(arrayName.c_str());
  if (!array)
  {
    return {};
  }
  Eigen::MatrixXd values(array->GetNumberOfComponents(), array->GetNumberOfTuples());
  for (Eigen::Index pixel = 0; pixel < values.cols(); ++pixel)
  {
    for (Eigen::Index i = 0; i < values.rows(); ++i)
    {
      values(i, pixel) = array->GetComponent(pixel, static_cast<int>(i));
    }
  }
  return values;
}

// A responsive, NaN-free pattern that differs in every pixel and component, within 0.05 .. 0.95.
inline Eigen::MatrixXd patternValues(Eigen::Index components, Eigen::Index pixels)
{
  return Eigen::MatrixXd::NullaryExpr(components, pixels,
    [](Eigen::Index i, Eigen::Index pixel)
    {
      constexpr double GoldenRatio = 0.6180339887498949;
      const double turn = GoldenRatio * static_cast<double>(pixel + 1) * static_cast<double>(i + 2);
      return 0.05 + 0.9 * (turn - std::floor(turn));
    });
}

} // namespace msi::testing
