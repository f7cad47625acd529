#include "vtkSMSpectralImageInitializationHelper.h"

#include "vtkObjectFactory.h"
#include "vtkSMProperty.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"

vtkStandardNewMacro(vtkSMSpectralImageInitializationHelper);

void vtkSMSpectralImageInitializationHelper::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

void vtkSMSpectralImageInitializationHelper::PostInitializeProxy(
  vtkSMProxy* proxy, vtkPVXMLElement*, vtkMTimeType initializationTimeStamp)
{
  auto* property = proxy->GetProperty("MapScalars");
  if (property && property->GetMTime() <= initializationTimeStamp)
  {
    vtkSMPropertyHelper(property).Set(0);
    proxy->UpdateVTKObjects();
  }
}
