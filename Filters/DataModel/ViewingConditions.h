// The light and the observer of a color: by name, or from tables or files of curves that a user brings.
#ifndef ViewingConditions_h
#define ViewingConditions_h

#include "Kernels/Colorimetry/Illuminant.h"
#include "Kernels/Colorimetry/StandardObserver.h"

#include <string>
#include <vector>

class vtkTable;

namespace msi
{

// Files of curves (CurveTable.h) beside the tables; empty for none.
struct ViewingFiles
{
  std::string illuminants;
  std::string observer;
};

// Immutable. A table of curves has a column "wavelength" (nm) and one column a curve, as Curve Reader makes it; rows
// where a curve is NaN do not belong to it.
class ViewingConditions
{
public:
  // Tables may be null: then names are the kernel's alone. A table of an observer has three curves, x-bar, y-bar and
  // z-bar, and takes the place of the name. Throws std::invalid_argument where a table is not made so, a power is
  // negative, a curve does not cover 400 to 700 nm, two illuminants have one name, or the observer is a table and a file.
  ViewingConditions(vtkTable* illuminants, vtkTable* observer, const std::string& observerName,
    const ViewingFiles& files = {});

  const StandardObserver& observer() const noexcept { return Observer; }

  // The illuminants of the file, in its order.
  const std::vector<std::string>& namesOfFile() const noexcept { return NamesOfFile; }
  // The names, then those of the file that are not among them.
  std::vector<std::string> withFile(std::vector<std::string> names) const;

  // A curve of the table or the file, else Illuminant::named. Throws std::invalid_argument.
  Illuminant illuminant(const std::string& name) const;

private:
  const Illuminant* findOwn(const std::string& name) const; // null where there is none

  std::vector<Illuminant> Own;
  std::vector<std::string> NamesOfFile;
  StandardObserver Observer;
};

} // namespace msi

#endif
