// A spectral image: vtkImageData with one point array of one component per wavelength or channel.
//
// The array is named "Reflectance" (1 = perfect white), "Responses" (camera responses, 1 = perfect
// white) or, behind a reader that was told nothing, anything else. The field data carry "Wavelength"
// (nm, one value per component). Other point arrays may stand beside it.
#ifndef SpectralImage_h
#define SpectralImage_h

#include "SpectralAxis.h"

#include "vtkSmartPointer.h"

class vtkDataArray;
class vtkDataObject;
class vtkFloatArray;
class vtkImageData;

namespace msi
{

inline constexpr const char* ReflectanceArray = "Reflectance";
inline constexpr const char* ResponsesArray = "Responses";
inline constexpr const char* UncertaintyArray = "Uncertainty";
inline constexpr const char* LabelArray = "Label";
// 3 bytes a pixel, for views: colors, or three of the channels where colors cannot be computed.
inline constexpr const char* PictureArray = "sRGB";
inline constexpr const char* FalseColorArray = "False Color";
// Field data: the value of the spectra that the picture shows as white; 1 where it is missing.
inline constexpr const char* PictureWhiteArray = "PictureWhite";
inline constexpr const char* WavelengthArray = "Wavelength";
inline constexpr const char* FwhmArray = "FWHM"; // field data: nm, one value per component
inline constexpr const char* GoodBandsArray =
  "GoodBands"; // field data: 0 where a file marks a band as bad
// Field data: "key = value". Not "Metadata": VTK's legacy format, in which servers send tables, takes that for its own
// keyword.
inline constexpr const char* FileMetadataArray = "FileMetadata";

// The spectral array of an image: the named one, else the active scalars (where they are a picture: "Reflectance" or
// "Responses" beside it), else the only point array.
// Throws std::invalid_argument, naming what the image holds, where there is none.
vtkDataArray* requireSpectralArray(
  vtkImageData* image, const std::string& nameOfImage, const char* arrayName = nullptr);

// The same for reflectance: camera responses are refused unless their array is named.
vtkDataArray* requireReflectanceArray(
  vtkImageData* image, const std::string& nameOfImage, const char* arrayName);

bool isPictureName(const char* arrayName);

// Throws std::invalid_argument where an array of labels has several components.
void requireOneLabelPerPixel(vtkDataArray* labels, const std::string& nameOfImage);

// The axis of that array: wavelengths from the field data where their number fits, else names from
// the component names, else C1, C2, ...
SpectralAxis axisOf(vtkImageData* image, vtkDataArray* array);

// The array itself where it is of floats, else a copy in floats with the same names.
vtkSmartPointer<vtkFloatArray> asFloats(vtkDataArray* array);

// Puts an array in the place of another one (null: of none) and makes it the active scalars. All other arrays
// stay; vtkPointData::SetScalars would drop the ones that were active before.
void replaceArray(vtkImageData* image, vtkDataArray* old, vtkDataArray* array);

// Names the array's components.
void nameComponents(vtkDataArray* array, const SpectralAxis& axis);

// Names the array's components and stores the wavelengths as field data; what else the field data said of the
// bands that were there before is dropped.
void setAxis(vtkDataObject* data, vtkDataArray* array, const SpectralAxis& axis);

} // namespace msi

#endif
