#include "vtkSMNameTicksDomain.h"

#include "OfferedNames.h"

#include "vtkCommand.h"
#include "vtkObjectFactory.h"
#include "vtkPVXMLElement.h"
#include "vtkSMProperty.h"

vtkStandardNewMacro(vtkSMNameTicksDomain);

void vtkSMNameTicksDomain::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "Names: " << this->Names.size() << "\n";
}

void vtkSMNameTicksDomain::Update(vtkSMProperty*)
{
  auto* table =
    this->GetRequiredProperty("Input") ? this->GetInputDataInformation("Input") : nullptr;
  this->SetStrings(msi::withOwnNames(table, this->Names, this->GetProperty()));
}

int vtkSMNameTicksDomain::ReadXMLAttributes(vtkSMProperty* property, vtkPVXMLElement* element)
{
  const int result = this->Superclass::ReadXMLAttributes(property, element);
  this->Names = msi::offeredNames(element->GetAttributeOrEmpty("of"));
  this->SetStrings(this->Names);
  property->AddObserver(vtkCommand::ModifiedEvent, this, &vtkSMNameTicksDomain::OnPropertyModified);
  return result;
}

int vtkSMNameTicksDomain::SetDefaultValues(vtkSMProperty*, bool)
{
  return 0; // those of the property
}
