#include "vtkCameraWriter.h"

#include "CameraTable.h"
#include "TableWriting.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Formats/CameraDescription.h"

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
  this->SetErrorCode(msi::writeTable(this, this->FileName,
    [this](vtkTable* table)
    {
      const auto camera = msi::readCamera(table, "the camera");
      msi::CameraDescription description{ camera.camera };
      description.whiteLevel = camera.whiteLevel;
      description.noise = camera.noise;
      description.whiteAfterEffects = camera.whiteAfterEffects;
      if (!camera.effects.empty())
      {
        description.effects =
          msi::parseEffectList("Effects", camera.effects, camera.camera.channels());
      }
      msi::writeCameraDescription(this->FileName, description);
    }));
}
