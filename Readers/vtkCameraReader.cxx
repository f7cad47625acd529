#include "vtkCameraReader.h"

#include "AlgorithmSupport.h"
#include "CameraTable.h"

#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Formats/CameraDescription.h"
#include "Formats/FileKind.h"

#include <stdexcept>

vtkStandardNewMacro(vtkCameraReader);

vtkCameraReader::vtkCameraReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(1);
}

void vtkCameraReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "Notes: " << this->Notes << "\n";
}

int vtkCameraReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->Notes.clear();
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      if (this->FileName.empty())
      {
        throw std::invalid_argument(
          "no file is given; choose a camera (.json or .csv) as File Name");
      }
      const auto description = msi::readCameraDescription(this->FileName);
      msi::CameraTable camera{ description.camera, description.noise };
      if (!description.effects.empty())
      {
        camera.effects = msi::effectListText(description.effects, description.camera.channels());
      }
      camera.whiteAfterEffects = description.whiteAfterEffects;
      camera.whiteLevel = description.whiteLevel;
      msi::write(camera, vtkTable::GetData(outputs, 0));
      for (const auto& note : description.notes)
      {
        this->Notes += (this->Notes.empty() ? "" : "\n") + note;
      }
    });
}

int vtkCameraReader::CanReadFile(const char* name)
{
  return name && msi::fileKind(name) == msi::FileKind::Camera ? 1 : 0;
}
