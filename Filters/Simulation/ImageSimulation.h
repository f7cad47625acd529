// The simulated camera on a spectral image, spread over threads.
#ifndef ImageSimulation_h
#define ImageSimulation_h

#include "ImagePieces.h"

#include "Kernels/Camera/CameraModel.h"
#include "Kernels/Camera/Imaging/ImageSimulator.h"

#include <string>

class vtkAlgorithm;
class vtkImageData;

namespace msi
{

struct ImageSimulationInput
{
  vtkImageData* image; // at least the pixels of `extent` and the simulator's halo around them
  std::string reflectanceArray; // empty: the active scalars
  std::string mediumArray;      // empty: every pixel is of medium 0
  Extent whole;                 // of the image in all pieces
  Extent extent;                // of the result
};

// Puts the responses (array "Responses") of `extent` into the output, with the other arrays and the frame of the
// image; the scene's mean, where it is needed, is that of all pixels given.
// Throws std::invalid_argument for a reflectance of another length than the simulator takes, or media that are no
// array of one component; std::runtime_error when aborted.
void simulateImage(vtkAlgorithm* algorithm, const ImageSimulator& simulator,
  const ImageSimulationInput& input, const CameraModel& camera, vtkImageData* output);

} // namespace msi

#endif
