// Curves over wavelength from files, as the table that filters take: lamps, observers.
#ifndef CurveTable_h
#define CurveTable_h

#include <string>
#include <vector>

class vtkTable;

namespace msi
{

// Fills the table with the curves of all files: "wavelength" (nm, increasing) and one column a curve, NaN where a curve's file
// does not have the wavelength. A file with one curve names it: lamp.csv gives "lamp". Blanks and commas in names become "-", since
// they separate names in lists. Returns what was recognized, one remark a line. Throws std::invalid_argument where two curves
// have one name, and FormatError of Formats/Curves.h.
std::string readCurveTable(const std::vector<std::string>& files, vtkTable* table);

} // namespace msi

#endif
