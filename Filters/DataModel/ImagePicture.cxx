#include "ImagePicture.h"

#include "AlgorithmSupport.h"
#include "SpectralImage.h"

#include "vtkDoubleArray.h"
#include "vtkFieldData.h"
#include "vtkFloatArray.h"
#include "vtkImageData.h"
#include "vtkNew.h"
#include "vtkPointData.h"
#include "vtkUnsignedCharArray.h"

#include "Kernels/Colorimetry/SpectralPicture.h"

namespace msi
{

namespace
{
void removePictureArrays(vtkImageData* image)
{
  for (const char* name : { PictureArray, FalseColorArray })
  {
    image->GetPointData()->RemoveArray(name);
  }
}
}

void setPicture(vtkAlgorithm* self, vtkImageData* image, vtkDataArray* spectra)
{
  const auto axis = axisOf(image, spectra);
  auto* stored = image->GetFieldData()->GetArray(PictureWhiteArray);
  const double white = stored && stored->GetNumberOfValues() == 1 ? stored->GetTuple1(0) : 1.0;
  const SpectralPicture picture(spectra->GetNumberOfComponents(),
    axis.wavelengths ? axis.wavelengths->values() : std::vector<double>(), {}, white);
  const auto floats = asFloats(spectra);
  vtkNew<vtkUnsignedCharArray> colors;
  colors->SetName(picture.isColorimetric() ? PictureArray : FalseColorArray);
  colors->SetNumberOfComponents(3);
  colors->SetNumberOfTuples(floats->GetNumberOfTuples());
  const float* in = floats->GetPointer(0);
  unsigned char* out = colors->GetPointer(0);
  const vtkIdType bands = floats->GetNumberOfComponents();
  forBlocks(self, floats->GetNumberOfTuples(),
    [&](vtkIdType begin, vtkIdType end)
    { picture.apply(in + begin * bands, end - begin, out + 3 * begin); });
  removePictureArrays(image);
  image->GetPointData()->AddArray(colors);
}

vtkUnsignedCharArray* findPicture(vtkImageData* image)
{
  auto* points = image->GetPointData();
  auto* colors = vtkUnsignedCharArray::SafeDownCast(points->GetArray(PictureArray));
  return colors ? colors : vtkUnsignedCharArray::SafeDownCast(points->GetArray(FalseColorArray));
}

void removePicture(vtkImageData* image)
{
  removePictureArrays(image);
  image->GetFieldData()->RemoveArray(PictureWhiteArray);
}

void setPictureWhite(vtkImageData* image, double white)
{
  vtkNew<vtkDoubleArray> array;
  array->SetName(PictureWhiteArray);
  array->InsertNextValue(white);
  image->GetFieldData()->AddArray(array);
}

} // namespace msi
