#include "vtkChannelSelection.h"

#include "AlgorithmSupport.h"
#include "ImagePicture.h"
#include "SampleColumns.h"
#include "SpectralImage.h"

#include "vtkDataArray.h"
#include "vtkFieldData.h"
#include "vtkImageData.h"
#include "vtkObjectFactory.h"
#include "vtkPointData.h"
#include "vtkSmartPointer.h"
#include "vtkTable.h"

#include <set>
#include <stdexcept>
#include <string>

vtkStandardNewMacro(vtkChannelSelection);

namespace
{
msi::SpectralAxis subset(const msi::SpectralAxis& axis, const std::vector<std::size_t>& chosen)
{
  msi::SpectralAxis result;
  std::vector<double> wavelengths;
  for (const auto i : chosen)
  {
    result.names.push_back(axis.names[i]);
    if (axis.wavelengths)
    {
      wavelengths.push_back(axis.wavelengths->values()[i]);
    }
  }
  if (axis.wavelengths)
  {
    result.wavelengths = msi::WavelengthGrid(std::move(wavelengths));
  }
  return result;
}

// The chosen values of a field that has one a channel.
void addChosen(vtkImageData* output, vtkDataArray* field, std::size_t channels,
  const std::vector<std::size_t>& chosen)
{
  if (!field || field->GetNumberOfTuples() != static_cast<vtkIdType>(channels))
  {
    return;
  }
  auto cut = vtkSmartPointer<vtkDataArray>::Take(field->NewInstance());
  cut->SetName(field->GetName());
  for (const auto i : chosen)
  {
    cut->InsertNextTuple(static_cast<vtkIdType>(i), field);
  }
  output->GetFieldData()->AddArray(cut);
}
}

vtkChannelSelection::vtkChannelSelection()
{
  this->SetNumberOfInputPorts(1);
  this->SetNumberOfOutputPorts(1);
}

void vtkChannelSelection::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Preview: " << this->Preview << "\n";
  os << indent << "Channels:";
  for (const int channel : this->Channels)
  {
    os << " " << channel;
  }
  os << "\n";
}

void vtkChannelSelection::AddChannel(int channel)
{
  this->Channels.push_back(channel);
  this->Modified();
}

void vtkChannelSelection::ClearChannels()
{
  this->Channels.clear();
  this->Modified();
}

int vtkChannelSelection::FillInputPortInformation(int, vtkInformation* info)
{
  info->Remove(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE());
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkImageData");
  info->Append(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  return 1;
}

std::vector<std::size_t> vtkChannelSelection::Chosen(std::size_t channels) const
{
  std::set<std::size_t> chosen;
  for (const int channel : this->Channels)
  {
    if (channel < 1 || static_cast<std::size_t>(channel) > channels)
    {
      throw std::invalid_argument("channel " + std::to_string(channel) +
        " was chosen; the input has channels 1 to " + std::to_string(channels));
    }
    chosen.insert(static_cast<std::size_t>(channel - 1));
  }
  if (chosen.empty())
  {
    for (std::size_t i = 0; i < channels; ++i)
    {
      chosen.insert(i);
    }
  }
  return { chosen.begin(), chosen.end() };
}

int vtkChannelSelection::RequestData(
  vtkInformation*, vtkInformationVector** inputs, vtkInformationVector* outputs)
{
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      if (auto* table = vtkTable::GetData(inputs[0]))
      {
        auto* output = vtkTable::GetData(outputs, 0);
        output->ShallowCopy(table);
        const auto responses =
          msi::requireSpectra(table, msi::SampleQuantity::Response, "the sample table");
        const auto chosen = this->Chosen(responses.axis.size());
        const std::set<std::size_t> kept(chosen.begin(), chosen.end());
        for (std::size_t i = 0; i < responses.axis.size(); ++i)
        {
          if (kept.count(i) == 0)
          {
            output->RemoveColumnByName(responses.columns[i].c_str());
          }
        }
        return;
      }
      auto* image = vtkImageData::GetData(inputs[0]);
      auto* array = msi::requireSpectralArray(image, "the image");
      const auto axis = msi::axisOf(image, array);
      const auto chosen = this->Chosen(axis.size());
      auto cut = vtkSmartPointer<vtkDataArray>::Take(array->NewInstance());
      cut->SetName(array->GetName());
      cut->SetNumberOfComponents(static_cast<int>(chosen.size()));
      cut->SetNumberOfTuples(array->GetNumberOfTuples());
      for (std::size_t i = 0; i < chosen.size(); ++i)
      {
        cut->CopyComponent(static_cast<int>(i), array, static_cast<int>(chosen[i]));
      }
      auto* output = vtkImageData::GetData(outputs, 0);
      output->ShallowCopy(image);
      msi::setAxis(output, cut, subset(axis, chosen));
      for (const char* name : { msi::FwhmArray, msi::GoodBandsArray })
      {
        addChosen(output, image->GetFieldData()->GetArray(name), axis.size(), chosen);
      }
      msi::replaceArray(output, array, cut);
      if (this->Preview)
      {
        msi::setPicture(this, output, cut);
      }
      else
      {
        msi::removePicture(output);
      }
    });
}
