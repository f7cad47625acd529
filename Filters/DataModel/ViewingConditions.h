// The light and the observer of a color: by name, or from tables of curves that a user brings.
#ifndef ViewingConditions_h
#define ViewingConditions_h

#include "Kernels/Colorimetry/Illuminant.h"
#include "Kernels/Colorimetry/StandardObserver.h"

#include <string>
#include <vector>

class vtkTable;

namespace msi
{

// Immutable. A table of curves has a column "wavelength" (nm) and one column a curve, as Curve Reader makes it; rows
// where a curve is NaN do not belong to it.
class ViewingConditions
{
public:
  // Tables may be null: then names are the kernel's alone. A table of an observer has three curves, x-bar, y-bar and
  // z-bar, and takes the place of the name. Throws std::invalid_argument where a table is not made so, a power is
  // negative, or a curve does not cover 400 to 700 nm.
  ViewingConditions(vtkTable* illuminants, vtkTable* observer, const std::string& observerName);

  const StandardObserver& observer() const noexcept { return Observer; }

  // A curve of the table, else Illuminant::named. Throws std::invalid_argument.
  Illuminant illuminant(const std::string& name) const;

private:
  std::vector<Illuminant> Own;
  StandardObserver Observer;
};

} // namespace msi

#endif
