#include "vtkSMSpectralImageInitializationHelper.h"

#include "vtkDataObject.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"

#include <string>

vtkStandardNewMacro(vtkSMSpectralImageInitializationHelper);

namespace
{
// The array to show at first; empty where there is nothing to prefer.
std::string arrayToShow(vtkPVDataSetAttributesInformation* points)
{
  std::string chosen;
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    auto* array = points->GetArrayInformation(i);
    std::string name = array->GetName() ? array->GetName() : "";
    if (name == "sRGB" && array->GetNumberOfComponents() == 3)
    {
      return name;
    }
    if (name == "dE00 D65" || (chosen.empty() && name.compare(0, 5, "dE00 ") == 0))
    {
      chosen = name;
    }
  }
  return chosen;
}
}

void vtkSMSpectralImageInitializationHelper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

void vtkSMSpectralImageInitializationHelper::PostInitializeProxy(
  vtkSMProxy* proxy, vtkPVXMLElement*, vtkMTimeType)
{
  vtkSMPropertyHelper input(proxy, "Input", true);
  auto* source =
    input.GetNumberOfElements() > 0 ? vtkSMSourceProxy::SafeDownCast(input.GetAsProxy()) : nullptr;
  auto* color = proxy->GetProperty("ColorArrayName");
  if (!source || !color)
  {
    return;
  }
  const auto name = arrayToShow(source->GetDataInformation(input.GetOutputPort())
                                  ->GetAttributeInformation(vtkDataObject::POINT));
  if (!name.empty())
  {
    vtkSMPropertyHelper(color).SetInputArrayToProcess(vtkDataObject::POINT, name.c_str());
    if (name == "sRGB")
    {
      vtkSMPropertyHelper(proxy, "MapScalars", true).Set(0);
    }
    proxy->UpdateVTKObjects();
  }
}
