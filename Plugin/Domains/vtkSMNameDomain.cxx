#include "vtkSMNameDomain.h"

#include "OfferedNames.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"

vtkStandardNewMacro(vtkSMNameDomain);

void vtkSMNameDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Names: " << this->Names.size() << "\n";
}

void vtkSMNameDomain::Update(vtkSMProperty*)
{
  auto* table =
    this->GetRequiredProperty("Input") ? this->GetInputDataInformation("Input") : nullptr;
  this->SetStrings(msi::withOwnNames(table, this->Names, this->GetProperty()));
}

int vtkSMNameDomain::ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element)
{
  const int result = this->Superclass::ReadXMLAttributes(property, element);
  this->Names = msi::offeredNames(element->GetAttributeOrEmpty("of"));
  if (const char* last = element->GetAttribute("with"))
  {
    this->Names.emplace_back(last);
  }
  this->SetStrings(this->Names);
  property->AddObserver(vtkCommand::ModifiedEvent, this, &vtkSMNameDomain::OnPropertyModified);
  return result;
}
