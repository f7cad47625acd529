#include "TableRows.h"

#include "vtkDoubleArray.h"
#include "vtkIntArray.h"
#include "vtkSmartPointer.h"
#include "vtkStringArray.h"
#include "vtkTable.h"

#include <stdexcept>

namespace msi
{

namespace
{
vtkSmartPointer<vtkAbstractArray> newColumn(const TableCell& type)
{
  if (std::holds_alternative<std::string>(type))
  {
    return vtkSmartPointer<vtkStringArray>::New();
  }
  if (std::holds_alternative<double>(type))
  {
    return vtkSmartPointer<vtkDoubleArray>::New();
  }
  return vtkSmartPointer<vtkIntArray>::New();
}

bool append(vtkAbstractArray* column, const TableCell& cell)
{
  if (auto* texts = vtkStringArray::SafeDownCast(column))
  {
    const auto* text = std::get_if<std::string>(&cell);
    return text != nullptr && texts->InsertNextValue(*text) >= 0;
  }
  if (auto* numbers = vtkDoubleArray::SafeDownCast(column))
  {
    const auto* number = std::get_if<double>(&cell);
    return number != nullptr && numbers->InsertNextValue(*number) >= 0;
  }
  auto* counts = vtkIntArray::SafeDownCast(column);
  const auto* count = std::get_if<int>(&cell);
  return counts != nullptr && count != nullptr && counts->InsertNextValue(*count) >= 0;
}
}

TableRows::TableRows(vtkTable* table, const std::vector<Column>& columns)
  : Table(table)
  , First(static_cast<int>(table->GetNumberOfColumns()))
{
  for (const Column& column : columns)
  {
    const auto array = newColumn(column.type);
    array->SetName(column.name.c_str());
    table->AddColumn(array);
  }
}

void TableRows::add(const std::vector<TableCell>& cells)
{
  for (std::size_t i = 0; i < cells.size(); ++i)
  {
    auto* column = Table->GetColumn(First + static_cast<vtkIdType>(i));
    if (column == nullptr || !append(column, cells[i]))
    {
      throw std::logic_error("cell " + std::to_string(i) + " does not fit its column");
    }
  }
}

} // namespace msi
