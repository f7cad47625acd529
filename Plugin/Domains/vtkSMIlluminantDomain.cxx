#include "vtkSMIlluminantDomain.h"

#include "SampleColumns.h"

#include "Kernels/Colorimetry/Illuminant.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMProperty.h"

#include <string>
#include <vector>

vtkStandardNewMacro(vtkSMIlluminantDomain);

namespace
{
// With the daylights and blackbodies that are asked for most, of all temperatures.
std::vector<std::string> offeredNames()
{
  std::vector<std::string> names = msi::Illuminant::names();
  names.insert(names.end(),
    { "D4000K", "D5500K", "D7000K", "D9300K", "BB2700K", "BB3200K", "BB4000K", "BB5000K" });
  return names;
}
}

void vtkSMIlluminantDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

void vtkSMIlluminantDomain::Update(vtkSMProperty*)
{
  std::vector<std::string> names = offeredNames();
  auto* table =
    this->GetRequiredProperty("Input") ? this->GetInputDataInformation("Input") : nullptr;
  if (table)
  {
    // The user's own first.
    std::vector<std::string> own;
    auto* columns = table->GetAttributeInformation(vtkDataObject::ROW);
    for (int i = 0; i < columns->GetNumberOfArrays(); ++i)
    {
      const char* name = columns->GetArrayInformation(i)->GetName();
      if (name && name != std::string(msi::WavelengthColumn))
      {
        own.emplace_back(name);
      }
    }
    names.insert(names.begin(), own.begin(), own.end());
  }
  this->SetStrings(names);
}

int vtkSMIlluminantDomain::ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element)
{
  const int result = this->Superclass::ReadXMLAttributes(property, element);
  this->SetStrings(offeredNames());
  return result;
}
