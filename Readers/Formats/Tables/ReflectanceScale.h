// Percent or factor.
#pragma once

#include "Formats/FormatError.h"
#include "Formats/SampleTable.h"

#include <functional>

namespace msi
{

// Brings table.reflectance to a factor (1 = perfect white) and notes what was done.
//
// Rule for ReflectanceUnit::Recognize: a sample "exceeds 2" when its largest value does; as a factor
// that would be twice the perfect white. More than half of the samples exceed 2: percent. None: factor.
// A table where some but no more than half do, or where over a quarter do not although it is percent,
// mixes both and is refused, naming the place of a sample of the smaller group (placeOf).
//
// Reflectance and responses that no instrument gives (Kernels/Spectra/PossibleValues.h) are refused, naming the place
// of the sample; reflectance that lies more than 1 % of white below 0 is noted.
void bringToFactor(SampleTable& table, ReflectanceUnit unit,
  const std::function<FilePlace(Eigen::Index sample)>& placeOf);

} // namespace msi
