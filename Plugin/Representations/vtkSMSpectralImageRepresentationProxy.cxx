#include "vtkSMSpectralImageRepresentationProxy.h"

#include "SpectralColors.h"

#include "vtkCommand.h"
#include "vtkDataObject.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMSourceProxy.h"
#include "vtkSMTransferFunctionManager.h"

#include <iterator>
#include <string>
#include <utility>

vtkStandardNewMacro(vtkSMSpectralImageRepresentationProxy);

namespace
{
// ParaView writes the ends of a legend as 2.4e+01. A format that a user has chosen stays.
void writePlainNumbers(vtkSMProxy* legend)
{
  constexpr const char* Plain = "%.4g";
  for (const auto& [name, format] :
    { std::pair("LabelFormat", "%-#6.3g"), std::pair("RangeLabelFormat", "%-#6.1e") })
  {
    vtkSMPropertyHelper helper(legend, name, true);
    const char* now = helper.GetNumberOfElements() > 0 ? helper.GetAsString() : "";
    if (now == std::string(format))
    {
      helper.Set(Plain);
      vtkSMPropertyHelper(legend, "AutomaticLabelFormat", true).Set(0);
    }
  }
  legend->UpdateVTKObjects();
}

// A legend with the steps by which color differences are judged.
void styleDifferenceLegend(vtkSMProxy* legend, const std::string& arrayName)
{
  constexpr double Steps[] = { 0.0, 1.0, 2.0, 3.0, 5.0 };
  vtkSMPropertyHelper(legend, "Title").Set(("\u0394" + arrayName.substr(1)).c_str());
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

vtkPVDataInformation* vtkSMSpectralImageRepresentationProxy::InputInformation()
{
  vtkSMPropertyHelper helper(this, "Input", true);
  auto* input = helper.GetNumberOfElements() > 0
    ? vtkSMSourceProxy::SafeDownCast(helper.GetAsProxy())
    : nullptr;
  return input ? input->GetDataInformation(helper.GetOutputPort()) : nullptr;
}

vtkPVArrayInformation* vtkSMSpectralImageRepresentationProxy::ColorArray()
{
  auto* property = this->GetProperty("ColorArrayName");
  auto* information = this->InputInformation();
  if (!property || !information)
  {
    return nullptr;
  }
  vtkSMPropertyHelper color(property);
  const char* name =
    color.GetNumberOfElements() == 5 ? color.GetInputArrayNameToProcess() : nullptr;
  if (!name || !*name)
  {
    return nullptr;
  }
  return information->GetArrayInformation(name, color.GetInputArrayAssociation());
}

void vtkSMSpectralImageRepresentationProxy::AdaptMapScalars()
{
  auto* array = this->ColorArray();
  auto* property = this->GetProperty("MapScalars");
  if (!array || !property)
  {
    return;
  }
  const int wanted = msi::isPicture(array) ? 0 : 1;
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
  auto* array = done ? this->ColorArray() : nullptr;
  auto* colors = done ? vtkSMPropertyHelper(this, "LookupTable", true).GetAsProxy() : nullptr;
  if (array && colors && !msi::isPicture(array))
  {
    msi::styleColors(colors, array, this->InputInformation(), !useComponent);
  }
  return done;
}

bool vtkSMSpectralImageRepresentationProxy::SetRepresentationType(const char* type)
{
  auto* known = this->IsFirstType ? this->InputInformation() : nullptr;
  const char* own = known ? msi::typeWithoutArea(known) : nullptr;
  const bool done = this->Superclass::SetRepresentationType(own ? own : type);
  // A volume is an outline at first, which takes the colors away that its surface needs.
  auto* data = this->ColorArray() ? nullptr : known;
  this->IsFirstType = false;
  auto* array =
    data ? msi::arrayToShow(data->GetAttributeInformation(vtkDataObject::POINT)) : nullptr;
  if (array)
  {
    this->SetScalarColoring(array->GetName(), vtkDataObject::POINT);
  }
  return done;
}

bool vtkSMSpectralImageRepresentationProxy::SetScalarBarVisibility(vtkSMProxy* view, bool visible)
{
  auto* array = this->ColorArray();
  if (!this->Superclass::SetScalarBarVisibility(view, visible && !msi::isPicture(array)))
  {
    return false;
  }
  vtkNew<vtkSMTransferFunctionManager> manager;
  auto* colors = visible && array ? vtkSMPropertyHelper(this, "LookupTable").GetAsProxy() : nullptr;
  if (auto* legend = colors ? manager->GetScalarBarRepresentation(colors, view) : nullptr)
  {
    writePlainNumbers(legend);
    if (msi::isColorDifference(array->GetName()))
    {
      styleDifferenceLegend(legend, array->GetName());
    }
  }
  return true;
}
