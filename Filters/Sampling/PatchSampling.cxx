#include "PatchSampling.h"

#include "AlgorithmSupport.h"
#include "SpectralImage.h"

#include "vtkDataArray.h"
#include "vtkImageData.h"

#include <algorithm>
#include <stdexcept>

namespace msi
{

void PatchSampling::restart()
{
  statistics.reset();
  axis = {};
  patches = 0;
  failure.clear();
}

PatchStatistics& PatchSampling::prepare(vtkImageData* image, vtkDataArray* array, int patchCount)
{
  if (!statistics)
  {
    axis = axisOf(image, array);
    statistics.emplace(std::max(1, patchCount), array->GetNumberOfComponents());
  }
  patches = std::max(patches, patchCount);
  if (patchCount > 0)
  {
    statistics->grow(patchCount);
  }
  return *statistics;
}

void PatchSampling::add(
  vtkAlgorithm* self, vtkImageData* image, vtkDataArray* array, const PatchMap& map)
{
  auto& sums = prepare(image, array, map.patches);
  if (map.patches > 0)
  {
    addPixels(self, image, array, map, sums);
  }
}

bool PatchSampling::takeBlock(
  vtkAlgorithm* self, vtkInformation* request, const std::function<void()>& work)
{
  try
  {
    work();
    self->UpdateProgress(blocks.progress());
    return blocks.next(request);
  }
  catch (const std::exception& error)
  {
    failure = error.what();
    blocks.stop(request);
    return false;
  }
}

const PatchStatistics& PatchSampling::gather(const std::string& name)
{
  auto* controller = controllerOfTables();
  throwOnAnyRank(failure, controller);
  const int everywhere = maximumOverRanks(patches, controller);
  const int channels = maximumOverRanks(static_cast<int>(axis.size()), controller);
  if (everywhere == 0)
  {
    throw std::invalid_argument("the label image is 0 everywhere; expected " + name + " 1, 2, ..");
  }
  if (!statistics)
  {
    statistics.emplace(everywhere, channels);
  }
  statistics->grow(everywhere);
  sumOverRanks(*statistics, controller);
  return *statistics;
}

} // namespace msi
