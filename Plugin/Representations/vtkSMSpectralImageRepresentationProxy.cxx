#include "vtkSMSpectralImageRepresentationProxy.h"

#include "vtkCommand.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"
#include "vtkSMTransferFunctionProxy.h"

#include <algorithm>
#include <cmath>
#include <iterator>
#include <string>

vtkStandardNewMacro(vtkSMSpectralImageRepresentationProxy);

namespace
{
// As vtkImageSlice takes them without a color map.
bool areColors(vtkPVArrayInformation* array)
{
  return array && array->GetDataType() == VTK_UNSIGNED_CHAR && array->GetNumberOfComponents() >= 3;
}

bool startsWith(const std::string& text, const std::string& beginning)
{
  return text.compare(0, beginning.size(), beginning) == 0;
}

// A legend with the steps by which color differences are judged.
void styleDifferenceLegend(vtkSMProxy* legend, const std::string& arrayName)
{
  constexpr double Steps[] = { 0.0, 1.0, 2.0, 3.0, 5.0 };
  vtkSMPropertyHelper(legend, "Title").Set(("\u0394E00 " + arrayName.substr(5)).c_str());
  vtkSMPropertyHelper(legend, "ComponentTitle").Set("");
  vtkSMPropertyHelper(legend, "AddRangeLabels", true).Set(0);
  vtkSMPropertyHelper(legend, "AutomaticLabelFormat", true).Set(0);
  vtkSMPropertyHelper(legend, "LabelFormat", true).Set("%g");
  vtkSMPropertyHelper(legend, "UseCustomLabels", true).Set(1);
  vtkSMPropertyHelper(legend, "CustomLabels", true)
    .Set(Steps, static_cast<unsigned int>(std::size(Steps)));
  legend->UpdateVTKObjects();
}
}

vtkSMSpectralImageRepresentationProxy::vtkSMSpectralImageRepresentationProxy()
{
  // Properties that a proxy inside this one holds tell of their changes by this event alone.
  this->AddObserver(vtkCommand::PropertyModifiedEvent, this,
    &vtkSMSpectralImageRepresentationProxy::OnPropertyModified);
}

void vtkSMSpectralImageRepresentationProxy::OnPropertyModified(
  vtkObject*, unsigned long, void* name)
{
  if (name && std::string(static_cast<const char*>(name)) == "ColorArrayName")
  {
    this->AdaptMapScalars();
  }
}

void vtkSMSpectralImageRepresentationProxy::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
}

vtkPVArrayInformation* vtkSMSpectralImageRepresentationProxy::ColorArray()
{
  auto* property = this->GetProperty("ColorArrayName");
  vtkSMPropertyHelper inputHelper(this, "Input", true);
  if (!property || inputHelper.GetNumberOfElements() == 0)
  {
    return nullptr;
  }
  auto* input = vtkSMSourceProxy::SafeDownCast(inputHelper.GetAsProxy());
  vtkSMPropertyHelper color(property);
  const char* name =
    color.GetNumberOfElements() == 5 ? color.GetInputArrayNameToProcess() : nullptr;
  if (!input || !name || !*name)
  {
    return nullptr;
  }
  return input->GetDataInformation(inputHelper.GetOutputPort())
    ->GetArrayInformation(name, color.GetInputArrayAssociation());
}

void vtkSMSpectralImageRepresentationProxy::AdaptMapScalars()
{
  auto* array = this->ColorArray();
  auto* property = this->GetProperty("MapScalars");
  if (!array || !property)
  {
    return;
  }
  const int wanted = areColors(array) ? 0 : 1;
  vtkSMPropertyHelper helper(property);
  if (helper.GetAsInt() != wanted)
  {
    helper.Set(wanted);
  }
}

bool vtkSMSpectralImageRepresentationProxy::SetScalarColoringInternal(
  const char* arrayname, int attribute_type, bool useComponent, int component)
{
  const bool done =
    this->Superclass::SetScalarColoringInternal(arrayname, attribute_type, useComponent, component);
  if (done && arrayname && std::string(arrayname) == "Difference")
  {
    this->CenterRange();
  }
  return done;
}

void vtkSMSpectralImageRepresentationProxy::CenterRange()
{
  auto* array = this->ColorArray();
  vtkSMPropertyHelper lut(this, "LookupTable", true);
  auto* colors = lut.GetNumberOfElements() > 0 ? lut.GetAsProxy() : nullptr;
  if (!array || !colors)
  {
    return;
  }
  double largest = 0.0;
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    double range[2] = { 0.0, 0.0 };
    array->GetComponentFiniteRange(i, range);
    largest = std::max({ largest, std::abs(range[0]), std::abs(range[1]) });
  }
  if (largest > 0.0 && std::isfinite(largest))
  {
    vtkSMTransferFunctionProxy::RescaleTransferFunction(colors, -largest, largest, false);
  }
}

bool vtkSMSpectralImageRepresentationProxy::SetScalarBarVisibility(vtkSMProxy* view, bool visible)
{
  auto* array = this->ColorArray();
  if (!this->Superclass::SetScalarBarVisibility(view, visible && !areColors(array)))
  {
    return false;
  }
  if (visible && array && startsWith(array->GetName(), "dE00 "))
  {
    vtkNew<vtkSMTransferFunctionManager> manager;
    auto* colors = vtkSMPropertyHelper(this, "LookupTable").GetAsProxy();
    if (auto* legend = colors ? manager->GetScalarBarRepresentation(colors, view) : nullptr)
    {
      styleDifferenceLegend(legend, array->GetName());
    }
  }
  return true;
}
