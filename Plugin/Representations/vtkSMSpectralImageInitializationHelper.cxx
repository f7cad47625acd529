#include "vtkSMSpectralImageInitializationHelper.h"

#include "SpectralColors.h"

#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSessionProxyManager.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"

#include <string>

vtkStandardNewMacro(vtkSMSpectralImageInitializationHelper);

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
  auto* data = source->GetDataInformation(input.GetOutputPort());
  if (const char* type = msi::typeWithoutArea(data))
  {
    constexpr double Width = 12.0; // pixels of the screen
    vtkSMPropertyHelper(proxy, "Representation", true).Set(type);
    vtkSMPropertyHelper(proxy, "LineWidth", true).Set(Width);
    vtkSMPropertyHelper(proxy, "PointSize", true).Set(Width);
  }
  auto* array = msi::arrayToShow(data->GetAttributeInformation(vtkDataObject::POINT));
  if (!array)
  {
    return;
  }
  vtkSMPropertyHelper(color).SetInputArrayToProcess(vtkDataObject::POINT, array->GetName());
  if (msi::isPicture(array))
  {
    vtkSMPropertyHelper(proxy, "MapScalars", true).Set(0);
  }
  else
  {
    // ParaView takes the map of the array's name as it is then.
    vtkNew<vtkSMTransferFunctionManager> manager;
    auto* colors =
      manager->GetColorTransferFunction(array->GetName(), proxy->GetSessionProxyManager());
    msi::styleColors(colors, array, data, true);
  }
  proxy->UpdateVTKObjects();
}
