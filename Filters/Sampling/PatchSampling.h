// Statistics of patches gathered over the blocks of an image: what Patch Sampler and Spectral Profile have in common.
#ifndef PatchSampling_h
#define PatchSampling_h

#include "ImageBlocks.h"
#include "PatchPixels.h"
#include "SpectralAxis.h"

#include <functional>
#include <optional>
#include <string>

namespace msi
{

struct PatchSampling
{
  ImageBlocks blocks;
  std::optional<PatchStatistics> statistics; // from the first block on
  SpectralAxis axis;   // of the image; empty as long as there are no statistics
  int patches = 0;     // seen so far
  std::string failure; // of this rank, told where the ranks meet

  // Forgets the image, not the way through it.
  void restart();
  // Statistics that hold so many patches of this array.
  PatchStatistics& prepare(vtkImageData* image, vtkDataArray* array, int patchCount);
  void add(vtkAlgorithm* self, vtkImageData* image, vtkDataArray* array, const PatchMap& map);
  // Does the work on the current block, shows progress, and says whether another block follows. What the work throws
  // goes into 'failure' and ends the blocks.
  bool takeBlock(vtkAlgorithm* self, vtkInformation* request, const std::function<void()>& work);
  // The sums over all ranks. Collective. Throws what a rank failed with, and std::invalid_argument where no rank saw a
  // patch; the text calls them 'name'.
  const PatchStatistics& gather(const std::string& name);
};

} // namespace msi

#endif
