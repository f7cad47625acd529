// What every writer of one table to one file does before and after it writes.
#ifndef TableWriting_h
#define TableWriting_h

#include "AlgorithmSupport.h"

#include "vtkErrorCode.h"
#include "vtkMultiProcessController.h"
#include "vtkTable.h"
#include "vtkWriter.h"

#include <exception>
#include <stdexcept>
#include <string>

namespace msi
{

// Calls write(table) on the first rank, where small tables stand whole. What it throws, or a missing name, is the
// writer's error: told, and returned as the code for SetErrorCode.
template <typename Write>
unsigned long writeTable(vtkWriter* self, const std::string& fileName, Write&& write)
{
  auto* controller = controllerOfTables();
  if (controller && controller->GetLocalProcessId() > 0)
  {
    return vtkErrorCode::NoError;
  }
  try
  {
    if (fileName.empty())
    {
      throw std::invalid_argument("no file is given; choose where to write as File Name");
    }
    write(vtkTable::SafeDownCast(self->GetInput()));
  }
  catch (const std::exception& error)
  {
    vtkErrorWithObjectMacro(self, << error.what());
    return vtkErrorCode::CannotOpenFileError;
  }
  return vtkErrorCode::NoError;
}

} // namespace msi

#endif
