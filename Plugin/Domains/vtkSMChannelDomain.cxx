#include "vtkSMChannelDomain.h"

#include "OfferedNames.h"
#include "SampleColumns.h"
#include "SpectralImage.h"

#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"

#include <cstdlib>
#include <map>
#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMChannelDomain);

namespace
{
// As requireSpectralArray chooses; null where there is none.
vtkPVArrayInformation* spectralArray(vtkPVDataSetAttributesInformation* points)
{
  auto* active = points->GetAttributeInformation(vtkDataSetAttributes::SCALARS);
  if (active && !msi::isPictureName(active->GetName()))
  {
    return active;
  }
  auto* reflectance = points->GetArrayInformation(msi::ReflectanceArray);
  return reflectance ? reflectance : points->GetArrayInformation(msi::ResponsesArray);
}

std::vector<std::string> channelNames(vtkPVDataInformation* data)
{
  std::vector<std::string> names;
  if (auto* array = spectralArray(data->GetAttributeInformation(vtkDataObject::POINT)))
  {
    for (int i = 0; i < array->GetNumberOfComponents(); ++i)
    {
      const char* name = array->GetComponentName(i);
      names.push_back(name ? name : "C" + std::to_string(i + 1));
    }
    return names;
  }
  // The columns C400, .. or C1, .. of a table, in the order of their numbers.
  std::map<double, std::string> columns;
  auto* rows = data->GetAttributeInformation(vtkDataObject::ROW);
  for (int i = 0; i < rows->GetNumberOfArrays(); ++i)
  {
    const std::string name =
      rows->GetArrayInformation(i)->GetName() ? rows->GetArrayInformation(i)->GetName() : "";
    if (name.size() < 2 || name[0] != 'C')
    {
      continue;
    }
    char* end = nullptr;
    const double number = std::strtod(name.c_str() + 1, &end);
    if (*end == '\0')
    {
      columns.emplace(number, number < msi::FirstWavelength ? name : name.substr(1) + " nm");
    }
  }
  for (const auto& column : columns)
  {
    names.push_back(column.second);
  }
  return names;
}
}

void vtkSMChannelDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

void vtkSMChannelDomain::Update(vtkSMProperty*)
{
  auto* data =
    this->GetRequiredProperty("Input") ? this->GetInputDataInformation("Input") : nullptr;
  if (!data)
  {
    return;
  }
  this->Names = channelNames(data);
  this->SetStrings(msi::withOwnNames(nullptr, this->Names, this->GetProperty()));
}

int vtkSMChannelDomain::SetDefaultValues(vtkSMProperty* property, bool use_unchecked_values)
{
  vtkSMPropertyHelper helper(property);
  helper.SetUseUnchecked(use_unchecked_values);
  helper.SetNumberOfElements(static_cast<unsigned int>(this->Names.size()));
  for (unsigned int i = 0; i < this->Names.size(); ++i)
  {
    helper.Set(i, this->Names[i].c_str());
  }
  return 1;
}
