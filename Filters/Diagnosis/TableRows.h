// Tables that are filled row by row.
#ifndef TableRows_h
#define TableRows_h

#include <string>
#include <variant>
#include <vector>

class vtkTable;

namespace msi
{

// What a column holds, told by an empty cell of its type.
using TableCell = std::variant<std::string, double, int>;

class TableRows
{
public:
  struct Column
  {
    std::string name;
    TableCell type;
  };

  // Adds the columns to the table.
  TableRows(vtkTable* table, const std::vector<Column>& columns);

  // One cell a column, of its type; std::logic_error otherwise.
  void add(const std::vector<TableCell>& cells);

private:
  vtkTable* Table;
  int First;
};

// Types of columns.
inline const TableCell TextColumn{ std::string() };
inline const TableCell NumberColumn{ 0.0 };
inline const TableCell CountColumn{ 0 };

} // namespace msi

#endif
