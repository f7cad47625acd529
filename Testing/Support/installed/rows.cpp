// rows TABLE COUNT: whether a sample table has so many rows.
#include <vtkNew.h>
#include <vtkSampleTableReader.h>
#include <vtkTable.h>

#include <cstdlib>

int main(int, char** arguments)
{
  vtkNew<vtkSampleTableReader> reader;
  reader->SetFileName(arguments[1]);
  reader->Update();
  return reader->GetOutput()->GetNumberOfRows() == std::atoi(arguments[2]) ? 0 : 1;
}
