#include "vtkResponseDifference.h"

#include "AlgorithmSupport.h"
#include "ImagePicture.h"
#include "ImagePieces.h"
#include "SampleColumns.h"
#include "SpectralImage.h"

#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkIntArray.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include "Kernels/Camera/ResponseDifference.h"

#include <algorithm>
#include <array>
#include <functional>
#include <stdexcept>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkResponseDifference);

namespace
{
constexpr const char* NameOf[] = { "the real responses", "the simulated responses" };

void compareTables(vtkTable* real, vtkTable* simulated, vtkTable* output, vtkTable* channels)
{
  const auto first = msi::requireSpectra(real, msi::SampleQuantity::Response, NameOf[0]);
  const auto second = msi::requireSpectra(simulated, msi::SampleQuantity::Response, NameOf[1]);
  const auto differences = msi::responseDifference(first.values, second.values);

  output->ShallowCopy(real);
  vtkNew<vtkStringArray> names;
  names->SetName("channel");
  vtkNew<vtkIntArray> samples;
  samples->SetName("samples");
  Eigen::MatrixXd figures(static_cast<Eigen::Index>(differences.size()), 5);
  for (std::size_t k = 0; k < differences.size(); ++k)
  {
    const auto row = static_cast<Eigen::Index>(k);
    const std::string& column = first.columns[k];
    msi::setNumbers(output, "simulated " + column, second.values.row(row).transpose());
    msi::setNumbers(
      output, "difference " + column, (first.values.row(row) - second.values.row(row)).transpose());
    names->InsertNextValue(column);
    const msi::ChannelDifference& d = differences[k];
    samples->InsertNextValue(static_cast<int>(d.samples));
    figures.row(row) << d.mean, d.rms, d.gain, d.offset, d.rmsAroundLine;
  }
  channels->AddColumn(names);
  channels->AddColumn(samples);
  const std::array<const char*, 5> titles = { "mean", "rms", "gain", "offset", "rms_around_line" };
  for (std::size_t i = 0; i < titles.size(); ++i)
  {
    msi::setNumbers(channels, titles[i], figures.col(static_cast<Eigen::Index>(i)));
  }
}
}

vtkResponseDifference::vtkResponseDifference()
{
  this->SetNumberOfInputPorts(2);
  this->SetNumberOfOutputPorts(2);
}

void vtkResponseDifference::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

int vtkResponseDifference::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  return 1;
}

int vtkResponseDifference::FillOutputPortInformation(int port, vtkInformation* info)
{
  info->Set(vtkDataObject::DATA_TYPE_NAME(), port == 0 ? "vtkDataObject" : "vtkTable");
  return 1;
}

int vtkResponseDifference::RequestDataObject(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  auto* input = vtkDataObject::GetData(inputs[0]);
  if (!input)
  {
    return 0;
  }
  auto* difference = vtkDataObject::GetData(outputs, 0);
  if (!difference || !difference->IsA(input->GetClassName()))
  {
    vtkSmartPointer<vtkDataObject> fresh;
    fresh.TakeReference(input->NewInstance());
    outputs->GetInformationObject(0)->Set(vtkDataObject::DATA_OBJECT(), fresh);
  }
  if (!vtkTable::GetData(outputs, 1))
  {
    vtkNew<vtkTable> channels;
    outputs->GetInformationObject(1)->Set(vtkDataObject::DATA_OBJECT(), channels);
  }
  return 1;
}

int vtkResponseDifference::RequestInformation(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      msi::requireSameSize(inputs[0]->GetInformationObject(0), NameOf[0],
        inputs[1]->GetInformationObject(0), NameOf[1], "both must show the same region");
    });
}

int vtkResponseDifference::RequestUpdateExtent(
  vtkInformation* request, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  for (int port = 0; port < 2; ++port)
  {
    if (vtkTable::GetData(inputs[port]))
    {
      msi::requestWhole(inputs, port);
    }
  }
  return this->Superclass::RequestUpdateExtent(request, inputs, outputs);
}

int vtkResponseDifference::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      if (auto* real = vtkTable::GetData(inputs[0]))
      {
        compareTables(real, vtkTable::GetData(inputs[1]), vtkTable::GetData(outputs, 0),
          vtkTable::GetData(outputs, 1));
        return;
      }
      auto* real = vtkImageData::GetData(inputs[0]);
      auto* simulated = vtkImageData::GetData(inputs[1]);
      if (!real || !simulated)
      {
        throw std::invalid_argument("one input is an image and the other is none; expected two "
                                    "sample tables or two images");
      }
      this->CompareImages(real, simulated, vtkImageData::GetData(outputs, 0));
    });
}

void vtkResponseDifference::CompareImages(
  vtkImageData* real, vtkImageData* simulated, vtkImageData* output)
{
  auto* array = msi::requireSpectralArray(real, NameOf[0]);
  const auto a = msi::asFloats(array);
  const auto b = msi::asFloats(msi::requireSpectralArray(simulated, NameOf[1]));
  if (a->GetNumberOfComponents() != b->GetNumberOfComponents() ||
    a->GetNumberOfTuples() != b->GetNumberOfTuples())
  {
    throw std::invalid_argument(std::string(NameOf[0]) + " are " +
      std::to_string(a->GetNumberOfTuples()) + " pixels of " +
      std::to_string(a->GetNumberOfComponents()) + " channels, " + NameOf[1] + " " +
      std::to_string(b->GetNumberOfTuples()) + " of " + std::to_string(b->GetNumberOfComponents()) +
      "; expected the same");
  }
  output->ShallowCopy(real);
  vtkNew<vtkFloatArray> difference;
  difference->SetName("Difference");
  difference->SetNumberOfComponents(a->GetNumberOfComponents());
  difference->SetNumberOfTuples(a->GetNumberOfTuples());
  const float* first = a->GetPointer(0);
  const float* second = b->GetPointer(0);
  float* out = difference->GetPointer(0);
  msi::forBlocks(this, a->GetNumberOfValues(),
    [&](vtkIdType begin, vtkIdType end) {
      std::transform(first + begin, first + end, second + begin, out + begin, std::minus<float>());
    });
  msi::setAxis(output, difference, msi::axisOf(real, array));
  msi::replaceArray(output, array, difference);
  msi::removePicture(output);
}
