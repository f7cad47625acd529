#include "ImageSimulation.h"

#include "CameraTable.h"
#include "ImageStrips.h"
#include "SpectralImage.h"

#include "vtkAlgorithm.h"
#include "vtkCellData.h"
#include "vtkDataArray.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkSMPThreadLocal.h"
#include "vtkSMPTools.h"

#include "Kernels/Camera/Imaging/SceneMean.h"

#include <algorithm>
#include <optional>
#include <stdexcept>
#include <vector>

namespace msi
{

namespace
{
constexpr int LeastStripRows = 32;

Extent extentOf(vtkImageData* image)
{
  Extent extent{};
  image->GetExtent(extent.data());
  return extent;
}

// The media of the image's pixels; empty where the simulator does not ask for them.
std::vector<int> mediaOf(const ImageSimulator& simulator, const ImageSimulationInput& input)
{
  if (!simulator.needsMedium())
  {
    return {};
  }
  const auto pixels = static_cast<std::size_t>(input.image->GetNumberOfPoints());
  std::vector<int> media(pixels, 0);
  if (input.mediumArray.empty())
  {
    return media;
  }
  auto* array = input.image->GetPointData()->GetArray(input.mediumArray.c_str());
  if (!array || array->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument("the image has no point array '" + input.mediumArray +
      "' of one component; expected the number of the medium of each pixel, counted from 0");
  }
  for (std::size_t i = 0; i < pixels; ++i)
  {
    media[i] = static_cast<int>(array->GetTuple1(static_cast<vtkIdType>(i)));
  }
  return media;
}
}

void simulateImage(vtkAlgorithm* algorithm, const ImageSimulator& simulator,
  const ImageSimulationInput& input, const CameraModel& camera, vtkImageData* output)
{
  vtkImageData* image = input.image;
  auto* array = requireReflectanceArray(image, "the image", input.reflectanceArray.c_str());
  if (array->GetNumberOfComponents() != simulator.wavelengthCount())
  {
    throw std::invalid_argument("the image has " + std::to_string(array->GetNumberOfComponents()) +
      " values a pixel; expected the reflectance at " +
      std::to_string(simulator.wavelengthCount()) + " wavelengths");
  }
  const auto reflectance = asFloats(array);
  const std::vector<int> media = mediaOf(simulator, input);
  const int* medium = media.empty() ? nullptr : media.data();
  const float* values = reflectance->GetPointer(0);
  const ImageWindow available = windowOf(extentOf(image), input.whole);
  const ImageWindow window = windowOf(input.extent, input.whole);
  const int bands = simulator.wavelengthCount();
  const int channels = simulator.channelCount();
  // Wider strips where each drags a wide surround along, as far as the threads have one each.
  const int threads = std::max(1, vtkSMPTools::GetEstimatedNumberOfThreads());
  const int stripRows = std::max(
    LeastStripRows, std::min(8 * simulator.halo(), (window.height + threads - 1) / threads));

  vtkSMPThreadLocal<ImageWorkspace> workspace;
  SceneMean mean(channels);
  constexpr double MeanProgress = 0.3;
  const double begun = simulator.needsSceneMean() ? MeanProgress : 0.0;
  if (simulator.needsSceneMean())
  {
    vtkSMPThreadLocal<std::optional<SceneMean>> parts;
    forStrips(algorithm, available.height, LeastStripRows, 0.0,
      [&](int row, int rows)
      {
        const auto pixel =
          static_cast<std::size_t>(row) * static_cast<std::size_t>(available.width);
        auto& part = parts.Local();
        if (!part)
        {
          part.emplace(channels);
        }
        simulator.addToMean(values + pixel * static_cast<std::size_t>(bands),
          medium ? medium + pixel : nullptr,
          { available.x, available.y + row, available.width, rows }, *part, workspace.Local());
      });
    for (const auto& part : parts)
    {
      mean.merge(*part);
    }
  }

  vtkNew<vtkFloatArray> responses;
  responses->SetName(ResponsesArray);
  responses->SetNumberOfComponents(channels);
  responses->SetNumberOfTuples(static_cast<vtkIdType>(window.pixels()));
  float* out = responses->GetPointer(0);
  forStrips(algorithm, window.height, stripRows, begun,
    [&](int row, int rows)
    {
      const auto first = static_cast<std::size_t>(row) * static_cast<std::size_t>(window.width) *
        static_cast<std::size_t>(channels);
      simulator.simulate(values, medium, available,
        { window.x, window.y + row, window.width, rows }, &mean, out + first, workspace.Local());
    });

  output->ShallowCopy(image);
  auto* points = output->GetPointData();
  for (int i = points->GetNumberOfArrays() - 1; i >= 0; --i)
  {
    if (points->GetAbstractArray(i) == array)
    {
      points->RemoveArray(i);
    }
  }
  output->Crop(input.extent.data());
  // Those of the margin; whoever asks for ghosts marks their own.
  points->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  output->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  setAxis(output, responses, channelsOf(camera));
  replaceArray(output, nullptr, responses);
}

} // namespace msi
