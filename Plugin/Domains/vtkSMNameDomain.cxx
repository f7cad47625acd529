#include "vtkSMNameDomain.h"

#include "NameList.h"
#include "OfferedNames.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"

vtkStandardNewMacro(vtkSMNameDomain);

void vtkSMNameDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Names: " << this->Names.size() << "\n";
}

void vtkSMNameDomain::Update(vtkSMProperty*)
{
  auto* data =
    this->GetRequiredProperty("Input") ? this->GetInputDataInformation("Input") : nullptr;
  auto names = this->Names;
  if (this->IsOfArrays && data)
  {
    const auto arrays = msi::pointArrayNames(data);
    names.insert(names.end(), arrays.begin(), arrays.end());
  }
  if (auto* list = this->GetRequiredProperty("Names"))
  {
    const vtkSMPropertyHelper text(list, true);
    const auto listed = msi::namesIn(
      text.GetNumberOfElements() > 0 ? std::string(text.GetAsString()) + "\n" : std::string());
    names.insert(names.end(), listed.begin(), listed.end());
  }
  this->SetStrings(
    msi::withOwnNames(this->IsOfArrays ? nullptr : data, names, this->GetProperty()));
}

int vtkSMNameDomain::ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element)
{
  const int result = this->Superclass::ReadXMLAttributes(property, element);
  const std::string kind = element->GetAttributeOrEmpty("of");
  this->IsOfArrays = kind == "arrays";
  this->Names =
    this->IsOfArrays || kind == "listed" ? std::vector<std::string>{ "" } : msi::offeredNames(kind);
  if (const char* last = element->GetAttribute("with"))
  {
    this->Names.emplace_back(last);
  }
  this->SetStrings(this->Names);
  property->AddObserver(vtkCommand::ModifiedEvent, this, &vtkSMNameDomain::OnPropertyModified);
  return result;
}
