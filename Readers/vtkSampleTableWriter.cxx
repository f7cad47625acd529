#include "vtkSampleTableWriter.h"

#include "SampleTableConversion.h"
#include "TableWriting.h"

#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkTable.h"

#include "Formats/SampleTable.h"

#include <stdexcept>

vtkStandardNewMacro(vtkSampleTableWriter);

namespace
{
bool endsWith(const std::string& text, const std::string& end)
{
  return text.size() >= end.size() && text.compare(text.size() - end.size(), end.size(), end) == 0;
}
}

void vtkSampleTableWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}

int vtkSampleTableWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  return 1;
}

void vtkSampleTableWriter::WriteData()
{
  this->SetErrorCode(msi::writeTable(this, this->FileName,
    [this](vtkTable* table)
    {
      const auto samples = msi::fromVTK(table);
      if (endsWith(this->FileName, ".ti3") || endsWith(this->FileName, ".cie"))
      {
        if (!samples.hasReflectance())
        {
          throw std::invalid_argument(this->FileName +
            ": the table has no reflectance, which CGATS is for; expected "
            "columns R400, R410, ..; name the file .csv");
        }
        msi::writeSampleTableCgats(this->FileName, samples);
      }
      else
      {
        msi::writeSampleTableCsv(this->FileName, samples);
      }
    }));
}
