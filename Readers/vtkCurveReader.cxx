#include "vtkCurveReader.h"

#include "AlgorithmSupport.h"
#include "CurveTable.h"

#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include <stdexcept>

vtkStandardNewMacro(vtkCurveReader);

vtkCurveReader::vtkCurveReader()
{
  this->SetNumberOfInputPorts(0);
  this->SetNumberOfOutputPorts(1);
}

void vtkCurveReader::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileNames:";
  for (const auto& name : this->FileNames)
  {
    os << ' ' << name;
  }
  os << "\n" << indent << "Notes: " << this->Notes << "\n";
}

void vtkCurveReader::AddFileName(const char* name)
{
  if (name && *name)
  {
    this->FileNames.emplace_back(name);
    this->Modified();
  }
}

void vtkCurveReader::ClearFileNames()
{
  this->FileNames.clear();
  this->Modified();
}

int vtkCurveReader::RequestData(
  vtkInformation*, vtkInformationVector**, vtkInformationVector* outputs)
{
  this->Notes.clear();
  return msi::runAlgorithm(this, outputs,
    [&]
    {
      if (this->FileNames.empty())
      {
        throw std::invalid_argument("no file is given; choose tables of curves as File Names");
      }
      this->Notes = msi::readCurveTable(this->FileNames, vtkTable::GetData(outputs, 0));
    });
}
