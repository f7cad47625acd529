#include "vtkCameraWriter.h"

#include "CameraTable.h"

#include "vtkErrorCode.h"
#include "vtkInformation.h"
#include "vtkMultiProcessController.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Formats/CameraDescription.h"

#include <exception>
#include <stdexcept>

vtkStandardNewMacro(vtkCameraWriter);

void vtkCameraWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}

int vtkCameraWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  return 1;
}

void vtkCameraWriter::WriteData()
{
  auto* table = vtkTable::SafeDownCast(this->GetInput());
  auto* controller = vtkMultiProcessController::GetGlobalController();
  if (controller && controller->GetLocalProcessId() > 0)
  {
    return; // small tables stand whole on the first rank
  }
  try
  {
    if (this->FileName.empty())
    {
      throw std::invalid_argument("no file is given; set FileName");
    }
    const auto camera = msi::readCamera(table, "the camera");
    msi::CameraDescription description{ camera.camera };
    description.noise = camera.noise;
    description.whiteAfterEffects = camera.whiteAfterEffects;
    if (!camera.effects.empty())
    {
      description.effects =
        msi::parseEffectList("Effects", camera.effects, camera.camera.channels());
    }
    msi::writeCameraDescription(this->FileName, description);
  }
  catch (const std::exception& error)
  {
    this->SetErrorCode(vtkErrorCode::CannotOpenFileError);
    vtkErrorMacro(<< error.what());
  }
}
