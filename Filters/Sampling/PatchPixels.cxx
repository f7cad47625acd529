#include "PatchPixels.h"

#include "AlgorithmSupport.h"
#include "SpectralImage.h"

#include "vtkCommunicator.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkMultiProcessController.h"
#include "vtkSMPThreadLocal.h"

#include <cmath>
#include <optional>
#include <stdexcept>
#include <vector>

namespace msi
{

namespace
{
constexpr int MostPatches = 100000;
}

int maximumOverRanks(int mine, vtkMultiProcessController* controller)
{
  int all = mine;
  if (controller)
  {
    controller->AllReduce(&mine, &all, 1, vtkCommunicator::MAX_OP);
  }
  return all;
}

// As many patches as this piece of the label image names.
PatchMap mapFromLabels(vtkImageData* labelImage, vtkImageData* image)
{
  auto* labels = requireSpectralArray(labelImage, "the label image");
  requireOneLabelPerPixel(labels, "the label image");
  if (labels->GetNumberOfTuples() != image->GetNumberOfPoints())
  {
    throw std::invalid_argument("the label image shows another region than the image");
  }
  double largest = 0.0;
  for (vtkIdType i = 0; i < labels->GetNumberOfTuples(); ++i)
  {
    const double label = labels->GetComponent(i, 0);
    if (!(label >= 0.0 && label <= MostPatches && label == std::floor(label)))
    {
      throw std::invalid_argument("the label image holds the value " + std::to_string(label) +
        "; expected whole numbers from 0 (no patch) to " + std::to_string(MostPatches));
    }
    largest = std::max(largest, label);
  }
  return { static_cast<int>(largest), [labels](vtkIdType point, double, double) {
            return static_cast<int>(labels->GetComponent(point, 0));
          } };
}

PatchMap mapFromGrid(const PatchGrid& grid)
{
  return { grid.patches(), [grid](vtkIdType, double x, double y) { return grid.labelAt(x, y); } };
}

void addPixels(vtkAlgorithm* self, vtkImageData* image, vtkDataArray* array, const PatchMap& map,
  PatchStatistics& statistics)
{
  int extent[6];
  image->GetExtent(extent);
  const double* spacing = image->GetSpacing();
  const double* origin = image->GetOrigin();
  const vtkIdType width = extent[1] - extent[0] + 1;
  const auto channels = statistics.channels();
  auto* floats = vtkFloatArray::FastDownCast(array);
  vtkSMPThreadLocal<std::optional<PatchStatistics>> partial;
  forBlocks(self, array->GetNumberOfTuples(),
    [&](vtkIdType begin, vtkIdType end)
    {
      auto& local = partial.Local();
      if (!local)
      {
        local.emplace(statistics.patches(), channels);
      }
      std::vector<double> pixel(floats ? 0 : static_cast<std::size_t>(channels));
      for (vtkIdType point = begin; point < end; ++point)
      {
        const auto column = extent[0] + point % width;
        const auto row = extent[2] + point / width;
        const double x = origin[0] + spacing[0] * static_cast<double>(column);
        const double y = origin[1] + spacing[1] * static_cast<double>(row);
        const int label = map.labelAt(point, x, y);
        if (label == 0)
        {
          continue;
        }
        if (floats)
        {
          local->add(label, x, y, floats->GetPointer(point * channels));
        }
        else
        {
          array->GetTuple(point, pixel.data());
          local->add(label, x, y, pixel.data());
        }
      }
    });
  for (const auto& part : partial)
  {
    statistics.merge(*part);
  }
}

void sumOverRanks(PatchStatistics& statistics, vtkMultiProcessController* controller)
{
  if (!controller)
  {
    return;
  }
  const auto state = statistics.toArray();
  const std::vector<vtkIdType> mine(state.begin(), state.end());
  std::vector<vtkIdType> all(mine.size());
  controller->AllReduce(
    mine.data(), all.data(), static_cast<vtkIdType>(mine.size()), vtkCommunicator::SUM_OP);
  statistics.setArray(std::vector<std::int64_t>(all.begin(), all.end()));
}

} // namespace msi
