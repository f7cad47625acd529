#include "vtkSpectralImageWriter.h"

#include "AlgorithmSupport.h"
#include "SpectralImage.h"

#include "vtkCommand.h"
#include "vtkErrorCode.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include "Formats/SpectralImageWriter.h"

#include <algorithm>
#include <cstring>
#include <memory>
#include <sstream>
#include <stdexcept>
#include <vector>

vtkStandardNewMacro(vtkSpectralImageWriter);

namespace
{
constexpr int BlockTag = 7041;
constexpr vtkIdType MiB = 1 << 20;

// Rows [first, last] of an image as floats, top row first.
std::vector<float> rowsTopDown(
  vtkImageData* image, vtkDataArray* array, const int whole[6], int first, int last)
{
  const int width = whole[1] - whole[0] + 1;
  const int components = array->GetNumberOfComponents();
  int extent[6];
  image->GetExtent(extent);
  if (extent[0] > whole[0] || extent[1] < whole[1] || extent[2] > first || extent[3] < last)
  {
    std::ostringstream message;
    message << "the pipeline gave columns " << extent[0] << " to " << extent[1] << ", rows "
            << extent[2] << " to " << extent[3] << " where columns " << whole[0] << " to "
            << whole[1] << ", rows " << first << " to " << last << " were asked for";
    throw std::runtime_error(message.str());
  }
  const vtkIdType rowPoints = extent[1] - extent[0] + 1;
  std::vector<float> rows(
    static_cast<std::size_t>(last - first + 1) * static_cast<std::size_t>(width * components));
  float* out = rows.data();
  auto* floats = vtkFloatArray::FastDownCast(array);
  for (int y = last; y >= first; --y)
  {
    const vtkIdType start = ((y - extent[2]) * rowPoints + (whole[0] - extent[0])) * components;
    for (vtkIdType i = 0; i < static_cast<vtkIdType>(width) * components; ++i)
    {
      *out++ = floats ? floats->GetValue(start + i)
                      : static_cast<float>(array->GetComponent(
                          (start + i) / components, static_cast<int>((start + i) % components)));
    }
  }
  return rows;
}

msi::SpectralImageInfo infoOf(vtkImageData* image, vtkDataArray* array, const int whole[6])
{
  msi::SpectralImageInfo info;
  info.width = whole[1] - whole[0] + 1;
  info.height = whole[3] - whole[2] + 1;
  const auto axis = msi::axisOf(image, array);
  info.bandNames = axis.names;
  if (axis.wavelengths)
  {
    info.wavelengths = axis.wavelengths->values();
  }
  if (array->GetName() && std::string(array->GetName()) == msi::ReflectanceArray)
  {
    info.quantity = "reflectance";
  }
  return info;
}
}

void vtkSpectralImageWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "SpectralArray: " << this->SpectralArray << "\n"
     << indent << "BlockSize: " << this->BlockSize << "\n";
}

int vtkSpectralImageWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkSpectralImageWriter::Write()
{
  try
  {
    this->SetErrorCode(vtkErrorCode::NoError);
    this->InvokeEvent(vtkCommand::StartEvent);
    this->WriteBlocks();
    this->InvokeEvent(vtkCommand::EndEvent);
    return 1;
  }
  catch (const std::exception& error)
  {
    this->SetErrorCode(vtkErrorCode::UnknownError);
    vtkErrorMacro(<< error.what());
    return 0;
  }
}

void vtkSpectralImageWriter::WriteBlocks()
{
  if (this->FileName.empty())
  {
    throw std::invalid_argument("no file is given; set FileName");
  }
  auto* source = this->GetInputAlgorithm();
  if (!source)
  {
    throw std::invalid_argument("there is no input; connect a spectral image");
  }
  source->UpdateInformation();
  int whole[6];
  auto* information = this->GetInputInformation();
  information->Get(vtkStreamingDemandDrivenPipeline::WHOLE_EXTENT(), whole);
  if (whole[1] < whole[0] || whole[3] < whole[2])
  {
    throw std::invalid_argument("the input is an empty image");
  }

  auto* controller = msi::controllerOfTables();
  const int ranks = controller ? controller->GetNumberOfProcesses() : 1;
  const int rank = controller ? controller->GetLocalProcessId() : 0;
  std::unique_ptr<msi::SpectralImageWriter> writer;
  int rowsPerRank = 1; // known once the number of components is
  for (int next = whole[3]; next >= whole[2];)
  {
    // The block [bottom, next], top part first, in one share of rows a rank.
    const int bottom = std::max(whole[2], next - rowsPerRank * ranks + 1);
    const auto share = [&](int r)
    {
      const int last = next - r * rowsPerRank;
      return std::make_pair(std::max(bottom, last - rowsPerRank + 1), last);
    };
    // A rank beyond the last rows updates one row all the same: updates may be collective.
    const auto [first, last] = share(rank);
    const bool mine = last >= bottom;
    int extent[6];
    std::copy(whole, whole + 6, extent);
    extent[2] = mine ? first : bottom;
    extent[3] = mine ? last : bottom;
    vtkNew<vtkInformation> request;
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_EXTENT(), extent, 6);
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_PIECE_NUMBER(), 0);
    request->Set(vtkStreamingDemandDrivenPipeline::UPDATE_NUMBER_OF_PIECES(), 1);
    source->Update(request);
    auto* image = vtkImageData::SafeDownCast(this->GetInputDataObject(0, 0));
    auto* array =
      msi::requireSpectralArray(image, "the image to write", this->SpectralArray.c_str());
    const auto rows = mine ? rowsTopDown(image, array, whole, first, last) : std::vector<float>();
    if (rank > 0)
    {
      const vtkIdType size = static_cast<vtkIdType>(rows.size());
      controller->Send(&size, 1, 0, BlockTag);
      if (size > 0)
      {
        controller->Send(rows.data(), size, 0, BlockTag);
      }
    }
    else
    {
      if (!writer)
      {
        writer = msi::createSpectralImage(this->FileName, infoOf(image, array, whole));
      }
      writer->writeRows(last - first + 1, rows.data());
      for (int r = 1; r < ranks; ++r)
      {
        vtkIdType size = 0;
        controller->Receive(&size, 1, r, BlockTag);
        if (size > 0)
        {
          std::vector<float> received(static_cast<std::size_t>(size));
          controller->Receive(received.data(), size, r, BlockTag);
          const auto rowsOfRank = share(r);
          writer->writeRows(rowsOfRank.second - rowsOfRank.first + 1, received.data());
        }
      }
    }
    next = bottom - 1;
    const vtkIdType rowBytes = static_cast<vtkIdType>(whole[1] - whole[0] + 1) *
      array->GetNumberOfComponents() * static_cast<vtkIdType>(sizeof(float));
    rowsPerRank =
      static_cast<int>(std::clamp<vtkIdType>(this->BlockSize * MiB / rowBytes, 1, whole[3] + 1));
    this->UpdateProgress(static_cast<double>(whole[3] - next) / (whole[3] - whole[2] + 1));
    if (this->GetAbortExecute())
    {
      throw std::runtime_error("stopped by the user");
    }
  }
  if (writer)
  {
    writer->finish();
  }
}
