#include "ChartOverlay.h"

#include "AlgorithmSupport.h"
#include "SpectralImage.h"

#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"
#include "vtkUnsignedShortArray.h"

#include <algorithm>

namespace msi
{

namespace
{
constexpr OutlineColor FirstPatch{ 255, 225, 0 };

// The color at a place of the grid; null where the picture stays.
const OutlineColor* outlineAt(const PatchGrid& grid, const PatchGrid& middles,
  const std::vector<OutlineColor>& colors, double x, double y, double width)
{
  if (middles.labelAt(x, y) == 1)
  {
    return &FirstPatch;
  }
  const int label = grid.labelAt(x, y);
  const double steps[4][2] = { { width, 0.0 }, { -width, 0.0 }, { 0.0, width }, { 0.0, -width } };
  for (const auto& step : steps)
  {
    const int other = grid.labelAt(x + step[0], y + step[1]);
    if (other != label)
    {
      return &colors[static_cast<std::size_t>(std::max(label, other) - 1)];
    }
  }
  return nullptr;
}
}

void drawChart(vtkAlgorithm* self, const PatchGrid& grid, const std::vector<OutlineColor>& colors,
  vtkUnsignedCharArray* picture, double lineWidth, vtkImageData* image)
{
  constexpr double MarkedPart = 0.3;
  const PatchGrid middles = grid.withFraction(MarkedPart * grid.fraction());
  const vtkIdType pixels = image->GetNumberOfPoints();
  vtkNew<vtkUnsignedShortArray> labels;
  labels->SetName(LabelArray);
  labels->SetNumberOfTuples(pixels);
  vtkNew<vtkUnsignedCharArray> overlay;
  overlay->SetName("Overlay");
  overlay->SetNumberOfComponents(3);
  overlay->SetNumberOfTuples(pixels);
  int extent[6];
  image->GetExtent(extent);
  const double* origin = image->GetOrigin();
  const double* spacing = image->GetSpacing();
  const vtkIdType width = extent[1] - extent[0] + 1;
  forBlocks(self, pixels,
    [&](vtkIdType begin, vtkIdType end)
    {
      for (vtkIdType i = begin; i < end; ++i)
      {
        const vtkIdType column = extent[0] + i % width;
        const vtkIdType row = extent[2] + i / width;
        const double x = origin[0] + spacing[0] * static_cast<double>(column);
        const double y = origin[1] + spacing[1] * static_cast<double>(row);
        labels->SetValue(i, static_cast<unsigned short>(grid.labelAt(x, y)));
        const auto* color = outlineAt(grid, middles, colors, x, y, lineWidth);
        for (int c = 0; c < 3; ++c)
        {
          overlay->SetValue(3 * i + c,
            color ? (*color)[static_cast<std::size_t>(c)] : picture->GetValue(3 * i + c));
        }
      }
    });
  image->GetPointData()->SetScalars(labels);
  image->GetPointData()->AddArray(overlay);
}

} // namespace msi
