#include "vtkFlatFieldCorrection.h"

#include "AlgorithmSupport.h"
#include "ImagePieces.h"
#include "SpectralImage.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"

#include <atomic>
#include <limits>
#include <stdexcept>

vtkStandardNewMacro(vtkFlatFieldCorrection);

namespace
{
constexpr const char* NameOfRaw = "the raw image";
constexpr const char* NameOfFrame[] = { NameOfRaw, "the white image", "the dark image" };

// A reference frame of the same channels as the raw image, or null where none is connected.
vtkSmartPointer<vtkFloatArray> frame(
  vtkImageData* image, const char* name, vtkImageData* raw, vtkFloatArray* rawValues)
{
  if (!image)
  {
    return nullptr;
  }
  auto values = msi::asFloats(msi::requireSpectralArray(image, name));
  msi::requireSameChannels(
    msi::axisOf(image, values), name, msi::axisOf(raw, rawValues), NameOfRaw);
  if (values->GetNumberOfTuples() != rawValues->GetNumberOfTuples())
  {
    throw std::invalid_argument(std::string(name) + " shows another region than the raw image");
  }
  return values;
}
}

vtkFlatFieldCorrection::vtkFlatFieldCorrection()
{
  this->SetNumberOfInputPorts(3);
  this->SetNumberOfOutputPorts(1);
}

void vtkFlatFieldCorrection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "WhiteReflectance: " << this->WhiteReflectance << "\n"
     << indent << "WhiteLevel: " << this->WhiteLevel << "\n"
     << indent << "DeadCount: " << this->DeadCount << "\n";
}

int vtkFlatFieldCorrection::FillInputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  if (port > 0)
  {
    info->Set(vtkAlgorithm::INPUT_IS_OPTIONAL(), 1);
  }
  return 1;
}

int vtkFlatFieldCorrection::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      auto* raw = inputs[0]->GetInformationObject(0);
      for (int port = 1; port < 3; ++port)
      {
        msi::requireSameSize(inputs[port]->GetInformationObject(0), NameOfFrame[port], raw,
          NameOfRaw, "take both with the same camera settings");
      }
    });
}

int vtkFlatFieldCorrection::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  this->DeadCount = 0;
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      if (!(this->WhiteLevel > 0.0))
      {
        throw std::invalid_argument(
          "WhiteLevel is " + std::to_string(this->WhiteLevel) + "; expected more than 0");
      }
      auto* rawImage = vtkImageData::GetData(inputs[0]);
      auto* rawArray = msi::requireSpectralArray(rawImage, NameOfRaw);
      const auto raw = msi::asFloats(rawArray);
      const auto white = frame(vtkImageData::GetData(inputs[1]), NameOfFrame[1], rawImage, raw);
      const auto dark = frame(vtkImageData::GetData(inputs[2]), NameOfFrame[2], rawImage, raw);

      auto* output = vtkImageData::GetData(outputs, 0);
      output->ShallowCopy(rawImage);
      vtkNew<vtkFloatArray> responses;
      responses->SetName(msi::ResponsesArray);
      responses->SetNumberOfComponents(raw->GetNumberOfComponents());
      responses->SetNumberOfTuples(raw->GetNumberOfTuples());
      const float* rawValues = raw->GetPointer(0);
      const float* whiteValues = white ? white->GetPointer(0) : nullptr;
      const float* darkValues = dark ? dark->GetPointer(0) : nullptr;
      float* out = responses->GetPointer(0);
      const auto level = static_cast<float>(this->WhiteLevel);
      const auto scale = static_cast<float>(this->WhiteReflectance);
      std::atomic<vtkIdType> dead{ 0 };
      msi::forBlocks(this, raw->GetNumberOfValues(),
        [&](vtkIdType begin, vtkIdType end)
        {
          vtkIdType deadHere = 0;
          for (vtkIdType i = begin; i < end; ++i)
          {
            const float black = darkValues ? darkValues[i] : 0.0f;
            const float span = (whiteValues ? whiteValues[i] : level) - black;
            const bool alive = span > 0.0f;
            deadHere += alive ? 0 : 1;
            out[i] = alive ? scale * (rawValues[i] - black) / span
                           : std::numeric_limits<float>::quiet_NaN();
          }
          dead += deadHere;
        });
      this->DeadCount = dead;
      msi::setAxis(output, responses, msi::axisOf(rawImage, rawArray));
      msi::replaceArray(output, rawArray, responses);
    });
}
