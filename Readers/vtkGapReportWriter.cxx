#include "vtkGapReportWriter.h"

#include "TableWriting.h"

#include "vtkFieldData.h"
#include "vtkInformation.h"
#include "vtkObjectFactory.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include "Formats/Storage/AtomicFile.h"

#include <stdexcept>

vtkStandardNewMacro(vtkGapReportWriter);

void vtkGapReportWriter::PrintSelf(ostream& os, vtkIndent indent)
{
  this->Superclass::PrintSelf(os, indent);
  os << indent << "FileName: " << this->FileName << "\n";
}

int vtkGapReportWriter::FillInputPortInformation(int, vtkInformation* info)
{
  info->Set(vtkAlgorithm::INPUT_REQUIRED_DATA_TYPE(), "vtkTable");
  return 1;
}

void vtkGapReportWriter::WriteData()
{
  this->SetErrorCode(msi::writeTable(this, this->FileName,
    [this](vtkTable* table)
    {
      auto* text = vtkStringArray::SafeDownCast(table->GetFieldData()->GetAbstractArray("Report"));
      if (!text || text->GetNumberOfValues() == 0)
      {
        throw std::invalid_argument("the input has no field data 'Report'; expected the summary, "
                                    "output 0 of Sim To Real Gap");
      }
      msi::AtomicFile file(this->FileName);
      file.append(std::string(text->GetValue(0)));
      file.commit();
    }));
}
