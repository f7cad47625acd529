#include "vtkSpectralCubeVolume.h"

#include "AlgorithmSupport.h"
#include "SpectralImage.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"

#include <algorithm>
#include <cstddef>
#include <numeric>
#include <stdexcept>

vtkStandardNewMacro(vtkSpectralCubeVolume);

namespace
{
using SDDP = vtkStreamingDemandDrivenPipeline;
constexpr const char* NameOfImage = "the image";

// A slice of the volume: bands 'below' and 'below' + 1, the latter with 'share'.
struct Slice
{
  std::size_t below;
  float share;
};

Slice sliceAt(const std::vector<double>& bands, double at)
{
  if (bands.size() == 1 || at <= bands.front())
  {
    return { 0, 0.0F };
  }
  const auto next = std::lower_bound(bands.begin(), bands.end(), at);
  if (next == bands.end())
  {
    return { bands.size() - 1, 0.0F };
  }
  const auto above = static_cast<std::size_t>(next - bands.begin());
  constexpr double SamePlace = 1e-6;
  if (bands[above] - at < SamePlace)
  {
    return { above, 0.0F };
  }
  const double below = bands[above - 1];
  return { above - 1, static_cast<float>((at - below) / (bands[above] - below)) };
}

// The bands of the input: wavelengths, or the numbers of the channels.
std::vector<double> bandsOf(vtkImageData* image, vtkDataArray* array)
{
  const auto axis = msi::axisOf(image, array);
  if (axis.wavelengths)
  {
    return axis.wavelengths->values();
  }
  std::vector<double> numbers(axis.size());
  std::iota(numbers.begin(), numbers.end(), 0.0);
  return numbers;
}

double stepOf(const std::vector<double>& bands)
{
  return bands.size() < 2 ? 1.0
                          : (bands.back() - bands.front()) / static_cast<double>(bands.size() - 1);
}
}

void vtkSpectralCubeVolume::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "SpectralArray: " << this->SpectralArray << "\n"
     << indent << "WavelengthScale: " << this->WavelengthScale << "\n";
}

int vtkSpectralCubeVolume::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkSpectralCubeVolume::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* in = inputs[0]->GetInformationObject(0);
      auto* out = outputs->GetInformationObject(0);
      int whole[6];
      in->Get(SDDP::WHOLE_EXTENT(), whole);
      if (whole[5] != whole[4])
      {
        throw std::invalid_argument("the image has " + std::to_string(whole[5] - whole[4] + 1) +
          " slices; expected one, whose components are the wavelengths");
      }
      // How many bands there are, and where, only the data say: one pixel is enough.
      int pixel[6] = { whole[0], whole[0], whole[3], whole[3], whole[4], whole[4] };
      int port = 0;
      auto* source = this->GetInputAlgorithm(0, 0, port);
      vtkNew<vtkInformation> request;
      request->Set(SDDP::UPDATE_EXTENT(), pixel, 6);
      request->Set(SDDP::UPDATE_PIECE_NUMBER(), 0);
      request->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), 1);
      vtkNew<vtkInformationVector> requests;
      requests->SetInformationObject(port, request);
      source->Update(port, requests);
      auto* image = vtkImageData::SafeDownCast(source->GetOutputDataObject(port));
      this->Slices =
        bandsOf(image, msi::requireSpectralArray(image, NameOfImage, this->SpectralArray.c_str()));

      whole[4] = 0;
      whole[5] = static_cast<int>(this->Slices.size()) - 1;
      double origin[3] = { 0.0, 0.0, 0.0 };
      double spacing[3] = { 1.0, 1.0, 1.0 };
      if (in->Has(vtkDataObject::ORIGIN()))
      {
        in->Get(vtkDataObject::ORIGIN(), origin);
        in->Get(vtkDataObject::SPACING(), spacing);
      }
      origin[2] = this->WavelengthScale * this->Slices.front();
      spacing[2] = this->WavelengthScale * stepOf(this->Slices);
      out->Set(SDDP::WHOLE_EXTENT(), whole, 6);
      out->Set(vtkDataObject::ORIGIN(), origin, 3);
      out->Set(vtkDataObject::SPACING(), spacing, 3);
      out->Set(vtkAlgorithm::CAN_PRODUCE_SUB_EXTENT(), 1);
      vtkDataObject::SetPointDataActiveScalarInfo(out, VTK_FLOAT, 1);
    });
}

int vtkSpectralCubeVolume::RequestUpdateExtent(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  int extent[6];
  int whole[6];
  auto* in = inputs[0]->GetInformationObject(0);
  outputs->GetInformationObject(0)->Get(SDDP::UPDATE_EXTENT(), extent);
  in->Get(SDDP::WHOLE_EXTENT(), whole);
  extent[4] = whole[4];
  extent[5] = whole[5];
  // The pixels of the volume's piece, whatever the piece's number.
  in->Set(SDDP::UPDATE_PIECE_NUMBER(), 0);
  in->Set(SDDP::UPDATE_NUMBER_OF_PIECES(), 1);
  in->Set(SDDP::UPDATE_EXTENT(), extent, 6);
  return 1;
}

int vtkSpectralCubeVolume::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* image = vtkImageData::GetData(inputs[0]);
      auto* outInfo = outputs->GetInformationObject(0);
      auto* output = vtkImageData::GetData(outputs, 0);
      int extent[6];
      outInfo->Get(SDDP::UPDATE_EXTENT(), extent);
      output->SetExtent(extent);
      output->SetOrigin(outInfo->Get(vtkDataObject::ORIGIN()));
      output->SetSpacing(outInfo->Get(vtkDataObject::SPACING()));
      if (output->GetNumberOfPoints() == 0)
      {
        return;
      }
      auto* array = msi::requireSpectralArray(image, NameOfImage, this->SpectralArray.c_str());
      const auto spectra = msi::asFloats(array);
      const auto bands = bandsOf(image, array);
      if (bands != this->Slices)
      {
        throw std::runtime_error("the image has other bands than it had before");
      }
      std::vector<Slice> slices;
      for (int z = extent[4]; z <= extent[5]; ++z)
      {
        slices.push_back(sliceAt(bands, bands.front() + z * stepOf(bands)));
      }
      vtkNew<vtkFloatArray> volume;
      volume->SetName(array->GetName() ? array->GetName() : msi::ResponsesArray);
      volume->SetNumberOfTuples(output->GetNumberOfPoints());
      const int* held = image->GetExtent();
      const vtkIdType width = extent[1] - extent[0] + 1;
      const vtkIdType height = extent[3] - extent[2] + 1;
      const vtkIdType heldWidth = held[1] - held[0] + 1;
      const auto components = static_cast<vtkIdType>(bands.size());
      const float* in = spectra->GetPointer(0);
      float* out = volume->GetPointer(0);
      msi::forBlocks(this, width * height,
        [&](vtkIdType begin, vtkIdType end)
        {
          for (vtkIdType pixel = begin; pixel < end; ++pixel)
          {
            const vtkIdType y = extent[2] + pixel / width - held[2];
            const vtkIdType x = extent[0] + pixel % width - held[0];
            const float* spectrum = in + (y * heldWidth + x) * components;
            for (std::size_t z = 0; z < slices.size(); ++z)
            {
              const auto& slice = slices[z];
              const float* band = spectrum + slice.below;
              out[static_cast<vtkIdType>(z) * width * height + pixel] =
                slice.share == 0.0F ? band[0] : band[0] + slice.share * (band[1] - band[0]);
            }
          }
        });
      output->GetPointData()->SetScalars(volume);
    });
}
