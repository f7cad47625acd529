// A sample table as the scene that a simulated camera looks at.
#ifndef SceneTable_h
#define SceneTable_h

#include "Kernels/Camera/SampleScene.h"

#include <string>

class vtkTable;

namespace msi
{

// Reflectance from the columns R400, ..; medium, scene, x, y and order from the columns of these names where they
// are there. Reflectance on another grid is interpolated to the given one (see Spectra/Interpolation.h).
// Throws std::invalid_argument for a table without reflectance, or x, y or order that are no numbers.
SampleScene sceneOf(
  vtkTable* table, const WavelengthGrid& wavelengths, const std::string& nameOfTable);

} // namespace msi

#endif
