#include "SpectralColors.h"

#include "vtkDataObject.h"
#include "vtkDataSetAttributes.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMCoreUtilities.h"
#include "vtkSMPropertyHelper.h"
#include "vtkSMProxy.h"
#include "vtkSMSettings.h"
#include "vtkSMTransferFunctionProxy.h"

#include <algorithm>
#include <cmath>

namespace msi
{

namespace
{
constexpr double Gray[] = { 0.8, 0.8, 0.8 };
// Viridis (S. van der Walt and N. Smith, CC0) at 0, 1/4, 1/2, 3/4 and 1: value, red, green, blue.
constexpr double StepsOfDifference[] = { 0, 0.267004, 0.004874, 0.329415, //
  1, 0.229739, 0.322361, 0.545706,                                        //
  2, 0.127568, 0.566949, 0.550556,                                        //
  3, 0.369214, 0.788888, 0.382914,                                        //
  5, 0.993248, 0.906157, 0.143936 };
constexpr int Lab = 2;       // ColorSpace
constexpr int Component = 1; // VectorMode
constexpr int Never = -1;    // AutomaticRescaleRangeMode

template <std::size_t Size>
void set(vtkSMProxy* proxy, const char* property, const double (&values)[Size])
{
  vtkSMPropertyHelper(proxy, property).Set(values, static_cast<unsigned int>(Size));
}

bool hasSettingsOf(const std::string& arrayName)
{
  const std::string key = vtkSMCoreUtilities::SanitizeName(arrayName.c_str());
  auto* settings = vtkSMSettings::GetInstance();
  return settings->HasSetting((".standard_presets." + key).c_str()) ||
    settings->HasSetting((".array_lookup_tables." + key).c_str());
}

bool isSigned(const std::string& arrayName)
{
  return arrayName == "Difference" || arrayName == "Gap" || arrayName == "GapAfter";
}

void styleNewColors(vtkSMProxy* colors, const std::string& name)
{
  if (isColorDifference(name))
  {
    set(colors, "RGBPoints", StepsOfDifference);
    vtkSMPropertyHelper(colors, "ColorSpace").Set(Lab);
    vtkSMPropertyHelper(colors, "ScalarRangeInitialized").Set(1);
    vtkSMPropertyHelper(colors, "AutomaticRescaleRangeMode").Set(Never);
  }
  else if (isSigned(name))
  {
    vtkSMTransferFunctionProxy::ApplyPreset(colors, "Cool to Warm", false);
    vtkSMPropertyHelper(colors, "AutomaticRescaleRangeMode").Set(Never);
  }
  else
  {
    vtkSMTransferFunctionProxy::ApplyPreset(colors, "Viridis (matplotlib)", false);
  }
  set(colors, "NanColor", Gray);
}

void centerOnZero(vtkSMProxy* colors, vtkPVArrayInformation* array, vtkPVDataInformation* data)
{
  // What is left of a gap is shown on the gap's own scale.
  auto* gap = data && std::string(array->GetName()) == "GapAfter"
    ? data->GetArrayInformation("Gap", vtkDataObject::POINT)
    : nullptr;
  array = gap ? gap : array;
  double largest = 0.0;
  for (int i = 0; i < array->GetNumberOfComponents(); ++i)
  {
    double range[2] = { 0.0, 0.0 };
    array->GetComponentFiniteRange(i, range);
    largest = std::max({ largest, std::abs(range[0]), std::abs(range[1]) });
  }
  // No difference at all has the color of zero, too.
  largest = largest > 0.0 && std::isfinite(largest) ? largest : 1.0;
  vtkSMTransferFunctionProxy::RescaleTransferFunction(colors, -largest, largest, false);
}
}

bool isPicture(vtkPVArrayInformation* array)
{
  if (!array || array->GetDataType() != VTK_UNSIGNED_CHAR || array->GetNumberOfComponents() < 3)
  {
    return false;
  }
  const std::string name = array->GetName() ? array->GetName() : "";
  return name == "sRGB" || name == "False Color" || name == "Display P3" || name == "Overlay";
}

bool isColorDifference(const std::string& arrayName)
{
  return arrayName.compare(0, 2, "dE") == 0 && arrayName.find(' ') != std::string::npos;
}

vtkPVArrayInformation* arrayToShow(vtkPVDataSetAttributesInformation* points)
{
  auto* chosen = points->GetAttributeInformation(vtkDataSetAttributes::SCALARS);
  bool isDifference = false;
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    auto* array = points->GetArrayInformation(i);
    const std::string name = array->GetName() ? array->GetName() : "";
    if (isPicture(array))
    {
      return array;
    }
    if (name == "dE00 D65" || name == "Gap" || (!isDifference && isColorDifference(name)))
    {
      chosen = array;
      isDifference = true;
    }
  }
  return chosen                        ? chosen
    : points->GetNumberOfArrays() == 1 ? points->GetArrayInformation(0)
                                       : nullptr;
}

const char* typeWithoutArea(vtkPVDataInformation* data)
{
  const int* extent = data->GetExtent();
  int directions = 0;
  for (int i = 0; i < 6; i += 2)
  {
    if (extent[i] > extent[i + 1])
    {
      return nullptr;
    }
    directions += extent[i] < extent[i + 1] ? 1 : 0;
  }
  return directions > 1 ? nullptr : directions == 1 ? "Surface" : "Points";
}

void styleColors(
  vtkSMProxy* colors, vtkPVArrayInformation* array, vtkPVDataInformation* data, bool oneBand)
{
  const std::string name = array->GetName() ? array->GetName() : "";
  if (vtkSMPropertyHelper(colors, "ScalarRangeInitialized").GetAsInt() == 0 && !hasSettingsOf(name))
  {
    styleNewColors(colors, name);
    if (oneBand && array->GetNumberOfComponents() > 1)
    {
      vtkSMPropertyHelper(colors, "VectorMode").Set(Component);
      vtkSMPropertyHelper(colors, "VectorComponent").Set(0);
    }
    colors->UpdateVTKObjects();
  }
  if (isSigned(name))
  {
    centerOnZero(colors, array, data);
  }
}

} // namespace msi
