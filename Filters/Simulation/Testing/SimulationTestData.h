// A camera, samples and an image that the tests of this room share.
#pragma once

#include "CameraTable.h"
#include "SampleColumns.h"
#include "SpectralImage.h"

#include "Support/vtk/Images.h"
#include "Support/vtk/Tables.h"

#include "Kernels/Camera/CameraTestData.h"

#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <string>

namespace msi::testing
{

inline vtkSmartPointer<vtkTable> cameraTable(
  const std::string& effects = {}, std::optional<CameraNoise> noise = std::nullopt)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  write(CameraTable{ test::sevenChannels(), noise, effects }, table);
  return table;
}

inline vtkSmartPointer<vtkTable> cameraTableOfCounts(double whiteLevel)
{
  auto table = vtkSmartPointer<vtkTable>::New();
  CameraTable camera{ test::sevenChannels() };
  camera.whiteLevel = whiteLevel;
  write(camera, table);
  return table;
}

// The kernels' raster with its metadata.
inline vtkSmartPointer<vtkTable> rasterTable()
{
  const SceneSamples samples = test::rasterSamples();
  auto table = vtkSmartPointer<vtkTable>::New();
  addTextColumn(table, "medium", samples.medium);
  addTextColumn(table, "scene", samples.scene);
  addColumn(table, "x", { samples.x.begin(), samples.x.end() });
  addColumn(table, "y", { samples.y.begin(), samples.y.end() });
  addColumn(table, "order", { samples.order.begin(), samples.order.end() });
  addSpectra(table, 'R', test::visibleGrid(), samples.reflectance);
  return table;
}

// Columns C.. of a table, channels x rows.
inline Eigen::MatrixXd responsesOf(vtkTable* table)
{
  return requireSpectra(table, SampleQuantity::Response, "the output").values;
}

inline vtkSmartPointer<vtkImageData> reflectanceImage(int width, int height)
{
  return newImage(
    width, height, ReflectanceArray, patternValues(31, width * height), test::visibleGrid());
}

} // namespace msi::testing
