#include "vtkChannelRegistration.h"

#include "AlgorithmSupport.h"
#include "DisplacementTable.h"
#include "ImagePicture.h"
#include "ImageStrips.h"
#include "SpectralImage.h"

#include "vtkCellData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSMPThreadLocal.h"
#include "vtkTable.h"

#include "Kernels/Camera/Imaging/ChannelDisplacement.h"

#include <algorithm>
#include <array>
#include <cstddef>
#include <limits>
#include <stdexcept>

vtkStandardNewMacro(vtkChannelRegistration);

namespace
{
using Pipeline = vtkStreamingDemandDrivenPipeline;

constexpr int RegisteredRows = 64; // of a strip at least

struct StripBuffers
{
  msi::PixelBuffer pixels;
  msi::PixelBuffer scratch;
};

// The strip `rows` of the result; `held` are the pixels at `values`.
void registerStrip(const msi::ChannelRegistration& registration,
  const std::vector<msi::ShownPixels>& shown, const msi::ImageExtent& extent,
  const msi::ImageWindow& held, const float* values, const msi::ImageWindow& rows,
  StripBuffers& buffers, float* out)
{
  const auto channels = shown.size();
  const msi::ImageWindow read = msi::grown(rows, registration.reach(), extent);
  msi::PixelBuffer& buffer = buffers.pixels;
  buffer.resize(read, static_cast<int>(channels));
  for (int y = read.y; y < read.y + read.height; ++y)
  {
    const auto pixel = static_cast<std::size_t>(y - held.y) * static_cast<std::size_t>(held.width) +
      static_cast<std::size_t>(read.x - held.x);
    std::copy_n(values + pixel * channels, static_cast<std::size_t>(read.width) * channels,
      buffer.pixel(read.x, y));
  }
  registration(buffer, buffers.scratch);
  for (int y = rows.y; y < rows.y + rows.height; ++y)
  {
    for (int x = rows.x; x < rows.x + rows.width; ++x, out += channels)
    {
      const float* pixel = buffer.pixel(x, y);
      for (std::size_t k = 0; k < channels; ++k)
      {
        out[k] = shown[k].contain(x, y) ? pixel[k] : std::numeric_limits<float>::quiet_NaN();
      }
    }
  }
}
}

vtkChannelRegistration::vtkChannelRegistration()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(1);
}

void vtkChannelRegistration::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preview: " << this->Preview << "\n";
}

int vtkChannelRegistration::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), port == 0 ? "vtkImageData" : "vtkTable");
  if (port == 1)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1); // RequestData says what is missing
  }
  return 1;
}

int vtkChannelRegistration::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->Superclass::RequestUpdateExtent(request, inputs, outputs);
  msi::requestWhole(inputs, 1);
  msi::requestWithMargin(
    inputs[0]->GetInformationObject(0), outputs->GetInformationObject(0), this->Margin);
  return 1;
}

int vtkChannelRegistration::RequestData(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  const bool second = request->Has(Pipeline::CONTINUE_EXECUTING()) != 0;
  request->Remove(Pipeline::CONTINUE_EXECUTING());
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      if (!vtkTable::GetData(inputs[1]))
      {
        throw std::invalid_argument(
          "no displacements are connected; apply Channel Displacement to this image, or to that of "
          "a chart from the same camera, and choose its table as Displacements");
      }
      const bool done = this->Resample(inputs, outputs);
      if (!done && second)
      {
        throw std::runtime_error("the image's source gives fewer pixels than it was asked for");
      }
      if (!done)
      {
        // How far the channels lie apart is known only now: once more, with that margin.
        request->Set(Pipeline::CONTINUE_EXECUTING(), 1);
      }
    });
}

bool vtkChannelRegistration::Resample(vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  auto* image = vtkImageData::GetData(inputs[0]);
  auto* outputInformation = outputs->GetInformationObject(0);
  if (image->GetNumberOfPoints() == 0)
  {
    return true; // a piece without pixels
  }
  auto* array = msi::requireSpectralArray(image, "the image");
  const auto axis = msi::axisOf(image, array);
  msi::Extent whole{};
  inputs[0]->GetInformationObject(0)->Get(Pipeline::WHOLE_EXTENT(), whole.data());
  const msi::ImageExtent extent{ whole[1] - whole[0] + 1, whole[3] - whole[2] + 1 };
  const auto displacements = msi::readDisplacements(
    vtkTable::GetData(inputs[1]), axis, { image->GetSpacing()[0], image->GetSpacing()[1] });
  const msi::ChannelRegistration registration = msi::undoing(displacements, extent);
  std::vector<msi::ShownPixels> shown;
  shown.reserve(displacements.size());
  for (const msi::ChannelDisplacement& displacement : displacements)
  {
    shown.emplace_back(displacement, extent);
  }
  this->Margin = registration.reach();

  const msi::Extent wanted = msi::requestedExtent(outputInformation);
  msi::Extent available{};
  image->GetExtent(available.data());
  if (!msi::contains(available, msi::grown(wanted, this->Margin, whole)))
  {
    return false;
  }
  const auto floats = msi::asFloats(array);
  const msi::ImageWindow held = msi::windowOf(available, whole);
  const msi::ImageWindow window = msi::windowOf(wanted, whole);
  vtkNew<vtkFloatArray> registered;
  registered->SetName(array->GetName());
  registered->SetNumberOfComponents(array->GetNumberOfComponents());
  registered->SetNumberOfTuples(static_cast<vtkIdType>(window.pixels()));
  vtkSMPThreadLocal<StripBuffers> buffers;
  msi::forStrips(this, window.height, std::max(RegisteredRows, 4 * this->Margin), 0.0,
    [&](int row, int rows)
    {
      float* out = registered->GetPointer(
        static_cast<vtkIdType>(row) * window.width * registered->GetNumberOfComponents());
      registerStrip(registration, shown, extent, held, floats->GetPointer(0),
        { window.x, window.y + row, window.width, rows }, buffers.Local(), out);
    });

  auto* output = vtkImageData::GetData(outputs, 0);
  output->ShallowCopy(image);
  msi::nameComponents(registered, axis);
  output->GetPointData()->RemoveArray(array->GetName());
  output->Crop(wanted.data());
  // Those of the margin; whoever asks for ghosts marks their own.
  output->GetPointData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  output->GetCellData()->RemoveArray(vtkDataSetAttributes::GhostArrayName());
  msi::replaceArray(output, nullptr, registered);
  if (this->Preview)
  {
    msi::setPicture(this, output, registered);
  }
  else
  {
    msi::removePicture(output);
  }
  if (outputInformation->Get(Pipeline::UPDATE_NUMBER_OF_GHOST_LEVELS()) > 0)
  {
    auto own = msi::requestedExtentWithoutGhosts(outputInformation);
    output->GenerateGhostArray(own.data());
  }
  return true;
}
