// The picture that goes with an image's spectra: point array "sRGB" or "False Color", 3 bytes a
// pixel, which views show first.
#ifndef ImagePicture_h
#define ImagePicture_h

class vtkAlgorithm;
class vtkDataArray;
class vtkImageData;
class vtkUnsignedCharArray;

namespace msi
{

// Gives the image the picture of these spectra (Kernels/Colorimetry/SpectralPicture.h), in the place of any other one,
// and leaves the active scalars as they are. White is the value of the field data "PictureWhite", else 1.
// Throws std::runtime_error where 'self' was stopped.
void setPicture(vtkAlgorithm* self, vtkImageData* image, vtkDataArray* spectra);

// The image's picture; null where it has none.
vtkUnsignedCharArray* findPicture(vtkImageData* image);

// Takes away a picture that would show something else than the image's spectra, and its white.
void removePicture(vtkImageData* image);

// The value that the picture shows as white.
void setPictureWhite(vtkImageData* image, double white);

} // namespace msi

#endif
