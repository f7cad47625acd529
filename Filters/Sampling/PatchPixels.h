// The pixels of patches, from the pieces of an image to one statistics over all ranks.
#ifndef PatchPixels_h
#define PatchPixels_h

#include "vtkType.h"

#include "Kernels/Sampling/PatchGrid.h"
#include "Kernels/Sampling/PatchStatistics.h"

#include <functional>

class vtkAlgorithm;
class vtkDataArray;
class vtkImageData;
class vtkMultiProcessController;

namespace msi
{

// Which patch a point belongs to, 0 for none. Labels are at most 'patches'.
struct PatchMap
{
  int patches = 0;
  std::function<int(vtkIdType point, double x, double y)> labelAt;
};

// Throws std::invalid_argument where the label image has another size, several components, or values that
// are no labels.
PatchMap mapFromLabels(vtkImageData* labelImage, vtkImageData* image);
PatchMap mapFromGrid(const PatchGrid& grid);

// Adds all pixels of the image, in threads. Throws std::runtime_error where 'self' was stopped.
void addPixels(vtkAlgorithm* self, vtkImageData* image, vtkDataArray* array, const PatchMap& map,
  PatchStatistics& statistics);

// Both collective; 'controller' null: this process holds everything.
int maximumOverRanks(int mine, vtkMultiProcessController* controller);
void sumOverRanks(PatchStatistics& statistics, vtkMultiProcessController* controller);

} // namespace msi

#endif
