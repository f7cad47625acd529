// The names that a list in the panel Properties offers.
#ifndef OfferedNames_h
#define OfferedNames_h

#include <string>
#include <vector>

class vtkPVDataInformation;
class vtkSMProperty;

namespace msi
{

// Of a registry of the kernels: illuminants (with E, and daylights and blackbodies of usual temperatures), differences,
// metrics, methods, quantities, effects. Empty for any other kind.
std::vector<std::string> offeredNames(const std::string& kind);

std::vector<std::string> pointArrayNames(vtkPVDataInformation* data);

// First the curves of a table of the user's own (may be null), then the names, then what else the property holds.
std::vector<std::string> withOwnNames(
  vtkPVDataInformation* table, const std::vector<std::string>& names, vtkSMProperty* property);

} // namespace msi

#endif
