// The problems that NumPy solved (Kernels/Estimation/reference_estimation.py) as tables.
#pragma once

#include "Support/vtk/Tables.h"

#include "vtkAlgorithm.h"

#include "Kernels/Estimation/EstimationTestData.h"

namespace msi::testing
{

inline WavelengthGrid bandsOf(const SampleSet& samples)
{
  return WavelengthGrid::uniform(
    400, 390 + 10 * static_cast<double>(samples.reflectance.rows()), 10);
}

// 20 nm apart: the banded transform is tridiagonal.
inline WavelengthGrid channelsOf(const SampleSet& samples, double step = 20)
{
  return WavelengthGrid::uniform(
    400, 400 + step * static_cast<double>(samples.response.rows() - 1), step);
}

inline vtkSmartPointer<vtkTable> tableOf(const SampleSet& samples, double channelStep = 20)
{
  return newSampleTable(samples, bandsOf(samples), channelsOf(samples, channelStep));
}

// coefficients: linear part and constant column.
inline Eigen::MatrixXd estimated(
  const Eigen::MatrixXd& coefficients, const Eigen::MatrixXd& response)
{
  return (coefficients.leftCols(response.rows()) * response).colwise() +
    coefficients.col(coefficients.cols() - 1);
}

// Columns named by the letter and the bands, samples x bands transposed: bands x samples.
inline Eigen::MatrixXd spectraOf(vtkTable* table, char letter, const WavelengthGrid& bands)
{
  Eigen::MatrixXd values(bands.size(), table->GetNumberOfRows());
  for (Eigen::Index i = 0; i < values.rows(); ++i)
  {
    const std::string name = letter + std::to_string(static_cast<int>(bands[i]));
    for (Eigen::Index sample = 0; sample < values.cols(); ++sample)
    {
      values(i, sample) = cell(table, sample, name);
    }
  }
  return values;
}

inline vtkTable* tableAt(vtkAlgorithm* algorithm, int port)
{
  return vtkTable::SafeDownCast(algorithm->GetOutputDataObject(port));
}

} // namespace msi::testing
