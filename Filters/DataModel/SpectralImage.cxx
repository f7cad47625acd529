#include "SpectralImage.h"

#include "vtkDataArray.h"
#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"

#include <sstream>
#include <stdexcept>

namespace msi
{

namespace
{
std::string arrayNames(vtkPointData* points)
{
  std::ostringstream names;
  for (int i = 0; i < points->GetNumberOfArrays(); ++i)
  {
    const char* name = points->GetArrayName(i);
    names << (i > 0 ? ", " : "") << '\'' << (name ? name : "(unnamed)") << '\'';
  }
  return names.str();
}
}

vtkDataArray* requireSpectralArray(
  vtkImageData* image, const std::string& nameOfImage, const char* arrayName)
{
  vtkPointData* points = image ? image->GetPointData() : nullptr;
  if (!points || points->GetNumberOfArrays() == 0)
  {
    throw std::invalid_argument(nameOfImage + " has no point array; expected a spectral image");
  }
  vtkDataArray* array = nullptr;
  if (arrayName && *arrayName)
  {
    array = points->GetArray(arrayName);
    if (!array)
    {
      throw std::invalid_argument(
        nameOfImage + " has no point array '" + arrayName + "'; it has " + arrayNames(points));
    }
    return array;
  }
  array = points->GetScalars();
  if (array && isPictureName(array->GetName()))
  {
    for (const char* name : { ReflectanceArray, ResponsesArray })
    {
      if (auto* spectra = points->GetArray(name))
      {
        return spectra;
      }
    }
  }
  if (!array && points->GetNumberOfArrays() == 1)
  {
    array = points->GetArray(0);
  }
  if (!array)
  {
    throw std::invalid_argument(nameOfImage +
      " has several point arrays and none is active; choose one of " + arrayNames(points));
  }
  return array;
}

vtkDataArray* requireReflectanceArray(
  vtkImageData* image, const std::string& nameOfImage, const char* arrayName)
{
  auto* array = requireSpectralArray(image, nameOfImage, arrayName);
  const bool named = arrayName && *arrayName;
  if (!named && array->GetName() && std::string(array->GetName()) == ResponsesArray)
  {
    throw std::invalid_argument(nameOfImage +
      " holds camera responses (the array 'Responses'); expected reflectance; estimate it with "
      "Reflectance Estimation, or, where the values are reflectance, set Array Kind of the "
      "image's reader to Reflectance");
  }
  return array;
}

bool isPictureName(const char* arrayName)
{
  const std::string name = arrayName ? arrayName : "";
  return name == PictureArray || name == FalseColorArray;
}

void requireOneLabelPerPixel(vtkDataArray* labels, const std::string& nameOfImage)
{
  if (labels->GetNumberOfComponents() != 1)
  {
    throw std::invalid_argument(nameOfImage + " has " +
      std::to_string(labels->GetNumberOfComponents()) +
      " components a pixel; expected one label per pixel");
  }
}

SpectralAxis axisOf(vtkImageData* image, vtkDataArray* array)
{
  const auto components = array->GetNumberOfComponents();
  auto* stored = image->GetFieldData()->GetArray(WavelengthArray);
  if (stored && stored->GetNumberOfTuples() == components)
  {
    std::vector<double> wavelengths(static_cast<std::size_t>(components));
    for (int i = 0; i < components; ++i)
    {
      wavelengths[static_cast<std::size_t>(i)] = stored->GetComponent(i, 0);
    }
    return axisOf(WavelengthGrid(std::move(wavelengths)));
  }
  SpectralAxis axis;
  for (int i = 0; i < components; ++i)
  {
    const char* name = array->GetComponentName(i);
    axis.names.push_back(name && *name ? name : "C" + std::to_string(i + 1));
  }
  return axis;
}

vtkSmartPointer<vtkFloatArray> asFloats(vtkDataArray* array)
{
  vtkSmartPointer<vtkFloatArray> floats = vtkFloatArray::FastDownCast(array);
  if (!floats)
  {
    floats = vtkSmartPointer<vtkFloatArray>::New();
    floats->DeepCopy(array);
  }
  return floats;
}

void replaceArray(vtkImageData* image, vtkDataArray* old, vtkDataArray* array)
{
  auto* points = image->GetPointData();
  for (int i = points->GetNumberOfArrays() - 1; old && i >= 0; --i)
  {
    if (points->GetAbstractArray(i) == old)
    {
      points->RemoveArray(i);
    }
  }
  points->SetActiveAttribute(points->AddArray(array), vtkDataSetAttributes::SCALARS);
}

void nameComponents(vtkDataArray* array, const SpectralAxis& axis)
{
  for (std::size_t i = 0; i < axis.size(); ++i)
  {
    const std::string name = axis.wavelengths ? axis.names[i] + " nm" : axis.names[i];
    array->SetComponentName(static_cast<vtkIdType>(i), name.c_str());
  }
}

void setAxis(vtkDataObject* data, vtkDataArray* array, const SpectralAxis& axis)
{
  nameComponents(array, axis);
  for (const char* name : { WavelengthArray, FwhmArray, GoodBandsArray })
  {
    data->GetFieldData()->RemoveArray(name);
  }
  if (axis.wavelengths)
  {
    vtkNew<vtkDoubleArray> wavelengths;
    wavelengths->SetName(WavelengthArray);
    for (const double value : axis.wavelengths->values())
    {
      wavelengths->InsertNextValue(value);
    }
    data->GetFieldData()->AddArray(wavelengths);
  }
}

} // namespace msi
