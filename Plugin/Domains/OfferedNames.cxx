#include "OfferedNames.h"

#include "NameList.h"
#include "SampleColumns.h"

#include "Kernels/Camera/CameraEffect.h"
#include "Kernels/Colorimetry/ColorQuantity.h"
#include "Kernels/Colorimetry/Illuminant.h"
#include "Kernels/Difference/ColorDifference.h"
#include "Kernels/Difference/SpectralMetric.h"
#include "Kernels/Estimation/MethodComparison.h"

#include "vtkDataObject.h"
#include "vtkPVArrayInformation.h"
#include "vtkPVDataInformation.h"
#include "vtkPVDataSetAttributesInformation.h"
#include "vtkSMPropertyHelper.h"

#include <algorithm>

namespace msi
{

namespace
{
// With what is asked for most first, FL2 as F2, and the usual ones of all temperatures.
std::vector<std::string> illuminantNames()
{
  std::vector<std::string> names{ "D65", "D50" };
  for (std::string name : Illuminant::names())
  {
    if (name.compare(0, 2, "FL") == 0)
    {
      name.erase(1, 1);
    }
    if (name != names[0] && name != names[1])
    {
      names.push_back(std::move(name));
    }
  }
  names.insert(names.end(),
    { "E", "D55", "D75", "D4000K", "D5500K", "D7000K", "D9300K", "BB2700K", "BB3200K", "BB4000K",
      "BB5000K" });
  return names;
}

template <typename Records>
std::vector<std::string> namesOf(const Records& records)
{
  std::vector<std::string> names;
  names.reserve(records.size());
  for (const auto& record : records)
  {
    names.emplace_back(record.name);
  }
  return names;
}
}

std::vector<std::string> offeredNames(const std::string& kind)
{
  if (kind == "illuminants")
  {
    return illuminantNames();
  }
  if (kind == "differences")
  {
    return namesOf(colorDifferences());
  }
  if (kind == "metrics")
  {
    auto names = namesOf(colorDifferences());
    const auto spectral = namesOf(spectralMetrics());
    names.insert(names.end(), spectral.begin(), spectral.end());
    names.emplace_back(MetamerismMetric);
    return names;
  }
  if (kind == "methods")
  {
    return allMethodNames();
  }
  if (kind == "quantities")
  {
    return namesOf(colorQuantities());
  }
  return kind == "effects" ? namesOf(effectLibrary()) : std::vector<std::string>();
}

std::vector<std::string> pointArrayNames(vtkPVDataInformation* data)
{
  std::vector<std::string> names;
  auto* arrays = data->GetAttributeInformation(vtkDataObject::POINT);
  for (int i = 0; arrays && i < arrays->GetNumberOfArrays(); ++i)
  {
    if (const char* name = arrays->GetArrayInformation(i)->GetName())
    {
      names.emplace_back(name);
    }
  }
  return names;
}

std::vector<std::string> withOwnNames(
  vtkPVDataInformation* table, const std::vector<std::string>& names, vtkSMProperty* property)
{
  std::vector<std::string> all;
  auto* columns = table ? table->GetAttributeInformation(vtkDataObject::ROW) : nullptr;
  for (int i = 0; columns && i < columns->GetNumberOfArrays(); ++i)
  {
    const char* name = columns->GetArrayInformation(i)->GetName();
    if (name && name != std::string(WavelengthColumn))
    {
      all.emplace_back(name);
    }
  }
  all.insert(all.end(), names.begin(), names.end());
  const vtkSMPropertyHelper value(property, true);
  for (unsigned int i = 0; i < value.GetNumberOfElements(); ++i)
  {
    const std::string name = value.GetAsString(i);
    if (!name.empty() && std::find(all.begin(), all.end(), name) == all.end())
    {
      all.push_back(name);
    }
  }
  return all;
}

} // namespace msi
