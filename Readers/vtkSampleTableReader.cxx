#include "vtkSampleTableReader.h"

#include "AlgorithmSupport.h"
#include "SampleTableConversion.h"

#include "vtkFieldData.h"
#include "vtkNew.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include "Formats/FileKind.h"
#include "Formats/SampleTable.h"

#include <stdexcept>

vtkStandardNewMacro(vtkSampleTableReader);

vtkSampleTableReader::vtkSampleTableReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(1);
}

void vtkSampleTableReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n"
     << indent << "ResponseFile: " << this->ResponseFile << "\n"
     << indent << "ReflectanceUnit: " << this->ReflectanceUnit << "\n"
     << indent << "MatrixWavelengths: " << this->MatrixWavelengths[0] << ", "
     << this->MatrixWavelengths[1] << ", " << this->MatrixWavelengths[2] << "\n"
     << indent << "Notes: " << this->Notes << "\n";
}

int vtkSampleTableReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->Notes.clear();
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      if (this->FileName.empty())
      {
        throw std::invalid_argument("no file is given; choose a table of samples as File Name");
      }
      msi::SampleTableOptions options;
      options.unit = static_cast<msi::ReflectanceUnit>(this->ReflectanceUnit);
      options.responseFile = this->ResponseFile;
      const auto& w = this->MatrixWavelengths;
      options.wavelengths = msi::WavelengthGrid::uniform(w[0], w[1], w[2]);
      const auto samples = msi::readSampleTable(this->FileName, options);
      auto* output = vtkTable::GetData(outputs, 0);
      msi::toVTK(samples, output);
      vtkNew<vtkStringArray> notes;
      notes->SetName("Notes");
      for (const auto& note : samples.notes)
      {
        this->Notes += (this->Notes.empty() ? "" : "\n") + note;
        notes->InsertNextValue(note);
      }
      if (!samples.notes.empty())
      {
        output->GetFieldData()->AddArray(notes);
      }
    });
}

int vtkSampleTableReader::CanReadFile(const char* name)
{
  return name && msi::fileKind(name) == msi::FileKind::SampleTable ? 1 : 0;
}
