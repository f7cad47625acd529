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

#include <cmath>
#include <cstdlib>
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

std::size_t indexOf(const msi::SpectralAxis& axis, const std::string& channel)
{
  char* unit = nullptr;
  const double number = std::strtod(channel.c_str(), &unit);
  const bool inNanometres = std::string(unit) == " nm";
  for (std::size_t i = 0; i < axis.size(); ++i)
  {
    const bool found = inNanometres && axis.wavelengths
      ? std::abs(axis.wavelengths->values()[i] - number) < 0.005
      : channel == axis.names[i] || channel == std::to_string(i + 1);
    if (found)
    {
      return i;
    }
  }
  throw std::invalid_argument(
    "channel " + channel + " was chosen; the input has " + msi::describe(axis, "channels"));
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
  for (const std::string& channel : this->Channels)
  {
    os << " " << channel;
  }
  os << "\n";
}

void vtkChannelSelection::AddChannel(const char* channel)
{
  this->Channels.emplace_back(channel ? channel : "");
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

std::vector<std::size_t> vtkChannelSelection::Chosen(const msi::SpectralAxis& axis) const
{
  std::set<std::size_t> chosen;
  for (const std::string& channel : this->Channels)
  {
    chosen.insert(indexOf(axis, channel));
  }
  if (chosen.empty())
  {
    for (std::size_t i = 0; i < axis.size(); ++i)
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
        const auto chosen = this->Chosen(responses.axis);
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
      const auto chosen = this->Chosen(axis);
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
